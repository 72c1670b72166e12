//! TIFF of all kinds that scientific programs and cameras write.
use crate::color::{ExifColor, Statement, of_profile, samples_len};
use crate::limits::{MAX_DECODE_BYTES, MAX_PIXELS};
use image::metadata::Orientation;
use normalight_core::Samples;
use std::io::Cursor;
use tiff::ColorType;
use tiff::decoder::ifd::Value;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::{IfdPointer, Tag};

/// The first page of a file.
pub(super) struct Page {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Grey, grey and alpha, RGB, or RGB and alpha.
    pub(super) channels: usize,
    pub(super) samples: Samples,
    pub(super) statement: Statement,
    pub(super) orientation: Orientation,
    pub(super) pages: usize,
}

/// Why there is no page.
pub(super) enum Failure {
    TooManyPixels(u32, u32),
    Reason(String),
}

impl From<tiff::TiffError> for Failure {
    fn from(error: tiff::TiffError) -> Self {
        Self::Reason(match error {
            tiff::TiffError::LimitsExceeded => {
                format!("it needs too much memory; images of at most {MAX_PIXELS} pixels are read")
            }
            error => error.to_string(),
        })
    }
}

fn refused(what: &str) -> Failure {
    Failure::Reason(format!(
        "{what}, which is not read; export it as grey or RGB of 8 or 16 bits"
    ))
}

const PALETTE: u16 = 3;
const COLOR_SPACE: Tag = Tag::Unknown(0xA001);
const GAMMA: Tag = Tag::Unknown(0xA500);
const INTEROPERABILITY: Tag = Tag::Unknown(0xA005);
const INTEROPERABILITY_INDEX: Tag = Tag::Unknown(1);
const DNG_VERSION: Tag = Tag::Unknown(50_706);

pub(super) fn decode(bytes: &[u8]) -> Result<Page, Failure> {
    let mut decoder = open(bytes)?;
    let unsigned = |decoder: &mut Decoder<_>, tag| decoder.find_tag_unsigned::<u16>(tag);
    let (width, height) = decoder.dimensions()?;
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(Failure::TooManyPixels(width, height));
    }
    if width == 0 || height == 0 {
        return Err(Failure::Reason(format!("it has {width}x{height} pixels")));
    }
    if decoder.find_tag(DNG_VERSION)?.is_some() {
        return Err(refused("it is a camera RAW (DNG)"));
    }
    let statement = statement(&mut decoder);
    let orientation = unsigned(&mut decoder, Tag::Orientation)?
        .and_then(|value| Orientation::from_exif(value.min(255) as u8))
        .unwrap_or(Orientation::NoTransforms);
    let palette = match unsigned(&mut decoder, Tag::PhotometricInterpretation)? {
        Some(PALETTE) => Some(decoder.get_tag_u16_vec(Tag::ColorMap)?),
        _ => None,
    };
    let (samples, channels) = match &palette {
        None => read(&mut decoder)?,
        Some(map) => {
            let grey = as_grey(bytes).ok_or_else(|| refused("its palette is unusual"))?;
            let (indices, channels) = read(&mut open(&grey)?)?;
            (through(map, &indices, channels)?, 3)
        }
    };
    if samples_len(&samples) != width as usize * height as usize * channels {
        return Err(refused("its samples are laid out in an unknown way"));
    }
    let mut pages = 1;
    // Broken further pages are nobody's concern.
    while pages < 10_000 && decoder.more_images() && decoder.next_image().is_ok() {
        pages += 1;
    }
    Ok(Page {
        width,
        height,
        channels,
        samples,
        statement,
        orientation,
        pages,
    })
}

fn open(bytes: &[u8]) -> Result<Decoder<Cursor<&[u8]>>, Failure> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MAX_DECODE_BYTES as usize;
    limits.intermediate_buffer_size = MAX_DECODE_BYTES as usize;
    Ok(Decoder::new(Cursor::new(bytes))?.with_limits(limits))
}

fn statement(decoder: &mut Decoder<Cursor<&[u8]>>) -> Statement {
    let exif = decoder.find_tag_unsigned::<u64>(Tag::ExifDirectory);
    let exif = match exif.ok().flatten() {
        Some(pointer) => exif_color(decoder, pointer).unwrap_or_default(),
        None => ExifColor::default(),
    };
    match decoder.get_tag_u8_vec(Tag::IccProfile) {
        Ok(profile) => of_profile(&profile, exif.statement()),
        Err(_) => exif.statement(),
    }
}

