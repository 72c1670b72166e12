//! Directories of TIFF files that are made here.
use super::directory::{Entry, File};

/// A directory that is being made.
pub(super) struct NewDirectory {
    little: bool,
    big: bool,
    /// Tag, kind, number of values, content.
    entries: Vec<(u16, u16, usize, Vec<u8>)>,
}

impl NewDirectory {
    /// In the byte order and with the offsets of a file.
    pub(super) fn beside(file: &File) -> Self {
        Self {
            little: file.little,
            big: file.big,
            entries: Vec::new(),
        }
    }

    fn bytes(&self, value: u64, count: usize) -> Vec<u8> {
        match self.little {
            true => value.to_le_bytes()[..count].to_vec(),
            false => value.to_be_bytes()[8 - count..].to_vec(),
        }
    }

    /// A number as wide as offsets are.
    pub(super) fn word(&self, value: u64) -> Vec<u8> {
        self.bytes(value, if self.big { 8 } else { 4 })
    }

    pub(super) fn set(&mut self, tag: u16, values: &[u64]) {
        let content = values.iter().flat_map(|&value| self.word(value)).collect();
        let kind = if self.big { 16 } else { 4 };
        self.entries.push((tag, kind, values.len(), content));
    }

    /// An entry as it stands in another directory of the same byte order and width of offsets.
    pub(super) fn copy(&mut self, entry: &Entry) {
        let content = entry.content.to_vec();
        self.entries
            .push((entry.tag, entry.kind, entry.count(), content));
    }

    pub(super) fn set_bytes(&mut self, tag: u16, bytes: &[u8]) {
        self.entries.push((tag, 7, bytes.len(), bytes.to_vec()));
    }

    /// Appends the directory to what begins at `start` less what is there already; returns where
    /// the directory begins.
    pub(super) fn write(&mut self, start: u64, tail: &mut Vec<u8>) -> u64 {
        self.entries.sort_by_key(|entry| entry.0);
        let word = if self.big { 8 } else { 4 };
        let mut fields = Vec::new();
        let mut at = start;
        for (tag, kind, count, content) in &self.entries {
            fields.extend(self.bytes(u64::from(*tag), 2));
            fields.extend(self.bytes(u64::from(*kind), 2));
            fields.extend(self.word(*count as u64));
            if content.len() <= word {
                let mut inline = content.clone();
                inline.resize(word, 0);
                fields.extend(inline);
                continue;
            }
            fields.extend(self.word(at));
            tail.extend_from_slice(content);
            if content.len() % 2 == 1 {
                tail.push(0);
            }
            at += content.len().next_multiple_of(2) as u64;
        }
        let count = self.entries.len() as u64;
        tail.extend(self.bytes(count, if self.big { 8 } else { 2 }));
        tail.extend(fields);
        tail.extend(self.word(0));
        at
    }
}
