//! Masks as programs write them.
use crate::color::mapped;
use crate::decode::{Stored, decode_stored, turned_mask};
use crate::{ColorMode, IoError, Limits, Notice};
use normalight_core::{Mask, luminance};

/// A mask from a file, with what is doubtful about it.
pub(crate) struct MaskFile {
    pub(crate) mask: Mask,
    pub(crate) notices: Vec<Notice>,
}

/// Decodes an image as a mask: inside is what is above the middle of its values. Where all colours
/// are the same, the transparency is the mask; a mask that is bright at the border of the frame
/// and dark inside is inverted.
///
/// # Errors
/// As [`decode_image`](crate::decode_image).
pub fn decode_mask(name: &str, bytes: &[u8]) -> Result<Mask, IoError> {
    Ok(read(name, bytes, &Limits::default())?.mask)
}

/// As [`decode_mask`], with what is doubtful, within these limits.
pub(crate) fn read(name: &str, bytes: &[u8], limits: &Limits) -> Result<MaskFile, IoError> {
    let Stored {
        image,
        alpha,
        orientation,
        mut notices,
        ..
    } = decode_stored(name, bytes, ColorMode::Linear, limits)?;
    let values = mapped(&image.samples, |value| value);
    let grey: Vec<f32> = values
        .chunks_exact(image.channels)
        .map(|pixel| match *pixel {
            [r, g, b] => luminance([r, g, b]),
            _ => pixel[0],
        })
        .collect();
    let file = || name.to_owned();
    let (low, high) = grey
        .iter()
        .fold((f32::MAX, f32::MIN), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
    let mask = match alpha {
        Some(alpha) if high - low < 1e-3 => {
            notices.push(Notice::MaskFromTransparency { file: file() });
            alpha
        }
        _ => {
            // Two values are a mask whatever they are; labels of parts all are the object.
            let above = threshold(&grey, low, high);
            if low < high && (low > 0.02 || high < 0.98) {
                notices.push(Notice::MaskValues {
                    file: file(),
                    values: vec![low, high],
                    above,
                });
            }
            let inside = grey.iter().map(|&value| value > above).collect();
            let mask = Mask::new(image.width, image.height, inside);
            match is_inverted(&mask) {
                true => {
                    notices.push(Notice::MaskInverted { file: file() });
                    let inside = mask.inside().iter().map(|inside| !inside).collect();
                    Mask::new(image.width, image.height, inside)
                }
                false => mask,
            }
        }
    };
    Ok(MaskFile {
        mask: turned_mask(mask, orientation),
        notices,
    })
}

/// The value above which a pixel is inside.
fn threshold(grey: &[f32], low: f32, high: f32) -> f32 {
    if high - low < 1e-6 {
        return 0.5;
    }
    let middle = (low + high) / 2.0;
    // Small numbers of parts: 0 is outside, all others are the object.
    let mut labels: Vec<u32> = Vec::new();
    for value in grey {
        let bits = value.to_bits();
        if !labels.contains(&bits) {
            labels.push(bits);
        }
        if labels.len() > 16 {
            return middle;
        }
    }
    let dark = high < 0.1;
    match dark && labels.len() > 2 && low == 0.0 {
        true => {
            grey.iter()
                .copied()
                .filter(|&value| value > 0.0)
                .fold(high, f32::min)
                / 2.0
        }
        false => middle,
    }
}

/// Whether the border of the frame is inside, and the middle of what is outside lies in the frame.
fn is_inverted(mask: &Mask) -> bool {
    let (width, height) = (mask.width(), mask.height());
    let border = (0..width * height).filter(|&pixel| {
        let (x, y) = (pixel % width, pixel / width);
        x == 0 || y == 0 || x + 1 == width || y + 1 == height
    });
    let (mut lit, mut all) = (0, 0);
    for pixel in border {
        all += 1;
        lit += usize::from(mask.inside()[pixel]);
    }
    let outside = width * height - mask.count();
    // Objects that fill the frame have bright borders too, but little that is outside.
    20 * lit >= 19 * all && 50 * outside >= width * height
}
