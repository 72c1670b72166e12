//! Bytes of an image to samples.
mod exr;
mod jpeg;
mod library;
pub(crate) mod pfm;
mod raw;
mod source;
mod tiff;

pub(crate) use tiff::paged::PagedTiff;

use crate::color::{ColorMode, Encoding, Statement};
use crate::format::{detect_format, format_name, format_of_extension, split_extension};
use crate::turn::turned;
use crate::{IoError, Limits, Notice};
use image::ImageFormat;
use image::metadata::Orientation;
use normalight_core::{Mask, Samples, StackImage, Transfer};
use raw::{Parted, Raw, parted};
use source::Source;

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

/// Decodes PNG, JPEG, TIFF, TGA, BMP, WebP, EXR, QOI, PNM or PFM from memory.
///
/// Grey stays one channel, everything else becomes RGB; 8, 16 bits and float stay as they are unless
/// a colour profile makes linear light of them.
///
/// # Errors
/// Not an image, more pixels than [`Limits::pixels`] has by default (checked before any memory is
/// taken), cut off, damaged, or of a variant that is not read.
pub fn decode_image(name: &str, bytes: &[u8], color: ColorMode) -> Result<DecodedImage, IoError> {
    let stored = decode_stored(name, bytes, color, &Limits::default())?;
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

/// As [`decode_image`], without turning and within these limits.
pub(crate) fn decode_stored(
    name: &str,
    bytes: &[u8],
    color: ColorMode,
    limits: &Limits,
) -> Result<Stored, IoError> {
    let format = detect_format(name, bytes)?;
    let source = Source {
        name,
        bytes,
        format: format_name(format),
        limits,
    };
    let raw = decode_raw(&source, format)?;
    let (width, height) = (raw.width as usize, raw.height as usize);
    let mut notices = Vec::new();
    if format_of_extension(name) != Some(format) {
        notices.push(Notice::ContentOverExtension {
            file: name.to_owned(),
            content: format_name(format).to_owned(),
            extension: split_extension(name).1.to_owned(),
        });
    }
    notices.extend(raw.notices);
    let Parted {
        samples,
        channels,
        inside,
    } = parted(raw.samples, raw.channels, raw.premultiplied);
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
    if let Samples::F32(values) = &mut samples {
        let file = || name.to_owned();
        if let Some(samples) = tame_nan(values) {
            notices.push(Notice::NotNumbers {
                file: file(),
                samples,
            });
        }
        if let Some(samples) = tame_infinite(values) {
            notices.push(Notice::Infinite {
                file: file(),
                samples,
            });
        }
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
        alpha: inside.map(|inside| Mask::new(width, height, inside)),
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

/// What is not a number becomes 0; how many there were, if any. Renderers and stitchers write it where there is nothing.
fn tame_nan(values: &mut [f32]) -> Option<usize> {
    let mut count = 0;
    for value in values.iter_mut().filter(|value| value.is_nan()) {
        *value = 0.0;
        count += 1;
    }
    (count > 0).then_some(count)
}

/// Infinite values become the largest finite one, or 0 below all; their number, when there were
/// any.
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

fn decode_raw(source: &Source, format: ImageFormat) -> Result<Raw, IoError> {
    match format {
        ImageFormat::Tiff => tiff::decode(source),
        ImageFormat::Jpeg => jpeg::decode(source),
        ImageFormat::OpenExr => exr::decode(source),
        ImageFormat::Pnm if pfm::is_pfm(source.bytes) => pfm::decode(source),
        format => library::decode(source, format),
    }
}