/// What the EXIF directory of the page says.
fn exif_color(decoder: &mut Decoder<Cursor<&[u8]>>, pointer: u64) -> Option<ExifColor> {
    let directory = decoder.read_directory(IfdPointer(pointer)).ok()?;
    let mut tags = decoder.read_directory_tags(&directory);
    let space = tags.find_tag_unsigned(COLOR_SPACE).ok().flatten();
    let gamma = match tags.find_tag(GAMMA) {
        Ok(Some(Value::Rational(over, under))) => Some(over as f32 / under as f32),
        _ => None,
    };
    let below = tags.find_tag_unsigned(INTEROPERABILITY).ok().flatten();
    let below = below.and_then(|pointer| decoder.read_directory(IfdPointer(pointer)).ok());
    let interoperability = below.and_then(|directory| {
        let mut tags = decoder.read_directory_tags(&directory);
        match tags.find_tag(INTEROPERABILITY_INDEX) {
            Ok(Some(Value::Ascii(text))) => Some(text),
            _ => None,
        }
    });
    Some(ExifColor {
        space,
        interoperability,
        gamma,
    })
}

/// Samples and the number of channels that are handed on.
fn read(decoder: &mut Decoder<Cursor<&[u8]>>) -> Result<(Samples, usize), Failure> {
    let color = decoder.colortype()?;
    let stored = usize::from(
        decoder
            .find_tag_unsigned::<u16>(Tag::SamplesPerPixel)?
            .unwrap_or(1),
    );
    let planar = decoder.find_tag_unsigned::<u16>(Tag::PlanarConfiguration)? == Some(2);
    let predicted = decoder
        .find_tag_unsigned::<u16>(Tag::Predictor)?
        .unwrap_or(1)
        != 1;
    let (kept, bits) = match color {
        ColorType::Gray(bits) => (1, bits),
        ColorType::GrayA(bits) => (2, bits),
        ColorType::RGB(bits) | ColorType::YCbCr(bits) => (3, bits),
        ColorType::RGBA(bits) => (4, bits),
        ColorType::Multiband {
            bit_depth,
            num_samples,
        } => (usize::from(num_samples), bit_depth),
        ColorType::CMYK(_) | ColorType::CMYKA(_) => {
            return Err(refused("its colours are those of a print (CMYK)"));
        }
        other => return Err(refused(&format!("its colours are {other:?}"))),
    };
    // The decoder undoes differences over the channels that it knows, not over all.
    if predicted && !planar && stored > kept {
        return Err(refused("it has extra channels beside a predictor"));
    }
    let (width, height) = decoder.dimensions()?;
    let mut result = DecodingResult::U8(Vec::new());
    let layout = decoder.read_image_to_buffer(&mut result)?;
    let samples = match result {
        DecodingResult::U8(codes) if bits < 8 => {
            let row = width as usize * kept;
            Samples::U8(unpacked(&codes, bits, row, height as usize))
        }
        DecodingResult::U8(codes) => Samples::U8(codes),
        DecodingResult::U16(codes) => Samples::U16(codes),
        DecodingResult::U32(codes) => Samples::F32(
            codes
                .iter()
                .map(|&c| (f64::from(c) / 4_294_967_295.0) as f32)
                .collect(),
        ),
        DecodingResult::F16(values) => Samples::F32(values.iter().map(|v| v.to_f32()).collect()),
        DecodingResult::F32(values) => Samples::F32(values),
        DecodingResult::F64(values) => Samples::F32(values.iter().map(|&v| v as f32).collect()),
        _ => return Err(refused("its samples have signs or 64 bits")),
    };
    let samples = match layout.planes {
        0 | 1 => samples,
        planes => interleaved(samples, width as usize * height as usize, planes, kept)?,
    };
    match (color, kept) {
        (ColorType::YCbCr(_), _) => Ok((rgb_of_ycc(samples)?, 3)),
        // Extra channels of grey images: the first may be transparency.
        (ColorType::Multiband { .. }, 1 | 2) | (_, 1..=4) if !is_many(color, kept) => {
            Ok((samples, kept))
        }
        _ => Err(refused(&format!("it has {kept} channels"))),
    }
}

fn is_many(color: ColorType, kept: usize) -> bool {
    matches!(color, ColorType::Multiband { .. }) && kept > 2
}

