//! TIFF files around arbitrary settings: the directory is in order and the strips lie where it says.
use crate::png::compressed;
use arbitrary::Arbitrary;

/// A file of one picture.
#[derive(Debug, Clone, Arbitrary)]
pub struct Tiff {
    pub big_endian: bool,
    pub width: u8,
    pub height: u8,
    pub rows_per_strip: u8,
    pub tile: Option<(u8, u8)>,
    pub bits: u8,
    pub channels: u8,
    pub format: u8,
    pub photometric: u8,
    pub compression: u8,
    pub planar: bool,
    pub predictor: u8,
    pub extra: Vec<u16>,
    pub palette: Option<Vec<u16>>,
    /// Further tags, which replace those above: number, type, count of values, values.
    pub tags: Vec<(u16, u8, u8, Vec<u8>)>,
    pub pixels: Vec<u8>,
    /// Whether the pixels are as many as the settings ask for.
    pub complete: bool,
}

const BITS: [u16; 8] = [8, 16, 32, 64, 1, 4, 2, 24];
/// None, LZW, deflate, PackBits, JPEG, both kinds of fax, the old deflate.
const COMPRESSIONS: [u16; 8] = [1, 5, 8, 32_773, 7, 3, 4, 32_946];
/// Tags that pictures really have, which stand for small numbers.
const TAGS: [u16; 16] = [
    256, 257, 258, 259, 262, 273, 274, 277, 278, 279, 338, 339, 347, 34_665, 34_675, 50_706,
];

struct Entry {
    tag: u16,
    kind: u16,
    count: u32,
    value: Vec<u8>,
}

impl Tiff {
    fn short(&self, value: u16) -> [u8; 2] {
        if self.big_endian {
            value.to_be_bytes()
        } else {
            value.to_le_bytes()
        }
    }

    fn long(&self, value: u32) -> [u8; 4] {
        if self.big_endian {
            value.to_be_bytes()
        } else {
            value.to_le_bytes()
        }
    }

    fn shorts(&self, tag: u16, values: &[u16]) -> Entry {
        Entry {
            tag,
            kind: 3,
            count: values.len() as u32,
            value: values.iter().flat_map(|&value| self.short(value)).collect(),
        }
    }

    fn longs(&self, tag: u16, values: &[u32]) -> Entry {
        Entry {
            tag,
            kind: 4,
            count: values.len() as u32,
            value: values.iter().flat_map(|&value| self.long(value)).collect(),
        }
    }

    /// Width, height, width and height of a strip or tile, bytes of its row.
    fn layout(&self) -> (u32, u32, u32, u32, usize) {
        let (width, height) = (
            1 + u32::from(self.width % 48),
            1 + u32::from(self.height % 48),
        );
        let (across, down) = match self.tile {
            Some((across, down)) => (16 * u32::from(across % 4), 16 * u32::from(down % 4)),
            None => (width, 1 + u32::from(self.rows_per_strip % 48)),
        };
        let bits =
            usize::from(self.bits_of_sample()) * if self.planar { 1 } else { self.samples() };
        (
            width,
            height,
            across,
            down,
            (across as usize * bits).div_ceil(8),
        )
    }

    fn bits_of_sample(&self) -> u16 {
        BITS[usize::from(self.bits) % BITS.len()]
    }

    fn samples(&self) -> usize {
        1 + usize::from(self.channels % 5)
    }

    /// The file.
    pub fn bytes(&self) -> Vec<u8> {
        let (width, height, across, down, row) = self.layout();
        let strips = match self.tile {
            Some(_) => width.div_ceil(across.max(1)) * height.div_ceil(down.max(1)),
            None => height.div_ceil(down),
        };
        let strips = strips as usize * if self.planar { self.samples() } else { 1 };
        let compression = COMPRESSIONS[usize::from(self.compression) % COMPRESSIONS.len()];
        let mut file = if self.big_endian {
            b"MM\0*".to_vec()
        } else {
            b"II*\0".to_vec()
        };
        file.extend(self.long(0));
        let (mut offsets, mut lengths) = (Vec::new(), Vec::new());
        let mut rest = &self.pixels[..];
        for strip in 0..strips {
            let share = rest.len() / (strips - strip);
            let (part, after) = rest.split_at(share);
            rest = after;
            let mut part = part.to_vec();
            if self.complete && matches!(compression, 1 | 8 | 32_946) {
                part.resize(row * down as usize, 7);
            }
            if matches!(compression, 8 | 32_946) {
                part = compressed(&part);
            }
            offsets.push(file.len() as u32);
            lengths.push(part.len() as u32);
            file.extend(part);
        }
        let entries = self.entries(compression, &offsets, &lengths);
        self.put_directory(&mut file, entries);
        file
    }

    fn entries(&self, compression: u16, offsets: &[u32], lengths: &[u32]) -> Vec<Entry> {
        let (width, height, across, down, _) = self.layout();
        let samples = self.samples();
        let mut entries = vec![
            self.longs(256, &[width]),
            self.longs(257, &[height]),
            self.shorts(258, &vec![self.bits_of_sample(); samples]),
            self.shorts(259, &[compression]),
            self.shorts(262, &[u16::from(self.photometric % 10)]),
            self.shorts(277, &[samples as u16]),
            self.shorts(284, &[1 + u16::from(self.planar)]),
            self.shorts(317, &[1 + u16::from(self.predictor % 3)]),
            self.shorts(339, &vec![1 + u16::from(self.format % 6); samples]),
        ];
        if !self.extra.is_empty() {
            entries.push(self.shorts(338, &self.extra));
        }
        if let Some(palette) = &self.palette {
            let mut palette = palette.clone();
            if self.complete {
                palette.resize(3 << self.bits_of_sample().min(8), 9);
            }
            entries.push(self.shorts(320, &palette));
        }
        entries.extend(match self.tile {
            Some(_) => [
                self.longs(322, &[across]),
                self.longs(323, &[down]),
                self.longs(324, offsets),
                self.longs(325, lengths),
            ],
            None => [
                self.longs(273, offsets),
                self.longs(278, &[down]),
                self.longs(279, lengths),
                self.shorts(296, &[1]),
            ],
        });
        for (tag, kind, count, value) in self.tags.iter().take(20) {
            let tag = TAGS.get(usize::from(*tag)).copied().unwrap_or(*tag);
            entries.retain(|entry| entry.tag != tag);
            entries.push(Entry {
                tag,
                kind: u16::from(*kind),
                count: u32::from(*count),
                value: value.clone(),
            });
        }
        entries.sort_by_key(|entry| entry.tag);
        entries
    }

    fn put_directory(&self, file: &mut Vec<u8>, entries: Vec<Entry>) {
        let mut directory = self.short(entries.len() as u16).to_vec();
        for entry in entries {
            directory.extend(self.short(entry.tag));
            directory.extend(self.short(entry.kind));
            directory.extend(self.long(entry.count));
            let mut value = entry.value;
            if value.len() <= 4 {
                value.resize(4, 0);
                directory.extend(value);
            } else {
                directory.extend(self.long(file.len() as u32));
                file.extend(value);
            }
        }
        directory.extend(self.long(0));
        let place = self.long(file.len() as u32);
        file[4..8].copy_from_slice(&place);
        file.extend(directory);
    }
}
