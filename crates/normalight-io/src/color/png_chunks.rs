//! What PNG's chunks say.
use super::Statement;
use super::profile::Profile;
use std::io::Cursor;

/// As the standard ranks them: cICP, iCCP, sRGB, gAMA.
pub(crate) fn of_png(bytes: &[u8]) -> Statement {
    let Ok(reader) = png::Decoder::new(Cursor::new(bytes)).read_info() else {
        return Statement::Nothing;
    };
    let info = reader.info();
    if let Some(points) = &info.coding_independent_code_points {
        return match points.transfer_function {
            8 => Statement::Linear,
            13 => Statement::Srgb,
            4 => Statement::Power(2.2),
            5 => Statement::Power(2.8),
            other => Statement::Unknown(format!("transfer function {other}")),
        };
    }
    if let Some(profile) = &info.icc_profile {
        return Profile::statement(profile);
    }
    match (info.srgb, info.gama_chunk) {
        (Some(_), _) => Statement::Srgb,
        (None, Some(gamma)) => match gamma.into_value() {
            gamma if gamma <= 0.0 => Statement::Nothing,
            gamma if (gamma - 1.0).abs() < 0.01 => Statement::Linear,
            // The exponent that stands for the sRGB curve.
            gamma if (gamma - 0.45455).abs() < 0.005 => Statement::Srgb,
            gamma => Statement::Power(1.0 / gamma),
        },
        (None, None) => Statement::Nothing,
    }
}
