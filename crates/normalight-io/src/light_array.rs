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

/// The numbers as stored, and whether all x come first.
fn values(bytes: &[u8]) -> Option<(Vec<f32>, bool)> {
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
