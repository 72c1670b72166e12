//! The segments of a JPEG, walked without decoding.

/// A segment: the byte that names its kind, where its content begins, and how long that is.
struct Segment {
    kind: u8,
    start: usize,
    length: usize,
}

/// Segments from the start of the file to its end mark; the data of scans is passed over.
///
/// A mark anywhere is not enough: the thumbnail in the metadata has all of them too.
struct Segments<'a> {
    bytes: &'a [u8],
    at: usize,
}

const END: u8 = 0xD9;

impl Iterator for Segments<'_> {
    type Item = Segment;

    fn next(&mut self) -> Option<Segment> {
        loop {
            let &[mark, kind] = self.bytes.get(self.at..self.at + 2)? else {
                return None;
            };
            match (mark, kind) {
                (0xFF, END) => {
                    let start = self.at + 2;
                    self.at = self.bytes.len();
                    return Some(Segment {
                        kind,
                        start,
                        length: 0,
                    });
                }
                // Fill bytes, stuffed zeros and restart marks carry no length.
                (0xFF, 0xFF) => self.at += 1,
                (0xFF, 0x00 | 0x01 | 0xD0..=0xD8) => self.at += 2,
                (0xFF, _) => {
                    let &[high, low] = self.bytes.get(self.at + 2..self.at + 4)? else {
                        return None;
                    };
                    let length = usize::from(u16::from_be_bytes([high, low]));
                    let start = self.at + 4;
                    self.at += 2 + length;
                    return Some(Segment {
                        kind,
                        start,
                        length: length.saturating_sub(2),
                    });
                }
                // Entropy-coded data.
                _ => self.at += 1,
            }
        }
    }
}

fn segments(bytes: &[u8]) -> Segments<'_> {
    Segments { bytes, at: 2 }
}

/// Where a JPEG ends; `None` when its end mark is missing.
///
/// Decoders fill missing rows of a cut-off file with grey instead of failing, which would pass for
/// a part of the object.
pub(crate) fn end(bytes: &[u8]) -> Option<usize> {
    let mut ends = segments(bytes).filter(|segment| segment.kind == END);
    ends.next().map(|end| end.start)
}

/// Number of scans, each of which holds the whole picture or a part of its channels or detail.
pub(crate) fn scans(bytes: &[u8]) -> usize {
    segments(bytes)
        .filter(|segment| segment.kind == 0xDA)
        .count()
}

/// What a JPEG's frame says.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Frame {
    /// How it is coded, in words when no reader of photographs knows it.
    pub(crate) uncommon: Option<&'static str>,
    /// Coded in passes of growing detail.
    pub(crate) progressive: bool,
    /// Bits of a sample.
    pub(crate) bits: u8,
    /// 1 for grey, 3 for colours, 4 for those of a print.
    pub(crate) components: u8,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// The first frame; `None` where there is none.
pub(crate) fn frame(bytes: &[u8]) -> Option<Frame> {
    let is_frame = |kind| matches!(kind, 0xC0..=0xCF | 0xF7) && !matches!(kind, 0xC4 | 0xC8 | 0xCC);
    let segment = segments(bytes).find(|segment| is_frame(segment.kind))?;
    let &[bits, high, low, wide, narrow, components] =
        bytes.get(segment.start..segment.start + 6)?
    else {
        return None;
    };
    Some(Frame {
        uncommon: match segment.kind {
            0xC0..=0xC2 => None,
            0xC3 => Some("lossless coding"),
            0xF7 => Some("JPEG-LS coding"),
            0xC9..=0xCF => Some("arithmetic coding"),
            _ => Some("hierarchical coding"),
        },
        progressive: segment.kind == 0xC2,
        bits,
        components,
        width: u32::from(u16::from_be_bytes([wide, narrow])),
        height: u32::from(u16::from_be_bytes([high, low])),
    })
}

/// Number of pictures that count as such (views, parts of a panorama) in a file of the
/// Multi-Picture Format (CIPA DC-007): previews and maps for bright screens, which phones add, do
/// not count. 1 for other files.
pub(crate) fn pictures(bytes: &[u8]) -> usize {
    const APP2: u8 = 0xE2;
    let contents = segments(bytes).filter(|segment| segment.kind == APP2);
    let mut contents =
        contents.filter_map(|segment| bytes.get(segment.start..segment.start + segment.length));
    let index = contents.find_map(|content| content.strip_prefix(b"MPF\0"));
    index.and_then(listed_pictures).unwrap_or(1)
}

/// The index is a TIFF directory; entry 0xB002 lists 16 bytes for each picture, kind first.
fn listed_pictures(index: &[u8]) -> Option<usize> {
    let file = crate::decode::tiff::directory::File::new(index)?;
    let list = file.directory(file.first()?)?;
    let list = list.bytes(0xB002)?;
    let views = list.chunks_exact(16).filter(|entry| {
        let kind = file.integer(&entry[..4]);
        matches!(kind >> 16 & 0xFF, 2 | 3)
    });
    Some(views.count().max(1))
}

#[cfg(test)]
mod tests {
    use super::{Frame, end, frame, pictures};

    #[test]
    fn end_marks_inside_segments_do_not_count() {
        let is_complete = |bytes: &[u8]| end(bytes).is_some();
        let thumbnail = [0xFF, 0xD8, 0xFF, 0xE1, 0, 4, 0xFF, 0xD9];
        assert!(!is_complete(&thumbnail));
        let scan = [0xFF, 0xDA, 0, 3, 9, 1, 2, 0xFF, 0, 0xFF, 0xD0, 5];
        let cut = [&thumbnail[..], &scan[..]].concat();
        assert!(!is_complete(&cut));
        // Bytes after the end, as phones append them, are no fault.
        assert!(is_complete(&[&cut[..], &[0xFF, 0xD9, 1, 2]].concat()));
        assert!(!is_complete(&[]));
    }

    #[test]
    fn frames_are_found_behind_other_segments() {
        let bytes = [
            0xFF, 0xD8, 0xFF, 0xE1, 0, 4, 0xFF, 0xC0, 0xFF, 0xC4, 0, 2, 0xFF, 0xC2, 0, 9, 12, 0, 7,
            1, 2, 4, 9,
        ];
        let found = Frame {
            uncommon: None,
            progressive: true,
            bits: 12,
            components: 4,
            width: 258,
            height: 7,
        };
        assert_eq!(frame(&bytes), Some(found));
        for cut in 0..21 {
            assert_eq!(frame(&bytes[..cut]), None, "{cut}");
        }
    }

    #[test]
    fn only_views_count_as_pictures() {
        let with = |kinds: [u32; 3]| {
            let mut index =
                b"MPF\0MM\0*\0\0\0\x08\0\x01\xB0\x02\0\x07\0\0\0\x30\0\0\0\x1A\0\0\0\0".to_vec();
            for kind in kinds {
                index.extend(kind.to_be_bytes());
                index.extend([0; 12]);
            }
            let length = (index.len() as u16 + 2).to_be_bytes();
            [&[0xFF, 0xD8, 0xFF, 0xE2][..], &length, &index].concat()
        };
        assert_eq!(pictures(&with([0x2003_0000, 0x0002_0002, 0x0002_0002])), 3);
        assert_eq!(pictures(&with([0x2003_0000, 0x0001_0001, 0])), 1);
        assert_eq!(pictures(&with([0; 3])), 1);
        assert_eq!(pictures(&[0xFF, 0xD8]), 1);
    }
}
