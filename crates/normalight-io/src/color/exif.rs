//! What EXIF says about colours.
use super::Statement;
use super::encoding::Encoding;
use exif::{Exif, In, Reader, Tag, Value};

/// `ColorSpace` of EXIF 3.0, 4.6.6: sRGB.
const SRGB: u32 = 1;
/// Not in the standard, but written by some cameras: Adobe RGB.
const ADOBE: u32 = 2;
/// Anything else.
const UNCALIBRATED: u32 = 0xFFFF;
/// `InteroperabilityIndex` of DCF 2.0: the optional colour space, which is Adobe RGB.
const OPTIONAL: &str = "R03";

/// The tags that say something.
#[derive(Debug, Default)]
pub(crate) struct ExifColor {
    pub(crate) space: Option<u32>,
    pub(crate) interoperability: Option<String>,
    /// Exponent of the light.
    pub(crate) gamma: Option<f32>,
}

impl ExifColor {
    pub(crate) fn statement(&self) -> Statement {
        match (self.space, self.interoperability.as_deref(), self.gamma) {
            (Some(SRGB), ..) => Statement::Srgb,
            (Some(ADOBE), ..) | (Some(UNCALIBRATED), Some(OPTIONAL), _) => {
                Encoding::adobe().unwrap_or_default()
            }
            (Some(UNCALIBRATED), _, Some(gamma)) => match gamma {
                gamma if (gamma - 1.0).abs() < 0.01 => Statement::Linear,
                gamma if gamma.is_finite() && (0.1..10.0).contains(&gamma) => {
                    Statement::Encoded(Encoding::power(gamma))
                }
                _ => Statement::Nothing,
            },
            _ => Statement::Nothing,
        }
    }
}

/// What a block of EXIF says, as it stands in JPEG, PNG and WebP: a small TIFF.
pub(crate) fn of_exif(block: Vec<u8>) -> Statement {
    let read = Reader::new().continue_on_error(true).read_raw(block);
    // Cameras' own notes are often damaged; that says nothing about the rest.
    let Ok(exif) = read.or_else(|error| error.distill_partial_result(|_| ())) else {
        return Statement::Nothing;
    };
    let value = |tag: Tag| value(&exif, tag);
    let interoperability = match value(Tag::InteroperabilityIndex) {
        Some(Value::Ascii(texts)) => texts
            .first()
            .map(|text| String::from_utf8_lossy(text).into_owned()),
        _ => None,
    };
    let gamma = match value(Tag::Gamma) {
        Some(Value::Rational(values)) => values.first().map(|value| value.to_f32()),
        _ => None,
    };
    ExifColor {
        space: value(Tag::ColorSpace).and_then(|value| value.get_uint(0)),
        interoperability,
        gamma,
    }
    .statement()
}

fn value(exif: &Exif, tag: Tag) -> Option<&Value> {
    exif.get_field(tag, In::PRIMARY).map(|field| &field.value)
}
