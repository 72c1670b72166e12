//! What PNG's chunks say.
use super::Statement;
use super::code_points::of_code_points;
use super::encoding::{Curves, Encoding, to_srgb};
use super::exif::of_exif;
use super::profile::of_profile;
use png::{Info, SourceChromaticities};
use std::io::Cursor;

/// As the standard ranks them (PNG, third edition, 4.3): cICP, iCCP, sRGB, gAMA with cHRM; after
/// them what EXIF says.
pub(crate) fn of_png(bytes: &[u8]) -> Statement {
    let Ok(reader) = png::Decoder::new(Cursor::new(bytes)).read_info() else {
        return Statement::Nothing;
    };
    let info = reader.info();
    let below_profile = || {
        if info.srgb.is_some() {
            return Statement::Srgb;
        }
        of_gamma(info).or(|| match &info.exif_metadata {
            Some(block) => of_exif(block.to_vec()),
            None => Statement::Nothing,
        })
    };
    if let Some(points) = &info.coding_independent_code_points {
        return of_code_points(points);
    }
    match &info.icc_profile {
        Some(profile) => of_profile(profile, below_profile()),
        // The decoder passes over a profile that it cannot unpack.
        None if has_profile(bytes) => {
            Statement::unknown("it cannot be unpacked".to_owned(), below_profile())
        }
        None => below_profile(),
    }
}

/// gAMA, with the primaries of cHRM beside it.
fn of_gamma(info: &Info) -> Statement {
    let Some(gamma) = info.gama_chunk.map(|gamma| gamma.into_value()) else {
        return Statement::Nothing;
    };
    let curves = match gamma {
        // Darker or brighter than anything that was ever written on purpose.
        gamma if !(0.1..=10.0).contains(&gamma) => return Statement::Nothing,
        gamma if (gamma - 1.0).abs() < 0.01 => Curves::Linear,
        // The exponent that stands for the curve of sRGB.
        gamma if (gamma - 0.45455).abs() < 0.005 => Curves::srgb(),
        gamma => Curves::power(1.0 / gamma),
    };
    let name = match gamma {
        gamma if (gamma - 1.0).abs() < 0.01 => "linear".to_owned(),
        gamma => format!("gamma {:.2}", 1.0 / gamma),
    };
    let name = match info.chrm_chunk {
        Some(_) => format!("{name} with its own primaries"),
        None => name,
    };
    let matrix = info.chrm_chunk.map(|points| to_srgb(primaries(&points)));
    let alone = Encoding::statement(name.clone(), curves.clone(), None).unwrap_or_default();
    let said = matrix.transpose();
    said.and_then(|matrix| Encoding::statement(name, curves, matrix))
        .unwrap_or_else(|reason| Statement::unknown(reason, alone))
}

fn primaries(points: &SourceChromaticities) -> [[f32; 2]; 4] {
    [points.red, points.green, points.blue, points.white]
        .map(|(x, y)| [x.into_value(), y.into_value()])
}

/// Whether a profile stands before the pixels.
fn has_profile(bytes: &[u8]) -> bool {
    let mut rest = bytes.get(8..).unwrap_or_default();
    while let Some((head, after)) = rest.split_first_chunk::<8>() {
        let [a, b, c, d, kind @ ..] = *head;
        if matches!(&kind, b"iCCP" | b"IDAT") {
            return &kind == b"iCCP";
        }
        // Content and checksum.
        let length = u32::from_be_bytes([a, b, c, d]) as usize;
        rest = after.get(length.saturating_add(4)..).unwrap_or_default();
    }
    false
}
