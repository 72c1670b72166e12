//! Profiles that have tables instead of curves.
use super::{Statement, mapped};
use moxcms::{
    ColorProfile, Layout, RenderingIntent, ToneReprCurve, TransformExecutor, TransformOptions,
};
use normalight_core::Samples;
use std::fmt;
use std::sync::Arc;

/// A table from RGB to linear light in the primaries of sRGB, both 0 to 1.
#[derive(Clone)]
pub(crate) struct Tables {
    /// The profile, for people.
    pub(crate) name: String,
    transform: Arc<dyn TransformExecutor<f32> + Send + Sync>,
}

impl fmt::Debug for Tables {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Tables").field("name", &self.name).finish()
    }
}

/// Samples that are transformed at once: enough to be fast, few enough to need no memory.
const RUN: usize = 3 * 4096;

impl Tables {
    /// Whether a profile has nothing but tables.
    pub(crate) fn alone(profile: &ColorProfile) -> bool {
        let curves = [&profile.red_trc, &profile.green_trc, &profile.blue_trc];
        let tables = [
            &profile.lut_a_to_b_colorimetric,
            &profile.lut_a_to_b_perceptual,
        ];
        curves.iter().any(|curve| curve.is_none()) && tables.iter().any(|table| table.is_some())
    }

    /// # Errors
    /// What the library cannot do with the tables, in words.
    pub(crate) fn statement(name: String, profile: &ColorProfile) -> Result<Statement, String> {
        let mut linear = ColorProfile::new_srgb();
        let straight = Some(ToneReprCurve::Lut(Vec::new()));
        linear.red_trc = straight.clone();
        linear.green_trc = straight.clone();
        linear.blue_trc = straight;
        linear.cicp = None;
        // Light as measured, without making up for a display.
        let rendering_intent = match profile.lut_a_to_b_colorimetric {
            Some(_) => RenderingIntent::RelativeColorimetric,
            None => RenderingIntent::Perceptual,
        };
        let options = TransformOptions {
            rendering_intent,
            ..TransformOptions::default()
        };
        let transform = profile
            .create_transform_f32(Layout::Rgb, &linear, Layout::Rgb, options)
            .map_err(|error| format!("its tables cannot be used: {error:?}"))?;
        Ok(Statement::Tables(Self { name, transform }))
    }

    /// Linear samples in the primaries of sRGB, cut off at 0 and 1; `channels` colours, 1 or 3: a
    /// grey sample is a grey colour.
    pub(crate) fn linear(&self, samples: &Samples, channels: usize) -> Samples {
        let values = mapped(samples, |value| value.clamp(0.0, 1.0));
        let mut lights = Vec::with_capacity(values.len());
        for run in values.chunks(RUN) {
            let colours: Vec<f32> = match channels {
                1 => run.iter().flat_map(|&value| [value; 3]).collect(),
                _ => run.to_vec(),
            };
            let mut light = vec![0.0; colours.len()];
            // The library refuses only lengths that are no whole pixels.
            if self.transform.transform(&colours, &mut light).is_err() {
                light.copy_from_slice(&colours);
            }
            let step = if channels == 1 { 3 } else { 1 };
            let kept = light.into_iter().skip(step / 2).step_by(step);
            lights.extend(kept.map(|value| if value.is_finite() { value } else { 0.0 }));
        }
        match samples {
            Samples::U8(_) => Samples::U16(
                lights
                    .into_iter()
                    .map(|light| (light.clamp(0.0, 1.0) * 65_535.0).round() as u16)
                    .collect(),
            ),
            _ => Samples::F32(lights),
        }
    }
}
