use crate::format::{detect_format, format_name};
use crate::limits::{MAX_DECODE_BYTES, MAX_PIXELS};
use crate::{IoError, jpeg};
use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use normalight_core::{Mask, Samples, StackImage, Transfer, luminance};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::io::Cursor;

/// How the samples of photographs are taken to relate to light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum ColorMode {
    /// 8-bit JPEG and WebP are sRGB, everything else is linear.
    #[default]
    Auto,
    /// All samples are linear.
    Linear,
    /// All integer samples are sRGB; floating-point ones stay linear.
    Srgb,
}

impl fmt::Display for ColorMode {
    /// The word of the command line and of `report.json`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ColorMode::Auto => "auto",
            ColorMode::Linear => "linear",
            ColorMode::Srgb => "srgb",
        })
    }
}

/// A decoded image: its colours, and its transparency when it has any.
#[derive(Debug, Clone, PartialEq)]
pub struct DecodedImage {
    /// The image without its alpha channel, turned upright as its EXIF orientation says.
    pub image: StackImage,
    /// Pixels whose alpha is above half; `None` without an alpha channel or when all of it is
    /// opaque.
    pub alpha: Option<Mask>,
}

/// Decodes PNG, JPEG, TIFF, TGA, BMP, WebP or EXR from memory.
///
/// Grey stays one channel, everything else becomes RGB; 8, 16 bits and float stay as they are.
///
/// # Errors
/// Not an image, extension and content disagree, more than [`MAX_PIXELS`] (checked before any
/// memory is taken), cut off or damaged.
pub fn decode_image(name: &str, bytes: &[u8], color: ColorMode) -> Result<DecodedImage, IoError> {
    let format = detect_format(name, bytes)?;
    let pixels = decode_pixels(name, bytes, format)?;
    let (width, height) = (pixels.width() as usize, pixels.height() as usize);
    let (samples, channels) = take_samples(pixels).ok_or_else(|| IoError::Decode {
        name: name.to_owned(),
        format: format_name(format),
        reason: "its samples are of an unknown type".to_owned(),
    })?;
    let transfer = transfer_of(color, format, &samples);
    let (samples, channels, alpha) = match samples {
        Samples::U8(all) => {
            let (kept, channels, alpha) = part_alpha(all, channels, |code| code > 127, |c| c < 255);
            (Samples::U8(kept), channels, alpha)
        }
        Samples::U16(all) => {
            let (kept, channels, alpha) =
                part_alpha(all, channels, |code| code > 32_767, |c| c < 65_535);
            (Samples::U16(kept), channels, alpha)
        }
        Samples::F32(all) => {
            let (kept, channels, alpha) = part_alpha(all, channels, |v| v > 0.5, |v| v < 1.0);
            (Samples::F32(kept), channels, alpha)
        }
    };
    Ok(DecodedImage {
        image: StackImage {
            name: name.to_owned(),
            width,
            height,
            channels,
            samples,
            transfer,
        },
        alpha: alpha.map(|inside| Mask::new(width, height, inside)),
    })
}

/// Decodes an image as a mask: inside is where the luminance is above half.
///
/// # Errors
/// As [`decode_image`].
pub fn decode_mask(name: &str, bytes: &[u8]) -> Result<Mask, IoError> {
    let StackImage {
        width,
        height,
        channels,
        samples,
        ..
    } = decode_image(name, bytes, ColorMode::Linear)?.image;
    let values: Vec<f32> = match samples {
        Samples::U8(codes) => codes.iter().map(|&code| f32::from(code) / 255.0).collect(),
        Samples::U16(codes) => codes
            .iter()
            .map(|&code| f32::from(code) / 65_535.0)
            .collect(),
        Samples::F32(values) => values,
    };
    let inside = values
        .chunks_exact(channels)
        .map(|pixel| match *pixel {
            [r, g, b] => luminance([r, g, b]) > 0.5,
            _ => pixel[0] > 0.5,
        })
        .collect();
    Ok(Mask::new(width, height, inside))
}

