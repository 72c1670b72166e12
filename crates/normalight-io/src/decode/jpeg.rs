//! JPEG of 8 bits, grey or colour, baseline or progressive.
pub(super) mod marks;

use super::raw::Raw;
use super::source::Source;
use crate::color::{Statement, of_exif, of_profile};
use crate::{IoError, Notice};
use image::metadata::Orientation;
use normalight_core::Samples;
use std::borrow::Cow;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Decodes a whole JPEG; one that is damaged is refused, where `image` would fill what is missing
/// with grey. Not seen is damage that leaves a progressive JPEG coarse, and the loss of less than
/// the last row of blocks.
pub(super) fn decode(source: &Source) -> Result<Raw, IoError> {
    let bytes = source.bytes;
    let frame = marks::frame(bytes).ok_or_else(|| source.damaged("it has no frame"))?;
    source.check_size(frame.width, frame.height)?;
    check_kind(source, &frame)?;
    let end = marks::end(bytes).ok_or_else(|| source.damaged("its end is missing"))?;
    let bytes = to_decode(&bytes[..end], &frame);
    let grey = frame.components == 1;
    let space = if grey {
        ColorSpace::Luma
    } else {
        ColorSpace::RGB
    };
    let options = DecoderOptions::default()
        .set_max_width(usize::MAX)
        .set_max_height(usize::MAX)
        .set_strict_mode(false)
        .jpeg_set_out_colorspace(space);
    let failed = |error| source.damaged(format!("{error}"));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes.as_ref()), options);
    decoder.decode_headers().map_err(failed)?;
    // Stray bytes between headers are common and harmless, damage in the picture is neither.
    decoder.set_options(options.set_strict_mode(true));
    let mut codes = vec![0; decoder.output_buffer_size().unwrap_or(0)];
    decoder.decode_into(&mut codes).map_err(failed)?;
    let channels = if grey { 1 } else { 3 };
    let (width, height) = (frame.width, frame.height);
    if codes.len() != width as usize * height as usize * channels {
        return Err(source.damaged("its size is not that of its frame"));
    }
    let exif = decoder.exif();
    let orientation = exif.and_then(|exif| Orientation::from_exif_chunk(exif));
    let said = exif.map_or(Statement::Nothing, |exif| of_exif(exif.clone()));
    let statement = match decoder.icc_profile() {
        Some(profile) => of_profile(&profile, said),
        None => said,
    };
    let mut notices = Vec::new();
    let pictures = marks::pictures(source.bytes);
    if pictures > 1 {
        notices.push(Notice::SeveralPages {
            file: source.name.to_owned(),
            pages: pictures,
            page: 1,
        });
    }
    Ok(Raw {
        width,
        height,
        channels,
        samples: Samples::U8(codes),
        premultiplied: false,
        statement,
        orientation: orientation.unwrap_or(Orientation::NoTransforms),
        notices,
    })
}

/// A JPEG of one scan with a few zeros for its end mark: before an end mark the decoder fills what
/// is missing in silence, but where a file ends it complains. The zeros are what it looks ahead.
fn to_decode<'a>(whole: &'a [u8], frame: &marks::Frame) -> Cow<'a, [u8]> {
    const AHEAD: [u8; 16] = [0; 16];
    if frame.progressive || marks::scans(whole) != 1 {
        return Cow::Borrowed(whole);
    }
    Cow::Owned([&whole[..whole.len() - 2], &AHEAD].concat())
}

fn check_kind(source: &Source, frame: &marks::Frame) -> Result<(), IoError> {
    if let Some(coding) = frame.uncommon {
        return Err(source.unread(coding, "save it as an ordinary JPEG, or as PNG"));
    }
    if frame.bits != 8 {
        let found = format!("{} bits", frame.bits);
        return Err(source.unread(found, "save it with 8 bits, or as PNG or TIFF of 16 bits"));
    }
    match frame.components {
        1 | 3 => Ok(()),
        4 => Err(source.unread(
            "colours of a print (CMYK)",
            "convert it to RGB and export it again",
        )),
        other => Err(source.unread(format!("{other} channels"), "export it as grey or RGB")),
    }
}
