//! Code points of ITU-T H.273, as PNG's cICP has them.
use super::Statement;
use super::encoding::{Curves, Encoding};
use moxcms::{
    CicpColorPrimaries, CicpProfile, ColorProfile, MatrixCoefficients, TransferCharacteristics,
};
use png::CodingIndependentCodePoints;

/// Brightness of diffuse white in PQ, cd/m2, and its signal in HLG (ITU-R BT.2408, 2.1). They
/// become 1, so that photographs for bright displays are exposed like others.
const PQ_WHITE: f64 = 203.0;
const PQ_BRIGHTEST: f64 = 10_000.0;
const HLG_WHITE: f64 = 0.75;
/// Exponent by which a display of HLG makes light of the scene into its own (ITU-R BT.2100, table 5).
const HLG_DISPLAY: f64 = 1.2;

/// What the code points say.
pub(crate) fn of_code_points(points: &CodingIndependentCodePoints) -> Statement {
    read(points).unwrap_or_else(|reason| Statement::unknown(reason, Statement::Srgb))
}

fn read(points: &CodingIndependentCodePoints) -> Result<Statement, String> {
    let (transfer, primaries) = (points.transfer_function, points.color_primaries);
    if points.matrix_coefficients != 0 {
        return Err("its code points are those of luma and chroma".to_owned());
    }
    if !points.is_video_full_range_image {
        return Err("its code points are of narrow range".to_owned());
    }
    let name = format!("code points {primaries} and {transfer}");
    let unknown = |what: &str, number: u8| format!("{what} {number} of its code points is unknown");
    let curves = match TransferCharacteristics::try_from(transfer) {
        Err(_) | Ok(TransferCharacteristics::Reserved | TransferCharacteristics::Unspecified) => {
            return Err(unknown("transfer", transfer));
        }
        Ok(TransferCharacteristics::Linear) => Curves::Linear,
        Ok(curve) => Curves::Sampled(vec![Curves::sampled(|code| {
            light(curve, f64::from(code)) as f32
        })]),
    };
    let matrix = match CicpColorPrimaries::try_from(primaries) {
        Err(_) | Ok(CicpColorPrimaries::Reserved) => return Err(unknown("primaries", primaries)),
        Ok(CicpColorPrimaries::Unspecified) => None,
        Ok(color_primaries) => {
            let profile = ColorProfile::new_from_cicp(CicpProfile {
                color_primaries,
                transfer_characteristics: TransferCharacteristics::Srgb,
                matrix_coefficients: MatrixCoefficients::Identity,
                full_range: true,
            });
            Some(profile.transform_matrix(&ColorProfile::new_srgb()))
        }
    };
    Encoding::statement(name, curves, matrix)
}

/// Light of a code: of the scene where the standard says how, diffuse white 1.
fn light(curve: TransferCharacteristics, code: f64) -> f64 {
    match curve {
        TransferCharacteristics::Smpte2084 => curve.linearize(code) * (PQ_BRIGHTEST / PQ_WHITE),
        TransferCharacteristics::Hlg => {
            let scene = |code: f64| curve.linearize(code).powf(1.0 / HLG_DISPLAY);
            scene(code) / scene(HLG_WHITE)
        }
        _ => curve.linearize(code),
    }
}
