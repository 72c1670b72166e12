//! Normal maps that were made elsewhere.
use crate::{ColorMode, IoError, NormalFormat, decode_image};
use normalight_core::{Mask, NormalMap, Samples, Vec3};
use npyz::{DType, NpyFile, Order, TypeChar};

/// A vector this short is no normal but the absence of one: black or middle grey in images.
const SHORTEST: f32 = 0.5;

/// Reads a normal map and the pixels that have a normal: an image of `(n + 1) / 2` (8 or 16 bits), an image of
/// floating-point numbers -1..1, or a NumPy array of floating-point numbers `[height, width, 3]`.
///
/// Pixels that are black, grey or transparent have none. `format` says which way green points.
///
/// # Errors
/// Those of [`decode_image`]; [`IoError::NormalFormat`] for a grey image, an array of another shape, or one
/// without any normal.
pub fn read_normals(
    name: &str,
    bytes: &[u8],
    format: NormalFormat,
) -> Result<(NormalMap, Mask), IoError> {
    let (size, vectors) = match bytes.starts_with(b"\x93NUMPY") {
        true => array(name, bytes)?,
        false => picture(name, bytes)?,
    };
    let normals: Vec<Vec3> = vectors
        .into_iter()
        .map(|[x, y, z]| Vec3::from(format.exported(Vec3::new(x, y, z))))
        .map(|normal| match normal.length() >= SHORTEST {
            true => normal,
            // Not a number is not long enough either.
            false => Vec3::ZERO,
        })
        .collect();
    let inside: Vec<bool> = normals.iter().map(|&normal| normal != Vec3::ZERO).collect();
    if !inside.contains(&true) {
        return Err(wrong(name, "no pixel with a normal"));
    }
    Ok((
        NormalMap::new(size.0, size.1, normals),
        Mask::new(size.0, size.1, inside),
    ))
}

type Vectors = ((usize, usize), Vec<[f32; 3]>);

fn wrong(name: &str, found: impl Into<String>) -> IoError {
    IoError::NormalFormat {
        name: name.to_owned(),
        found: found.into(),
    }
}

fn picture(name: &str, bytes: &[u8]) -> Result<Vectors, IoError> {
    let decoded = decode_image(name, bytes, ColorMode::Linear)?;
    let image = decoded.image;
    if image.channels != 3 {
        return Err(wrong(
            name,
            format!("an image of {} channel(s)", image.channels),
        ));
    }
    let values: Vec<f32> = match image.samples {
        Samples::U8(samples) => samples
            .into_iter()
            .map(|code| f32::from(code) / 127.5 - 1.0)
            .collect(),
        Samples::U16(samples) => samples
            .into_iter()
            .map(|code| f32::from(code) / 32_767.5 - 1.0)
            .collect(),
        Samples::F32(samples) => samples,
    };
    let mut vectors = values.as_chunks::<3>().0.to_vec();
    for vector in &mut vectors {
        // Black stands for nothing in images, though it would be a direction.
        if *vector == [-1.0; 3] {
            *vector = [0.0; 3];
        }
    }
    if let Some(alpha) = decoded.alpha {
        for (vector, &inside) in vectors.iter_mut().zip(alpha.inside()) {
            if !inside {
                *vector = [0.0; 3];
            }
        }
    }
    Ok(((image.width, image.height), vectors))
}

fn array(name: &str, bytes: &[u8]) -> Result<Vectors, IoError> {
    let file = NpyFile::new(bytes).map_err(|error| wrong(name, error.to_string()))?;
    let (height, width) = match (file.shape(), file.order()) {
        (shape, Order::C) if shape.len() == 3 && shape[2] == 3 => (shape[0], shape[1]),
        (shape, _) => return Err(wrong(name, format!("an array of shape {shape:?}"))),
    };
    let pixels = height.saturating_mul(width);
    if pixels == 0 || pixels > crate::MAX_PIXELS {
        return Err(wrong(name, format!("{width}x{height} pixels")));
    }
    let size = match file.dtype() {
        DType::Plain(kind) if kind.type_char() == TypeChar::Float => kind.size_field(),
        other => return Err(wrong(name, format!("numbers of type {}", other.descr()))),
    };
    // The header may promise more than there is.
    if (bytes.len() as u64) < 3 * pixels * size {
        return Err(wrong(name, format!("{} bytes", bytes.len())));
    }
    let failed = |error: std::io::Error| wrong(name, error.to_string());
    let values: Vec<f32> = match size {
        4 => file.into_vec().map_err(failed)?,
        8 => {
            let values: Vec<f64> = file.into_vec().map_err(failed)?;
            values.into_iter().map(|value| value as f32).collect()
        }
        _ => return Err(wrong(name, format!("numbers of {size} bytes"))),
    };
    Ok((
        (width as usize, height as usize),
        values.as_chunks().0.to_vec(),
    ))
}
