//! Colour profiles (ICC): curves and primaries.
use super::{Statement, mapped};
use moxcms::{ColorProfile, DataColorSpace, ToneReprCurve};
use normalight_core::{Samples, Transfer};

/// Curves to linear light, and primaries to those of sRGB.
#[derive(Debug, Clone)]
pub(crate) struct Profile {
    /// Its name, for people.
    pub(crate) name: String,
    /// Linear light of 4096 evenly spaced codes, for each channel.
    curves: Vec<Vec<f32>>,
    /// From linear RGB of the profile to linear sRGB; rows.
    matrix: Option<[[f32; 3]; 3]>,
}

const STEPS: usize = 4096;

/// Beyond any number of a sound profile; what comes of it stays finite.
const LARGEST: f32 = 100.0;

impl Profile {
    /// What the profile's bytes say; a profile near sRGB or linear light is said to be that.
    pub(crate) fn statement(bytes: &[u8]) -> Statement {
        match read(bytes) {
            Ok(statement) => statement,
            Err(reason) => Statement::Unknown(reason),
        }
    }

    /// Linear samples in the primaries of sRGB, which may lie outside 0..1.
    pub(crate) fn linear(&self, samples: &Samples, channels: usize) -> Vec<f32> {
        if channels != 3 || self.curves.len() != 3 {
            return mapped(samples, |value| at(&self.curves[0], value));
        }
        let [red, green, blue] = [0, 1, 2].map(|channel| {
            let plane = plane(samples, channel);
            mapped(&plane, |value| at(&self.curves[channel], value))
        });
        let mut pixels = Vec::with_capacity(3 * red.len());
        for ((&r, &g), &b) in red.iter().zip(&green).zip(&blue) {
            pixels.extend(match self.matrix {
                None => [r, g, b],
                Some(rows) => rows.map(|row| row[0] * r + row[1] * g + row[2] * b),
            });
        }
        pixels
    }
}

fn plane(samples: &Samples, channel: usize) -> Samples {
    fn pick<T: Copy>(values: &[T], channel: usize) -> Vec<T> {
        values.iter().skip(channel).step_by(3).copied().collect()
    }
    match samples {
        Samples::U8(codes) => Samples::U8(pick(codes, channel)),
        Samples::U16(codes) => Samples::U16(pick(codes, channel)),
        Samples::F32(values) => Samples::F32(pick(values, channel)),
    }
}

/// A curve between its steps; beyond full scale it goes on in a straight line.
fn at(curve: &[f32], value: f32) -> f32 {
    let last = curve.len() - 1;
    let place = value.max(0.0) * last as f32;
    let low = (place as usize).min(last - 1);
    let part = place - low as f32;
    curve[low] + part * (curve[low + 1] - curve[low])
}

fn read(bytes: &[u8]) -> Result<Statement, String> {
    let profile = ColorProfile::new_from_slice(bytes).map_err(|error| format!("{error:?}"))?;
    let curve = |curve: &Option<ToneReprCurve>| -> Result<Vec<f32>, String> {
        let curve = curve.as_ref().ok_or("it has tables instead of curves")?;
        let evaluator = curve
            .make_linear_evaluator()
            .map_err(|error| format!("{error:?}"))?;
        // The library's power of zero is not zero.
        let value = |step| {
            let light = evaluator.evaluate_value(step as f32 / (STEPS - 1) as f32);
            if step == 0 {
                light.clamp(0.0, 1.0)
            } else {
                light
            }
        };
        let curve: Vec<f32> = (0..STEPS).map(value).collect();
        match curve.iter().copied().all(is_sound) {
            true => Ok(curve),
            false => Err("its curve leads to no light".to_owned()),
        }
    };
    let curves = match profile.color_space {
        DataColorSpace::Gray => vec![curve(&profile.gray_trc)?],
        DataColorSpace::Rgb => [&profile.red_trc, &profile.green_trc, &profile.blue_trc]
            .into_iter()
            .map(curve)
            .collect::<Result<_, _>>()?,
        other => return Err(format!("it is for {other:?}")),
    };
    let matrix = match curves.len() {
        3 => Some(primaries(&profile)?),
        _ => None,
    };
    let matrix = matrix
        // A display's own primaries are near enough to those of sRGB when no channel moves by 2 %.
        .filter(|rows| {
            let moved = |row: usize, column: usize| {
                let identity = f32::from(u8::from(row == column));
                (rows[row][column] - identity).abs() > 0.02
            };
            (0..9).any(|place| moved(place / 3, place % 3))
        });
    let near = |transfer: Transfer| {
        let fits = |(step, value): (usize, &f32)| {
            (transfer.decode(step as f32 / (STEPS - 1) as f32) - value).abs() < 0.004
        };
        curves
            .iter()
            .all(|curve| curve.iter().enumerate().all(fits))
    };
    Ok(match matrix {
        None if near(Transfer::Srgb) => Statement::Srgb,
        None if near(Transfer::Linear) => Statement::Linear,
        _ => Statement::Profile(Profile {
            name: name(&profile),
            curves,
            matrix,
        }),
    })
}

/// From linear RGB of the profile to linear sRGB; rows.
fn primaries(profile: &ColorProfile) -> Result<[[f32; 3]; 3], String> {
    let to_srgb = profile.transform_matrix(&ColorProfile::new_srgb());
    let rows = to_srgb.v.map(|row| row.map(|value| value as f32));
    match rows.as_flattened().iter().copied().all(is_sound) {
        true => Ok(rows),
        false => Err("its primaries are no colours".to_owned()),
    }
}

fn is_sound(value: f32) -> bool {
    value.abs() <= LARGEST
}

fn name(profile: &ColorProfile) -> String {
    use moxcms::ProfileText;
    let text = match &profile.description {
        Some(ProfileText::PlainString(text)) => text.clone(),
        Some(ProfileText::Localizable(texts)) => texts
            .first()
            .map(|text| text.value.clone())
            .unwrap_or_default(),
        Some(ProfileText::Description(text)) => text.ascii_string.clone(),
        None => String::new(),
    };
    match text.trim().trim_end_matches('\0') {
        "" => "without name".to_owned(),
        text => format!("{:?}", text.chars().take(60).collect::<String>()),
    }
}
