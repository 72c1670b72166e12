//! Bytes of an image to samples.
mod exr;
pub(crate) mod pfm;
mod tiff;

use crate::color::{ColorMode, Encoding, Statement, of_exif, of_png, of_profile};
use crate::format::{detect_format, format_name, format_of_extension, split_extension};
use crate::limits::{MAX_DECODE_BYTES, MAX_PIXELS};
use crate::turn::turned;
use crate::{IoError, Notice, jpeg};
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use normalight_core::{Mask, Samples, StackImage, Transfer};
use std::io::Cursor;

/// A decoded image: its colours, and its transparency when it has any.
#[derive(Debug, Clone, PartialEq)]
pub struct DecodedImage {
    /// The image without its alpha channel, turned upright as its EXIF orientation says.
    pub image: StackImage,
    /// Pixels whose alpha is above half; `None` without an alpha channel or when all of it is
    /// opaque.
    pub alpha: Option<Mask>,
}

/// An image as it is stored.
pub(crate) struct Stored {
    pub(crate) image: StackImage,
    pub(crate) alpha: Option<Mask>,
    /// How it would be turned upright.
    pub(crate) orientation: Orientation,
    /// How its samples were taken, in words; `None` when nothing says how to take them.
    pub(crate) stated: Option<String>,
    pub(crate) notices: Vec<Notice>,
}

/// Samples with all channels, and what the file says about them.
struct Raw {
    width: u32,
    height: u32,
    channels: usize,
    samples: Samples,
    statement: Statement,
    orientation: Orientation,
    pages: usize,
}

/// Decodes PNG, JPEG, TIFF, TGA, BMP, WebP, EXR, PNM or PFM from memory.
///
/// Grey stays one channel, everything else becomes RGB; 8, 16 bits and float stay as they are unless
/// a colour profile makes linear light of them.
///
/// # Errors
/// Not an image, more than [`MAX_PIXELS`] (checked before any memory is taken), cut off or damaged.
pub fn decode_image(name: &str, bytes: &[u8], color: ColorMode) -> Result<DecodedImage, IoError> {
    let stored = decode_stored(name, bytes, color)?;
    Ok(DecodedImage {
        image: turned(stored.image, stored.orientation),
        alpha: stored
            .alpha
            .map(|mask| turned_mask(mask, stored.orientation)),
    })
}

/// A mask turned upright.
pub(crate) fn turned_mask(mask: Mask, orientation: Orientation) -> Mask {
    let image = StackImage {
        name: String::new(),
        width: mask.width(),
        height: mask.height(),
        channels: 1,
        samples: Samples::U8(
            mask.inside()
                .iter()
                .map(|&inside| u8::from(inside))
                .collect(),
        ),
        transfer: Transfer::Linear,
    };
    let image = turned(image, orientation);
    let Samples::U8(inside) = image.samples else {
        return mask;
    };
    let inside = inside.iter().map(|&inside| inside > 0).collect();
    Mask::new(image.width, image.height, inside)
}

/// As [`decode_image`], without turning.
pub(crate) fn decode_stored(name: &str, bytes: &[u8], color: ColorMode) -> Result<Stored, IoError> {
    let format = detect_format(name, bytes)?;
    let raw = decode_raw(name, bytes, format)?;
    let (width, height) = (raw.width as usize, raw.height as usize);
    let mut notices = Vec::new();
    if format_of_extension(name) != Some(format) {
        notices.push(Notice::ContentOverExtension {
            file: name.to_owned(),
            content: format_name(format).to_owned(),
            extension: split_extension(name).1.to_owned(),
        });
    }
    if raw.pages > 1 {
        notices.push(Notice::SeveralPages {
            file: name.to_owned(),
            pages: raw.pages,
        });
    }
    let (samples, channels, alpha) = part_alpha(raw.samples, raw.channels);
    let statement = taken(color, format, &samples, raw.statement);
    if let Statement::Unknown { reason, instead } = &statement {
        notices.push(Notice::ProfileNotUnderstood {
            file: name.to_owned(),
            reason: reason.clone(),
            taken: instead.words(),
        });
    }
    let stated = (!matches!(statement, Statement::Nothing)).then(|| statement.words());
    let (mut samples, transfer) = match (&statement, &samples) {
        // Nothing says anything: 8 bits are nearly always made for viewing.
        (Statement::Nothing, Samples::U8(_)) => (samples, Transfer::Srgb),
        _ => statement.apply(samples, channels),
    };
    if let Samples::F32(values) = &mut samples
        && let Some(samples) = tame_infinite(values)
    {
        notices.push(Notice::Infinite {
            file: name.to_owned(),
            samples,
        });
    }
    Ok(Stored {
        image: StackImage {
            name: name.to_owned(),
            width,
            height,
            channels,
            samples,
            transfer,
        },
        alpha: alpha.map(|inside| Mask::new(width, height, inside)),
        orientation: raw.orientation,
        stated,
        notices,
    })
}

