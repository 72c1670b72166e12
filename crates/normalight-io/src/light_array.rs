//! Lights as an array of numpy.
use crate::IoError;
use crate::light_file::LightRow;
use crate::light_text::{check_direction, wrong_line};
use normalight_core::Vec3;
use npyz::{DType, NpyFile, Order, TypeChar};

/// Rows `x y z` of an array `[lights, 3]` (or `[3, lights]`); `None` for other files.
pub(crate) fn parse(name: &str, bytes: &[u8]) -> Option<Result<Vec<LightRow>, IoError>> {
    bytes.starts_with(b"\x93NUMPY").then(|| {
        let wrong = |found: &str| {
            let expected = "an array of floating-point numbers, lights x 3";
            wrong_line(name, 0, found, expected)
        };
        let (values, columns_first) = values(bytes).ok_or_else(|| wrong("another array"))?;
        let lights = values.len() / 3;
        let place = |light: usize, axis: usize| match columns_first {
            true => axis * lights + light,
            false => 3 * light + axis,
        };
        (0..lights)
            .map(|light| {
                let vector = Vec3::from([0, 1, 2].map(|axis| values[place(light, axis)]));
                check_direction(vector).ok_or_else(|| {
                    wrong_line(
                        name,
                        light + 1,
                        &vector.to_string(),
                        "a finite vector that is not zero",
                    )
                })?;
                Ok(LightRow {
                    file: None,
                    vector,
                    intensity: [1.0; 3],
                    confidence: 1.0,
                })
            })
            .collect()
    })
}

/// The longest head that numpy itself reads.
const MAX_HEAD: usize = 10_000;

/// The head of the file, a dictionary of Python.
fn head(bytes: &[u8]) -> Option<&[u8]> {
    let (length, rest) = match bytes.get(6)? {
        1 => {
            let (length, rest) = bytes.get(8..)?.split_first_chunk()?;
            (usize::from(u16::from_le_bytes(*length)), rest)
        }
        _ => {
            let (length, rest) = bytes.get(8..)?.split_first_chunk()?;
            (u32::from_le_bytes(*length) as usize, rest)
        }
    };
    rest.get(..length).filter(|_| length <= MAX_HEAD)
}

/// Whether the library may see this head: it allocates whatever length is promised, follows brackets to
/// any depth and multiplies the sides of the array without care.
fn is_modest(head: &[u8]) -> bool {
    let brackets = head.iter().filter(|byte| b"([{".contains(byte)).count();
    let digits = head.iter().filter(|byte| byte.is_ascii_digit()).count();
    let mut pairs = head.windows(2);
    // Hexadecimal numbers, exponents, 1_000.
    let odd = |pair: &[u8]| {
        pair[0].is_ascii_digit() && (pair[1].is_ascii_alphabetic() || pair[1] == b'_')
    };
    // One tuple in one dictionary; a product of numbers has no more digits than they.
    brackets <= 2 && digits < 20 && !pairs.any(odd)
}

/// The numbers as stored, and whether all x come first.
fn values(bytes: &[u8]) -> Option<(Vec<f32>, bool)> {
    if !is_modest(head(bytes)?) {
        return None;
    }
    let file = NpyFile::new(bytes).ok()?;
    let transposed = match *file.shape() {
        [_, 3] => false,
        [3, _] => true,
        _ => return None,
    };
    let columns_first = transposed == (file.order() == Order::C);
    // The header may promise more than there is.
    let count = file
        .shape()
        .iter()
        .try_fold(1u64, |a, &b| a.checked_mul(b))?;
    let DType::Plain(kind) = file.dtype() else {
        return None;
    };
    if kind.type_char() != TypeChar::Float || count > bytes.len() as u64 {
        return None;
    }
    let values: Vec<f32> = match kind.size_field() {
        4 => file.into_vec::<f32>().ok()?,
        8 => file
            .into_vec::<f64>()
            .ok()?
            .into_iter()
            .map(|v| v as f32)
            .collect(),
        _ => return None,
    };
    Some((values, columns_first))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(head: &str) -> Vec<u8> {
        let mut file = b"\x93NUMPY\x01\0".to_vec();
        file.extend((head.len() as u16).to_le_bytes());
        file.extend(head.bytes());
        file.extend([0.0f32, 0.6, 0.8].map(f32::to_le_bytes).concat());
        file
    }

    #[test]
    fn strange_heads_do_not_reach_the_library() {
        let head = |shape: &str| {
            file(&format!(
                "{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}"
            ))
        };
        let is_good = |file: &[u8]| super::head(file).is_some_and(is_modest);
        let good = head("(1, 3)");
        assert!(is_good(&good));
        assert_eq!(values(&good), Some((vec![0.0, 0.6, 0.8], false)));
        for shape in [
            // Products that overflow, which panics where overflow is checked.
            "(4294967296, 4294967297, 3)",
            "(0xFFFFFFFFFFFFFFFF, 3)",
            "(9_999_999_999, 3)",
            "((((1, 3))))",
        ] {
            assert!(!is_good(&head(shape)), "{shape}");
        }
        assert!(!is_good(&file(&" ".repeat(MAX_HEAD + 1))));
        // Memory would be set aside for four gigabytes.
        assert!(!is_good(b"\x93NUMPY\x02\0\xFF\xFF\xFF\xFF{"));
        assert!(!is_good(b"\x93NUMPY"));
    }
}
