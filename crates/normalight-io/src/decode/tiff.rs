//! TIFF of all kinds that scientific programs and cameras write.
mod bare;
mod codes;
mod colors;
pub(super) mod directory;
mod layout;
mod new_directory;
pub(crate) mod paged;
mod pages;
mod tags;

use super::raw::Raw;
use super::source::Source;
use crate::color::{ExifColor, Statement, of_profile};
use crate::{IoError, Notice};
use bare::Bare;
use codes::Codes;
use colors::Meaning;
use directory::{Directory, File};
use image::metadata::Orientation;
use layout::Layout;
use tiff::TiffError;
use tiff::decoder::{Decoder, DecodingResult, Limits};

/// The first page that is a picture and no preview.
///
/// # Errors
/// Damaged, raw data of a camera, or a variant that is not read.
pub(super) fn decode(source: &Source) -> Result<Raw, IoError> {
    let file = File::new(source.bytes).ok_or_else(|| source.damaged("its head is damaged"))?;
    let pages::Pages { page, number, of } = pages::find(source, &file)?;
    let layout = Layout::new(source, &page)?;
    let meaning = Meaning::new(source, &page, &layout)?;
    let codes = chosen(source, &page, &layout, &meaning.places())?;
    let mut notices = Vec::new();
    if of > 1 {
        notices.push(Notice::SeveralPages {
            file: source.name.to_owned(),
            pages: of,
            page: number,
        });
    }
    notices.extend(meaning.notice(source, &layout));
    let samples = meaning.apply(source, &page, codes)?;
    let orientation = page
        .one(tags::ORIENTATION)
        .map(|value| value.min(255) as u8);
    Ok(Raw {
        width: layout.width,
        height: layout.height,
        channels: meaning.channels(),
        samples,
        premultiplied: meaning.premultiplied,
        statement: statement(&file, &page),
        orientation: orientation
            .and_then(Orientation::from_exif)
            .unwrap_or(Orientation::NoTransforms),
        notices,
    })
}

/// Some channels of a page. Planes are read one by one, as pages of their own: the library takes
/// the last tiles of all but the first for whole ones.
fn chosen<'a>(
    source: &Source<'a>,
    page: &Directory<'a>,
    layout: &Layout,
    places: &[usize],
) -> Result<Codes, IoError> {
    let missing = || source.damaged("its samples do not fill its size");
    let codes = |layout: &Layout| {
        let bare = Bare::new(source, page, layout)?;
        Codes::new(unpacked(source, bare)?, layout).ok_or_else(missing)
    };
    if !layout.planar {
        return Ok(codes(layout)?.chosen(layout.samples, places));
    }
    let planes = places.iter().map(|&place| codes(&layout.plane(place)));
    Codes::woven(planes.collect::<Result<_, _>>()?).ok_or_else(missing)
}

fn unpacked(source: &Source, bare: Bare) -> Result<DecodingResult, IoError> {
    let bytes = source.limits.decode_bytes() as usize;
    let mut limits = Limits::default();
    limits.decoding_buffer_size = bytes;
    limits.intermediate_buffer_size = bytes;
    // Lists of strips are as long as the picture is high.
    limits.ifd_value_size = 64 << 20;
    let mut decoded = DecodingResult::U8(Vec::new());
    let read = Decoder::new(bare).map(|decoder| decoder.with_limits(limits));
    let read = read.and_then(|mut decoder| decoder.read_image_to_buffer(&mut decoded));
    match read {
        Ok(_) => Ok(decoded),
        Err(TiffError::LimitsExceeded) => Err(source.too_much_memory()),
        Err(error) => Err(source.damaged(error.to_string())),
    }
}

fn statement(file: &File, page: &Directory) -> Statement {
    let exif = page.one(tags::EXIF).and_then(|at| file.directory(at));
    let exif = exif.map(|exif| exif_color(file, &exif)).unwrap_or_default();
    match page.bytes(tags::PROFILE) {
        Some(profile) => of_profile(profile, exif.statement()),
        None => exif.statement(),
    }
}

/// What the EXIF directory of a page says.
fn exif_color(file: &File, exif: &Directory) -> ExifColor {
    let space = exif.one(tags::EXIF_COLOR_SPACE);
    let below = exif.one(tags::EXIF_INTEROPERABILITY);
    let below = below.and_then(|at| file.directory(at));
    let index = below.and_then(|below| below.bytes(tags::INTEROPERABILITY_INDEX));
    let text = |bytes: &[u8]| {
        String::from_utf8_lossy(bytes)
            .trim_end_matches('\0')
            .to_owned()
    };
    ExifColor {
        space: space.map(|space| space.min(u64::from(u32::MAX)) as u32),
        interoperability: index.map(text),
        gamma: exif.fractions(tags::EXIF_GAMMA).first().copied(),
    }
}