/// What is believed about the samples.
fn taken(color: ColorMode, format: ImageFormat, samples: &Samples, said: Statement) -> Statement {
    let floating = matches!(samples, Samples::F32(_));
    match (color, said) {
        (ColorMode::Linear, _) => Statement::Linear,
        (ColorMode::Srgb, _) if !floating => Statement::Srgb,
        (ColorMode::Srgb, _) => Statement::Linear,
        (ColorMode::Auto, Statement::Nothing) if floating => Statement::Linear,
        (ColorMode::Auto, Statement::Nothing)
            if matches!(format, ImageFormat::Jpeg | ImageFormat::WebP) =>
        {
            Statement::Srgb
        }
        // The curve goes on beyond full scale.
        (ColorMode::Auto, Statement::Srgb) if floating => Statement::Encoded(Encoding::srgb()),
        (ColorMode::Auto, said) => said,
    }
}

/// Infinite values become the largest finite one; their number, when there were any.
fn tame_infinite(values: &mut [f32]) -> Option<usize> {
    let largest = values.iter().copied().filter(|value| value.is_finite());
    let largest = largest.fold(0.0, f32::max);
    if largest <= 0.0 {
        return None;
    }
    let mut count = 0;
    for value in values.iter_mut().filter(|value| value.is_infinite()) {
        *value = if *value > 0.0 { largest } else { 0.0 };
        count += 1;
    }
    (count > 0).then_some(count)
}

fn decode_raw(name: &str, bytes: &[u8], format: ImageFormat) -> Result<Raw, IoError> {
    let failed = |reason: String| IoError::Decode {
        name: name.to_owned(),
        format: format_name(format),
        reason,
    };
    if format == ImageFormat::Tiff {
        let page = tiff::decode(bytes).map_err(|failure| match failure {
            tiff::Failure::Reason(reason) => failed(reason),
            tiff::Failure::TooManyPixels(width, height) => too_large(name, width, height),
        })?;
        return Ok(Raw {
            width: page.width,
            height: page.height,
            channels: page.channels,
            samples: page.samples,
            statement: page.statement,
            orientation: page.orientation,
            pages: page.pages,
        });
    }
    let (pixels, statement, orientation) = decode_pixels(name, bytes, format)?;
    let (width, height) = (pixels.width(), pixels.height());
    let (samples, channels) = take_samples(pixels)
        .ok_or_else(|| failed("its samples are of an unknown type".to_owned()))?;
    Ok(Raw {
        width,
        height,
        channels,
        samples,
        statement,
        orientation,
        pages: 1,
    })
}

fn too_large(name: &str, width: u32, height: u32) -> IoError {
    IoError::TooManyPixels {
        name: name.to_owned(),
        width,
        height,
        limit: MAX_PIXELS,
    }
}

fn decode_pixels(
    name: &str,
    bytes: &[u8],
    format: ImageFormat,
) -> Result<(DynamicImage, Statement, Orientation), IoError> {
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
    let check = |(width, height): (u32, u32)| match u64::from(width) * u64::from(height) {
        0 => Err(failed(format!("it has {width}x{height} pixels"))),
        pixels if pixels > MAX_PIXELS => Err(too_large(name, width, height)),
        _ => Ok(()),
    };
    if pfm::is_pfm(bytes) && format == ImageFormat::Pnm {
        let damaged = || failed("its float map is damaged".to_owned());
        check(pfm::size(bytes).ok_or_else(damaged)?)?;
        let pixels = pfm::decode(bytes).ok_or_else(damaged)?;
        return Ok((pixels, Statement::Linear, Orientation::NoTransforms));
    }
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_DECODE_BYTES);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let mut decoder = match reader.into_decoder() {
        Err(_) if format == ImageFormat::OpenExr => {
            let pixels = exr::decode(bytes).map_err(failed)?;
            return Ok((pixels, exr::statement(bytes), Orientation::NoTransforms));
        }
        decoder => decoder.map_err(failed_decoding)?,
    };
    check(decoder.dimensions())?;
    if format == ImageFormat::Jpeg && !jpeg::is_complete(bytes) {
        return Err(failed("its end is missing".to_owned()));
    }
    let statement = match format {
        ImageFormat::Png => of_png(bytes),
        ImageFormat::OpenExr => exr::statement(bytes),
        // A damaged profile or block must not hide a good picture.
        _ => {
            let exif = decoder.exif_metadata().ok().flatten();
            let exif = exif.map_or(Statement::Nothing, of_exif);
            match decoder.icc_profile() {
                Ok(Some(profile)) => of_profile(&profile, exif),
                _ => exif,
            }
        }
    };
    let orientation = decoder.orientation().map_err(failed_decoding)?;
    let pixels = DynamicImage::from_decoder(decoder).map_err(failed_decoding)?;
    Ok((pixels, statement, orientation))
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

/// Colours, their number of channels, and which pixels are opaque.
fn part_alpha(samples: Samples, channels: usize) -> (Samples, usize, Option<Vec<bool>>) {
    match samples {
        Samples::U8(all) => {
            let (kept, channels, alpha) = parted(all, channels, |code| code > 127, |c| c < 255);
            (Samples::U8(kept), channels, alpha)
        }
        Samples::U16(all) => {
            let (kept, channels, alpha) =
                parted(all, channels, |code| code > 32_767, |c| c < 65_535);
            (Samples::U16(kept), channels, alpha)
        }
        Samples::F32(all) => {
            let (kept, channels, alpha) = parted(all, channels, |v| v > 0.5, |v| v < 1.0);
            (Samples::F32(kept), channels, alpha)
        }
    }
}

/// Parts interleaved samples into colours and alpha; the alpha is dropped when all of it is opaque.
fn parted<T: Copy>(
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