/// Codes of less than 8 bits, spread to full scale; rows begin with a byte.
fn unpacked(packed: &[u8], bits: u8, row: usize, rows: usize) -> Vec<u8> {
    let bytes = (row * usize::from(bits)).div_ceil(8);
    let full = (1u16 << bits) - 1;
    let mut codes = Vec::with_capacity(row * rows);
    for line in packed.chunks_exact(bytes.max(1)).take(rows) {
        for place in 0..row {
            let bit = place * usize::from(bits);
            let shift = 8 - usize::from(bits) - bit % 8;
            let code = u16::from(line[bit / 8] >> shift) & full;
            codes.push((code * 255 / full) as u8);
        }
    }
    codes
}

fn interleaved(
    samples: Samples,
    area: usize,
    planes: usize,
    kept: usize,
) -> Result<Samples, Failure> {
    fn woven<T: Copy>(values: &[T], area: usize, kept: usize) -> Vec<T> {
        (0..area * kept)
            .map(|k| values[k % kept * area + k / kept])
            .collect()
    }
    if planes < kept || samples_len(&samples) < area * kept {
        return Err(refused("its channels lie apart in an unknown way"));
    }
    Ok(match samples {
        Samples::U8(codes) => Samples::U8(woven(&codes, area, kept)),
        Samples::U16(codes) => Samples::U16(woven(&codes, area, kept)),
        Samples::F32(values) => Samples::F32(woven(&values, area, kept)),
    })
}

/// Luma and chroma of full range (JFIF, after ITU-R BT.601) as RGB.
fn rgb_of_ycc(samples: Samples) -> Result<Samples, Failure> {
    let Samples::U8(mut codes) = samples else {
        return Err(refused("its colours are YCbCr of more than 8 bits"));
    };
    for pixel in codes.as_chunks_mut::<3>().0 {
        let [y, blue, red] = pixel.map(f32::from);
        let (blue, red) = (blue - 128.0, red - 128.0);
        *pixel = [
            y + 1.402 * red,
            y - 0.344_136 * blue - 0.714_136 * red,
            y + 1.772 * blue,
        ]
        .map(|value| value.round().clamp(0.0, 255.0) as u8);
    }
    Ok(Samples::U8(codes))
}

fn through(map: &[u16], indices: &Samples, channels: usize) -> Result<Samples, Failure> {
    let (Samples::U8(indices), 1) = (indices, channels) else {
        return Err(refused("its palette has more than 8 bits"));
    };
    let entries = map.len() / 3;
    // Codes of fewer bits came spread to full scale.
    let place = |code: u8| usize::from(code) * entries.saturating_sub(1) / 255;
    if entries == 0 {
        return Err(refused("its palette is empty"));
    }
    let colors = indices
        .iter()
        .flat_map(|&code| [0, 1, 2].map(|channel| map[channel * entries + place(code)]));
    // Palettes of 8 bits are written with 16.
    let colors: Vec<u16> = colors.collect();
    let eight = |code: u16| (code >> 8) as u8;
    let repeats = map
        .iter()
        .all(|&code| code >> 8 == code & 255 || code & 255 == 0);
    Ok(match repeats {
        true => Samples::U8(colors.into_iter().map(eight).collect()),
        false => Samples::U16(colors),
    })
}

/// The file with its palette's indices said to be grey, which the decoder reads.
fn as_grey(bytes: &[u8]) -> Option<Vec<u8>> {
    let little = bytes.first()? == &b'I';
    let number = |at: usize, count: usize| -> Option<u64> {
        let part = bytes.get(at..at.checked_add(count)?)?;
        let join = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
        Some(match little {
            true => part.iter().rev().fold(0, join),
            false => part.iter().fold(0, join),
        })
    };
    let big = number(2, 2)? == 43;
    let (directory, head, entry) = match big {
        true => (number(8, 8)? as usize, 8, 20),
        false => (number(4, 4)? as usize, 2, 12),
    };
    let entries = number(directory, head)?.min(4096) as usize;
    let places = (0..entries).map(|k| directory + head + k * entry);
    let place = places
        .into_iter()
        .find(|&place| number(place, 2) == Some(262))?;
    let value = place + if big { 12 } else { 8 };
    let mut grey = bytes.to_vec();
    let one = if little { [1, 0] } else { [0, 1] };
    grey.get_mut(value..value + 2)?.copy_from_slice(&one);
    Some(grey)
}
