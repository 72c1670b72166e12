//! Arrays of real numbers in MATLAB 5 files.
//!
//! Written here because the crates for it multiply sizes without care and print to the standard
//! output; a wrong file must be an error.
use flate2::read::ZlibDecoder;
use std::io::Read;

/// An array, columns first.
#[derive(Debug, PartialEq)]
pub(crate) struct MatlabArray {
    pub(crate) size: Vec<u32>,
    pub(crate) values: Vec<f64>,
}

// Kinds of data elements.
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const SINGLE: u32 = 7;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;

/// The flag of complex numbers, in the second byte of an array's flags.
const COMPLEX: u8 = 0x08;

/// The array of the given name, stored as single or double precision; `None` when there is none, or
/// when the file is damaged. At most `limit` bytes of a compressed variable are unpacked.
pub(crate) fn find_array(bytes: &[u8], wanted: &str, limit: u64) -> Option<MatlabArray> {
    let (header, body) = bytes.split_at_checked(128)?;
    if !header.ends_with(b"IM") {
        return None;
    }
    Elements(body).find_map(|(kind, content)| match kind {
        MATRIX => parse_array(content, wanted),
        COMPRESSED => {
            let mut unpacked = Vec::new();
            let mut reader = ZlibDecoder::new(content).take(limit);
            // A variable that is cut by the limit is too large to be the wanted one.
            reader.read_to_end(&mut unpacked).ok()?;
            let (_, content) = Elements(&unpacked).find(|&(kind, _)| kind == MATRIX)?;
            parse_array(content, wanted)
        }
        _ => None,
    })
}

fn parse_array(content: &[u8], wanted: &str) -> Option<MatlabArray> {
    let mut parts = Elements(content);
    let mut part = |kinds: &[u32]| parts.next().filter(|(kind, _)| kinds.contains(kind));
    let (_, flags) = part(&[UINT32])?;
    let (_, size) = part(&[INT32])?;
    let (_, name) = part(&[INT8])?;
    if name != wanted.as_bytes() || flags.get(1)? & COMPLEX != 0 {
        return None;
    }
    let (kind, numbers) = part(&[SINGLE, DOUBLE])?;
    let values = if kind == SINGLE {
        let (numbers, _) = numbers.as_chunks();
        numbers
            .iter()
            .map(|&b| f32::from_le_bytes(b).into())
            .collect()
    } else {
        let (numbers, _) = numbers.as_chunks();
        numbers.iter().map(|&b| f64::from_le_bytes(b)).collect()
    };
    let (size, _) = size.as_chunks();
    Some(MatlabArray {
        size: size.iter().map(|&side| u32::from_le_bytes(side)).collect(),
        values,
    })
}

/// Data elements one after the other: kind and content. Ends at the first that is cut off.
struct Elements<'bytes>(&'bytes [u8]);

impl<'bytes> Iterator for Elements<'bytes> {
    type Item = (u32, &'bytes [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let (head, rest) = self.0.split_at_checked(8)?;
        let (words, _) = head.as_chunks();
        let [kind, size] = [words[0], words[1]].map(u32::from_le_bytes);
        if kind > 0xFFFF {
            // Small elements hold up to four bytes in their head.
            self.0 = rest;
            let content = head.get(4..4 + (kind >> 16) as usize)?;
            return Some((kind & 0xFFFF, content));
        }
        let (content, rest) = rest.split_at_checked(size as usize)?;
        // All but compressed elements are padded to eight bytes, save perhaps the last.
        let padding = if kind == COMPRESSED {
            0
        } else {
            content.len().wrapping_neg() % 8
        };
        self.0 = rest.get(padding..).unwrap_or_default();
        Some((kind, content))
    }
}
