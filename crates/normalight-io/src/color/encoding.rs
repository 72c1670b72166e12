//! Curves and primaries of an encoding, and what they make of samples.
use super::{Statement, samples_len};
use moxcms::{Chromaticity, ColorPrimaries, ColorProfile, Matrix3d};
use normalight_core::{Samples, Transfer};

/// Curves to linear light, and primaries to those of sRGB.
#[derive(Debug, Clone)]
pub(crate) struct Encoding {
    /// What it is, for people.
    pub(crate) name: String,
    curves: Curves,
    /// From its linear RGB to that of sRGB; rows.
    matrix: Option<[[f32; 3]; 3]>,
}

#[derive(Debug, Clone)]
pub(crate) enum Curves {
    /// Samples are proportional to light.
    Linear,
    /// Light of evenly spaced codes: one curve for all channels, or one for each.
    Sampled(Vec<Vec<f32>>),
}

/// Chromaticities (CIE x and y) of red, green, blue and white.
pub(crate) type Primaries = [[f32; 2]; 4];

/// Steps of a curve. Between them it is straight, which is off by less than half a code of 16 bits
/// for powers up to 3.
const STEPS: usize = 4096;

/// Beyond any number of a sound encoding; what comes of it stays finite.
const LARGEST: f32 = 100.0;

/// A display's own primaries are near enough to those of sRGB when no channel moves by more.
const SAME_PRIMARIES: f64 = 0.02;

/// Least area between three primaries; that of sRGB is 0.11.
const LEAST_AREA: f32 = 1e-3;

/// Adobe RGB (1998): its exponent is 563/256.
const ADOBE_POWER: f32 = 2.199_218_8;

impl Curves {
    pub(crate) fn sampled(curve: impl Fn(f32) -> f32) -> Vec<f32> {
        let last = (STEPS - 1) as f32;
        (0..STEPS).map(|step| curve(step as f32 / last)).collect()
    }

    pub(crate) fn power(exponent: f32) -> Self {
        Self::Sampled(vec![Self::sampled(|code| code.powf(exponent))])
    }

    pub(crate) fn srgb() -> Self {
        Self::Sampled(vec![Self::sampled(|code| Transfer::Srgb.decode(code))])
    }

    /// Whether the curves are nowhere further from another than a code of 8 bits.
    fn are(&self, transfer: Transfer) -> bool {
        let Self::Sampled(curves) = self else {
            return transfer == Transfer::Linear;
        };
        let wanted = Self::sampled(|code| transfer.decode(code));
        let mut pairs = curves.iter().flat_map(|curve| curve.iter().zip(&wanted));
        pairs.all(|(value, wanted)| (value - wanted).abs() < 0.004)
    }

    fn of_channel(&self, channel: usize) -> Option<&[f32]> {
        match self {
            Self::Linear => None,
            Self::Sampled(curves) => curves.get(channel).or(curves.first()).map(Vec::as_slice),
        }
    }

    /// Whether full scale is as bright as light gets, so that integers can hold the result.
    fn end_at_full_scale(&self) -> bool {
        let Self::Sampled(curves) = self else {
            return true;
        };
        let mut ends = curves.iter().filter_map(|curve| curve.last());
        ends.all(|&end| end <= 1.001)
    }
}

impl Encoding {
    /// Curves, and a matrix to linear sRGB, as a statement; what is near sRGB or linear light is said
    /// to be that.
    ///
    /// # Errors
    /// Numbers that are not finite, in words.
    pub(crate) fn statement(
        name: String,
        curves: Curves,
        matrix: Option<Matrix3d>,
    ) -> Result<Statement, String> {
        if let Curves::Sampled(curves) = &curves
            && !curves.iter().flatten().all(|value| value.abs() <= LARGEST)
        {
            return Err("its curve leads to no light".to_owned());
        }
        let rows = matrix.map(|matrix| matrix.v);
        let mut factors = rows.iter().flatten().flatten();
        if !factors.all(|factor| factor.abs() <= f64::from(LARGEST)) {
            return Err("its primaries are impossible".to_owned());
        }
        let moved = |rows: &[[f64; 3]; 3]| {
            let identity = |place: usize| f64::from(u8::from(place.is_multiple_of(4)));
            let apart = |place: usize| rows[place / 3][place % 3] - identity(place);
            (0..9).any(|place| apart(place).abs() > SAME_PRIMARIES)
        };
        let rows = rows.filter(moved);
        Ok(match rows {
            None if curves.are(Transfer::Srgb) => Statement::Srgb,
            None if curves.are(Transfer::Linear) => Statement::Linear,
            _ => Statement::Encoded(Self {
                name,
                curves,
                matrix: rows.map(|rows| rows.map(|row| row.map(|value| value as f32))),
            }),
        })
    }