fn decode_pixels(name: &str, bytes: &[u8], format: ImageFormat) -> Result<DynamicImage, IoError> {
    let failed = |reason: String| IoError::Decode {
        name: name.to_owned(),
        format: format_name(format),
        reason,
    };
    let failed_decoding = |error: ImageError| match error {
        // Some decoders look at the memory before anyone can ask for the size.
        ImageError::Limits(_) => failed(format!(
            "it needs too much memory; images of at most {MAX_PIXELS} pixels are read"
        )),
        error => failed(error.to_string()),
    };
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_DECODE_BYTES);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(failed_decoding)?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(IoError::TooManyPixels {
            name: name.to_owned(),
            width,
            height,
            limit: MAX_PIXELS,
        });
    }
    if width == 0 || height == 0 {
        return Err(failed(format!("it has {width}x{height} pixels")));
    }
    if format == ImageFormat::Jpeg && !jpeg::is_complete(bytes) {
        return Err(failed("its end is missing".to_owned()));
    }
    let orientation = decoder.orientation().map_err(failed_decoding)?;
    let mut pixels = DynamicImage::from_decoder(decoder).map_err(failed_decoding)?;
    pixels.apply_orientation(orientation);
    Ok(pixels)
}

/// The samples of an image and its number of channels, alpha included.
fn take_samples(pixels: DynamicImage) -> Option<(Samples, usize)> {
    Some(match pixels {
        DynamicImage::ImageLuma8(buffer) => (Samples::U8(buffer.into_raw()), 1),
        DynamicImage::ImageLumaA8(buffer) => (Samples::U8(buffer.into_raw()), 2),
        DynamicImage::ImageRgb8(buffer) => (Samples::U8(buffer.into_raw()), 3),
        DynamicImage::ImageRgba8(buffer) => (Samples::U8(buffer.into_raw()), 4),
        DynamicImage::ImageLuma16(buffer) => (Samples::U16(buffer.into_raw()), 1),
        DynamicImage::ImageLumaA16(buffer) => (Samples::U16(buffer.into_raw()), 2),
        DynamicImage::ImageRgb16(buffer) => (Samples::U16(buffer.into_raw()), 3),
        DynamicImage::ImageRgba16(buffer) => (Samples::U16(buffer.into_raw()), 4),
        DynamicImage::ImageRgb32F(buffer) => (Samples::F32(buffer.into_raw()), 3),
        DynamicImage::ImageRgba32F(buffer) => (Samples::F32(buffer.into_raw()), 4),
        _ => return None,
    })
}

fn transfer_of(color: ColorMode, format: ImageFormat, samples: &Samples) -> Transfer {
    match (color, samples) {
        (_, Samples::F32(_)) | (ColorMode::Linear, _) => Transfer::Linear,
        (ColorMode::Srgb, _) => Transfer::Srgb,
        (ColorMode::Auto, Samples::U8(_))
            if matches!(format, ImageFormat::Jpeg | ImageFormat::WebP) =>
        {
            Transfer::Srgb
        }
        (ColorMode::Auto, _) => Transfer::Linear,
    }
}

/// Parts interleaved samples into colours and alpha; the alpha is dropped when all of it is opaque.
fn part_alpha<T: Copy>(
    samples: Vec<T>,
    channels: usize,
    is_inside: impl Fn(T) -> bool,
    is_transparent: impl Fn(T) -> bool,
) -> (Vec<T>, usize, Option<Vec<bool>>) {
    if channels % 2 == 1 {
        return (samples, channels, None);
    }
    let colours = channels - 1;
    let alpha = samples.iter().skip(colours).step_by(channels).copied();
    let inside = alpha
        .clone()
        .any(is_transparent)
        .then(|| alpha.map(is_inside).collect());
    let kept = samples
        .chunks_exact(channels)
        .flat_map(|pixel| &pixel[..colours])
        .copied()
        .collect();
    (kept, colours, inside)
}
