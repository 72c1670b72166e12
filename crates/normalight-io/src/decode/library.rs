//! Formats that the library `image` reads right as it is: PNG, WebP, BMP, TGA, QOI, PNM.
use super::raw::Raw;
use super::source::Source;
use crate::color::{Statement, of_exif, of_png, of_profile};
use crate::{IoError, Notice};
use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use normalight_core::Samples;
use std::io::Cursor;

pub(super) fn decode(source: &Source, format: ImageFormat) -> Result<Raw, IoError> {
    let failed = |error: ImageError| match error {
        // Some decoders look at the memory before anyone can ask for the size.
        ImageError::Limits(_) => source.too_much_memory(),
        error => source.damaged(error.to_string()),
    };
    let mut limits = Limits::default();
    limits.max_alloc = Some(source.limits.decode_bytes());
    let mut reader = ImageReader::with_format(Cursor::new(source.bytes), format);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    source.check_size(width, height)?;
    let statement = match format {
        ImageFormat::Png => of_png(source.bytes),
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
    let orientation = decoder.orientation().map_err(failed)?;
    let pixels = DynamicImage::from_decoder(decoder).map_err(failed)?;
    let (samples, channels) =
        samples(pixels).ok_or_else(|| source.damaged("its samples are of an unknown type"))?;
    let mut notices = Vec::new();
    if is_animated(source.bytes, format) {
        notices.push(Notice::Animation {
            file: source.name.to_owned(),
        });
    }
    Ok(Raw {
        width,
        height,
        channels,
        samples,
        premultiplied: false,
        statement,
        orientation,
        notices,
    })
}

/// The samples of an image and its number of channels, alpha included.
fn samples(pixels: DynamicImage) -> Option<(Samples, usize)> {
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

/// Whether a PNG counts several pictures (acTL of the third edition), or a WebP says that it moves.
fn is_animated(bytes: &[u8], format: ImageFormat) -> bool {
    match format {
        ImageFormat::Png => {
            let reader = png::Decoder::new(Cursor::new(bytes)).read_info();
            let control = reader
                .ok()
                .and_then(|reader| reader.info().animation_control);
            control.is_some_and(|control| control.num_frames > 1)
        }
        // The flags of the extended header.
        ImageFormat::WebP => {
            bytes.get(12..16) == Some(b"VP8X") && bytes.get(20).is_some_and(|flags| flags & 2 != 0)
        }
        _ => false,
    }
}
