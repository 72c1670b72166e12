//! Arrays of real numbers in MATLAB 5 files, read and written.
//!
//! Written here because the crates for it multiply sizes without care and print to the standard
//! output; a wrong file must be an error.
use crate::IoError;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use normalight_core::NormalMap;
use std::io::{self, Read, Write};

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

/// The class of an array of single precision.
const SINGLE_ARRAY: u8 = 7;

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

/// Normals as a MATLAB 5 file with one array `[height, width, 3]` of single precision, compressed: components x right, y up,
/// z to the camera, -1..1, zero where there is no normal. `name` is the array's.
///
/// # Errors
/// [`IoError::Encode`] for an array of 4 GiB or more.
pub fn normals_mat(name: &str, normals: &NormalMap) -> Result<Vec<u8>, IoError> {
    write_array(name, normals).map_err(|error| IoError::Encode {
        name: "normal map",
        reason: error.to_string(),
    })
}

fn write_array(name: &str, normals: &NormalMap) -> io::Result<Vec<u8>> {
    let (width, height) = (normals.width(), normals.height());
    let size = [height as i32, width as i32, 3].map(i32::to_le_bytes);
    // MATLAB stores columns first.
    let values = (0..3 * width * height).flat_map(|at| {
        let (plane, column, row) = (at / (width * height), at / height % width, at % height);
        normals.normals()[row * width + column][plane].to_le_bytes()
    });
    let parts = [
        // The array's class and its flags, of which it has none.
        element(UINT32, &[SINGLE_ARRAY, 0, 0, 0, 0, 0, 0, 0])?,
        element(INT32, &size.concat())?,
        element(INT8, name.as_bytes())?,
        element(SINGLE, &values.collect::<Vec<u8>>())?,
    ];
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(&element(MATRIX, &parts.concat())?)?;
    let mut file = b"MATLAB 5.0 MAT-file, written by Normalight".to_vec();
    file.resize(124, b' ');
    // Version 1.0, and the mark of little-endian files.
    file.extend([0x00, 0x01, b'I', b'M']);
    let packed = element(COMPRESSED, &packed.finish()?)?;
    file.extend(packed);
    Ok(file)
}

/// A data element: kind, size, content, and padding to eight bytes after all but compressed ones.
fn element(kind: u32, content: &[u8]) -> io::Result<Vec<u8>> {
    let size = u32::try_from(content.len()).map_err(io::Error::other)?;
    let mut bytes = [kind.to_le_bytes(), size.to_le_bytes()].concat();
    bytes.extend(content);
    if kind != COMPRESSED {
        bytes.resize(bytes.len().next_multiple_of(8), 0);
    }
    Ok(bytes)
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

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_core::Vec3;

    #[test]
    fn what_is_written_is_read_columns_first() {
        let normal = |at: usize| Vec3::new(at as f32 / 8.0, -0.5, 0.0);
        let map = NormalMap::new(3, 2, (0..6).map(normal).collect());
        let file = normals_mat("Normal_est", &map).unwrap();
        let array = find_array(&file, "Normal_est", 1 << 16).unwrap();
        assert_eq!(array.size, [2, 3, 3]);
        // Down each column, one column after the other, one component after the other.
        let places = [0, 3, 1, 4, 2, 5];
        let expected =
            (0..3).flat_map(|plane| places.map(|at| f64::from(map.normals()[at][plane])));
        assert_eq!(array.values, expected.collect::<Vec<f64>>());
        assert!(find_array(&file, "Normal_gt", 1 << 16).is_none());
    }
}