    /// Light is the sample to a power.
    pub(crate) fn power(exponent: f32) -> Self {
        Self {
            name: format!("gamma {exponent:.2}"),
            curves: Curves::power(exponent),
            matrix: None,
        }
    }

    /// The curve of sRGB, for samples that may lie beyond full scale.
    pub(crate) fn srgb() -> Self {
        Self {
            name: "sRGB".to_owned(),
            curves: Curves::srgb(),
            matrix: None,
        }
    }

    /// Adobe RGB (1998).
    pub(crate) fn adobe() -> Result<Statement, String> {
        let to_srgb = ColorProfile::new_adobe_rgb().transform_matrix(&ColorProfile::new_srgb());
        Self::statement(
            "Adobe RGB".to_owned(),
            Curves::power(ADOBE_POWER),
            Some(to_srgb),
        )
    }

    /// Linear samples in the primaries of sRGB; `channels` colours, 1 or 3.
    ///
    /// Samples of 8 bits become 16, cut off at 0 and 1, to halve the memory; deeper ones become
    /// numbers, which may lie outside.
    pub(crate) fn linear(&self, samples: &Samples, channels: usize) -> Samples {
        let lights = self.lights(samples, channels);
        if !matches!(samples, Samples::U8(_)) || !self.curves.end_at_full_scale() {
            return Samples::F32(lights.collect());
        }
        Samples::U16(
            lights
                .map(|light| (light.clamp(0.0, 1.0) * 65_535.0).round() as u16)
                .collect(),
        )
    }

    fn lights(&self, samples: &Samples, channels: usize) -> impl Iterator<Item = f32> {
        let matrix = self.matrix.filter(|_| channels == 3);
        let tables: Vec<Light> = (0..channels)
            .map(|channel| Light::new(samples, self.curves.of_channel(channel)))
            .collect();
        (0..samples_len(samples)).map(move |place| {
            let light = |place: usize| tables[place % channels].of(samples, place);
            let Some(rows) = matrix else {
                return light(place);
            };
            let (pixel, row) = (place - place % 3, rows[place % 3]);
            (0..3)
                .map(|channel| row[channel] * light(pixel + channel))
                .sum()
        })
    }
}

/// The curve of a channel, of codes at once and of numbers one by one.
enum Light<'curve> {
    Codes(Vec<f32>),
    Numbers(Option<&'curve [f32]>),
}

impl<'curve> Light<'curve> {
    fn new(samples: &Samples, curve: Option<&'curve [f32]>) -> Self {
        let codes: usize = match samples {
            Samples::U8(_) => 256,
            Samples::U16(_) => 65_536,
            Samples::F32(_) => return Self::Numbers(curve),
        };
        let full = (codes - 1) as f32;
        let of = |code: usize| at(curve, code as f32 / full);
        Self::Codes((0..codes).map(of).collect())
    }

    fn of(&self, samples: &Samples, place: usize) -> f32 {
        match (self, samples) {
            (Self::Codes(table), Samples::U8(codes)) => table[usize::from(codes[place])],
            (Self::Codes(table), Samples::U16(codes)) => table[usize::from(codes[place])],
            (Self::Numbers(curve), Samples::F32(values)) => at(*curve, values[place]),
            // Tables are made for their samples.
            _ => 0.0,
        }
    }
}

/// A curve between its steps; beyond full scale it goes on in a straight line.
fn at(curve: Option<&[f32]>, value: f32) -> f32 {
    let Some(curve) = curve else {
        return value;
    };
    let last = curve.len() - 1;
    let place = value.max(0.0) * last as f32;
    let low = (place as usize).min(last - 1);
    let part = place - low as f32;
    curve[low] + part * (curve[low + 1] - curve[low])
}

/// The matrix from linear RGB of some primaries to that of sRGB, white to white (Bradford).
///
/// # Errors
/// Primaries that span no colours, in words.
pub(crate) fn to_srgb([red, green, blue, white]: Primaries) -> Result<Matrix3d, String> {
    let [to_green, to_blue] = [green, blue].map(|[x, y]| [x - red[0], y - red[1]]);
    let area = 0.5 * (to_green[0] * to_blue[1] - to_green[1] * to_blue[0]).abs();
    // Not a number is no area either.
    if area.is_nan() || area < LEAST_AREA {
        return Err("its primaries lie on a line".to_owned());
    }
    let point = |[x, y]: [f32; 2]| Chromaticity::new(x, y);
    let primaries = ColorPrimaries {
        red: point(red),
        green: point(green),
        blue: point(blue),
    };
    let mut profile = ColorProfile::new_srgb();
    profile.update_rgb_colorimetry(point(white).to_xyyb(), primaries);
    Ok(profile.transform_matrix(&ColorProfile::new_srgb()))
}
