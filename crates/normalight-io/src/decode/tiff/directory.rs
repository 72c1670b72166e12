//! Directories of TIFF files (TIFF 6.0, BigTIFF): tags and their values.
//!
//! The decoder of the library reads only directories of pictures that it can decode; which page of
//! a file to take, and whether it is a camera's raw data, is seen here.

/// Most entries of one directory, and most values of one entry, that are looked at.
const MAX_ENTRIES: u64 = 4096;
const MAX_VALUES: usize = 1 << 24;

/// A file with its byte order and the width of its offsets.
#[derive(Clone, Copy)]
pub(crate) struct File<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) little: bool,
    /// Offsets of 64 bits.
    pub(crate) big: bool,
}

/// A directory, and where the next begins (0: nowhere).
pub(crate) struct Directory<'a> {
    pub(crate) file: File<'a>,
    pub(super) entries: Vec<Entry<'a>>,
    pub(crate) next: u64,
}

/// A tag and its values as they lie in the file.
pub(crate) struct Entry<'a> {
    pub(super) tag: u16,
    pub(super) kind: u16,
    pub(super) content: &'a [u8],
}

impl Entry<'_> {
    /// Number of values.
    pub(super) fn count(&self) -> usize {
        self.content.len() / width(self.kind).unwrap_or(1)
    }
}

/// Bytes of a value of a kind.
fn width(kind: u16) -> Option<usize> {
    Some(match kind {
        1 | 2 | 6 | 7 => 1,
        3 | 8 => 2,
        4 | 9 | 11 | 13 => 4,
        5 | 10 | 12 | 16..=18 => 8,
        _ => return None,
    })
}

impl<'a> File<'a> {
    /// `None` when the bytes do not begin as a TIFF.
    pub(crate) fn new(bytes: &'a [u8]) -> Option<Self> {
        let (little, big) = match bytes {
            [b'I', b'I', 42, 0, ..] => (true, false),
            [b'M', b'M', 0, 42, ..] => (false, false),
            [b'I', b'I', 43, 0, ..] => (true, true),
            [b'M', b'M', 0, 43, ..] => (false, true),
            _ => return None,
        };
        Some(Self { bytes, little, big })
    }

    /// At most 8 bytes as an integer.
    pub(crate) fn integer(&self, bytes: &[u8]) -> u64 {
        let join = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
        match self.little {
            true => bytes.iter().rev().fold(0, join),
            false => bytes.iter().fold(0, join),
        }
    }

    fn number(&self, at: usize, count: usize) -> Option<u64> {
        let bytes = self.bytes.get(at..at.checked_add(count)?)?;
        Some(self.integer(bytes))
    }

    /// Where the first directory begins.
    pub(crate) fn first(&self) -> Option<u64> {
        match self.big {
            true => self.number(8, 8),
            false => self.number(4, 4),
        }
    }

    /// The directory that begins there; entries of unknown kinds or outside the file are left out.
    pub(crate) fn directory(&self, at: u64) -> Option<Directory<'a>> {
        let at = usize::try_from(at).ok()?;
        let (head, size, word) = if self.big { (8, 20, 8) } else { (2, 12, 4) };
        let count = self.number(at, head)?;
        if count > MAX_ENTRIES {
            return None;
        }
        let start = at.checked_add(head)?;
        let end = start.checked_add(size * count as usize)?;
        let places = (0..count as usize).map(|k| start + k * size);
        let entries = places.filter_map(|place| self.entry(place, word));
        Some(Directory {
            file: *self,
            entries: entries.collect(),
            next: self.number(end, word).unwrap_or(0),
        })
    }

    fn entry(&self, place: usize, word: usize) -> Option<Entry<'a>> {
        let tag = self.number(place, 2)? as u16;
        let kind = self.number(place + 2, 2)? as u16;
        let count = usize::try_from(self.number(place + 4, word)?).ok()?;
        let length = count.checked_mul(width(kind)?)?;
        let inline = place + 4 + word;
        let at = match length <= word {
            true => inline,
            false => usize::try_from(self.number(inline, word)?).ok()?,
        };
        Some(Entry {
            tag,
            kind,
            content: self.bytes.get(at..at.checked_add(length)?)?,
        })
    }
}

impl<'a> Directory<'a> {
    fn entry(&self, tag: u16) -> Option<&Entry<'a>> {
        self.entries.iter().find(|entry| entry.tag == tag)
    }

    pub(crate) fn has(&self, tag: u16) -> bool {
        self.entry(tag).is_some()
    }

    /// Content of an entry as it lies in the file.
    pub(crate) fn bytes(&self, tag: u16) -> Option<&'a [u8]> {
        self.entry(tag).map(|entry| entry.content)
    }

    /// Integers of an entry; none when it is missing or of another kind.
    pub(crate) fn all(&self, tag: u16) -> Vec<u64> {
        let integers = |entry: &&Entry| matches!(entry.kind, 1 | 3 | 4 | 7 | 13 | 16 | 18);
        let Some(entry) = self.entry(tag).filter(integers) else {
            return Vec::new();
        };
        let values = entry.content.chunks_exact(width(entry.kind).unwrap_or(1));
        match values.len() > MAX_VALUES {
            true => Vec::new(),
            false => values.map(|value| self.file.integer(value)).collect(),
        }
    }

    /// The first integer of an entry.
    pub(crate) fn one(&self, tag: u16) -> Option<u64> {
        self.all(tag).first().copied()
    }

    /// Fractions of an entry; none when it is missing or of another kind.
    pub(crate) fn fractions(&self, tag: u16) -> Vec<f32> {
        let Some(entry) = self.entry(tag).filter(|entry| entry.kind == 5) else {
            return Vec::new();
        };
        let part = |bytes: &[u8]| self.file.integer(bytes) as f64;
        let pairs = entry.content.chunks_exact(8);
        pairs
            .map(|pair| (part(&pair[..4]) / part(&pair[4..])) as f32)
            .collect()
    }
}
