//! Single photographs as files and as small pictures.
use crate::IoError;
use normalight_core::{Samples, StackImage, Transfer};

/// Samples per side that stand for one pixel of a thumbnail: enough against flicker, and as quick
/// for a large photograph as for a small one.
const TAPS: usize = 3;

/// A photograph in few pixels, for lists.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Thumbnail {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// 8-bit sRGB with full alpha.
    ///
    /// `[height, width, 4]`, rows from the top
    pub rgba: Vec<u8>,
}

/// A photograph whose longer side is brought down to `side` pixels; smaller ones keep their size.
pub fn thumbnail(image: &StackImage, side: usize) -> Thumbnail {
    let longer = image.width.max(image.height).max(1);
    let scale = side.clamp(1, longer) as f32 / longer as f32;
    let small = |length: usize| ((length as f32 * scale).round() as usize).clamp(1, length.max(1));
    let (width, height) = (small(image.width), small(image.height));
    let mut rgba = Vec::with_capacity(4 * width * height);
    for row in 0..height {
        let rows = taps(row, height, image.height);
        for column in 0..width {
            let columns = taps(column, width, image.width);
            for channel in 0..3 {
                let places = rows
                    .iter()
                    .flat_map(|y| columns.iter().map(move |x| y * image.width + x));
                let sum: f32 = places.map(|pixel| linear(image, pixel, channel)).sum();
                let mean = (sum / (TAPS * TAPS) as f32).clamp(0.0, 1.0);
                rgba.push((Transfer::Srgb.encode(mean) * 255.0).round() as u8);
            }
            rgba.push(255);
        }
    }
    Thumbnail {
        width,
        height,
        rgba,
    }
}

/// Positions in `0..long`, evenly spread over the stretch that place `index` of `short` stands for.
fn taps(index: usize, short: usize, long: usize) -> [usize; TAPS] {
    std::array::from_fn(|tap| (2 * (index * TAPS + tap) + 1) * long / (2 * TAPS * short))
}

fn linear(image: &StackImage, pixel: usize, channel: usize) -> f32 {
    let index = pixel * image.channels + channel.min(image.channels - 1);
    match &image.samples {
        Samples::U8(codes) => image.transfer.decode(f32::from(codes[index]) / 255.0),
        Samples::U16(codes) => image.transfer.decode(f32::from(codes[index]) / 65_535.0),
        // Already linear, whatever the transfer says.
        Samples::F32(values) => values[index],
    }
}

/// A photograph as PNG with the samples it has, 8 or 16 bit, grey or RGB; a chunk says how they
/// relate to light (gAMA 1 for linear samples, sRGB else).
///
/// # Errors
/// [`IoError::Encode`] for floating-point samples, which PNG cannot hold, and for an image whose
/// samples do not fit its size.
pub fn photograph_png(image: &StackImage) -> Result<Vec<u8>, IoError> {
    let failed = |reason: String| IoError::Encode {
        name: "photograph",
        reason,
    };
    let (bits, data) = match &image.samples {
        Samples::U8(codes) => (png::BitDepth::Eight, codes.clone()),
        Samples::U16(codes) => {
            let bytes = codes.iter().flat_map(|code| code.to_be_bytes());
            (png::BitDepth::Sixteen, bytes.collect())
        }
        Samples::F32(_) => {
            return Err(failed("PNG holds no floating-point samples".to_owned()));
        }
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width as u32, image.height as u32);
    encoder.set_depth(bits);
    encoder.set_color(match image.channels {
        1 => png::ColorType::Grayscale,
        _ => png::ColorType::Rgb,
    });
    match image.transfer {
        Transfer::Linear => encoder.set_source_gamma(png::ScaledFloat::new(1.0)),
        Transfer::Srgb => encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual),
    }
    let mut writer = encoder
        .write_header()
        .map_err(|error| failed(error.to_string()))?;
    writer
        .write_image_data(&data)
        .map_err(|error| failed(error.to_string()))?;
    writer.finish().map_err(|error| failed(error.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ColorMode, decode_image};

    fn image(samples: Samples, channels: usize, transfer: Transfer) -> StackImage {
        StackImage {
            name: "a.png".to_owned(),
            width: 6,
            height: 4,
            channels,
            samples,
            transfer,
        }
    }

    #[test]
    fn thumbnails_keep_shape_and_brightness() {
        let grey = image(Samples::U8(vec![188; 24]), 1, Transfer::Srgb);
        let small = thumbnail(&grey, 3);
        assert_eq!((small.width, small.height), (3, 2));
        assert_eq!(small.rgba[..4], [188, 188, 188, 255]);
        let same = thumbnail(&grey, 100);
        assert_eq!((same.width, same.height), (6, 4));

        let halves = (0..24).map(|k| if k % 6 < 3 { 0.0 } else { 2.0 }).collect();
        let small = thumbnail(&image(Samples::F32(halves), 1, Transfer::Linear), 2);
        assert_eq!((small.width, small.height), (2, 1));
        assert_eq!(small.rgba, [0, 0, 0, 255, 255, 255, 255, 255]);
    }

    #[test]
    fn photographs_come_back_from_png() {
        for (samples, channels) in [
            (Samples::U8((0..24).collect()), 1),
            (Samples::U16((0..72).map(|k| k * 900).collect()), 3),
        ] {
            let before = image(samples, channels, Transfer::Linear);
            let bytes = photograph_png(&before).unwrap();
            let after = decode_image("a.png", &bytes, ColorMode::Auto).unwrap();
            assert_eq!(after.image, before);
        }
        let float = image(Samples::F32(vec![0.5; 24]), 1, Transfer::Linear);
        assert!(photograph_png(&float).is_err());
    }
}
