use crate::{Light, direction_from_angles, direction_to_angles};
use serde::{Deserialize, Serialize};
use std::f32::consts::{FRAC_PI_2, PI};

/// How intensity classes are spaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IntensitySpacing {
    /// Equal steps, as published.
    Linear,
    /// Equal ratios: the same relative precision for dim and bright lights.
    Logarithmic,
}

/// Classes of light intensity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IntensityBins {
    /// Number of classes.
    pub count: usize,
    /// Lower edge of the first class.
    pub low: f32,
    /// Upper edge of the last class.
    pub high: f32,
    /// How the edges are spaced between `low` and `high`.
    pub spacing: IntensitySpacing,
}

/// The classes that the light network predicts: azimuth and elevation over (-pi/2, pi/2), and
/// intensity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightBins {
    /// Number of azimuth classes.
    pub azimuth: usize,
    /// Number of elevation classes.
    pub elevation: usize,
    /// Intensity classes.
    pub intensity: IntensityBins,
}

/// How class probabilities become numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Decoding {
    /// Centre of the most probable class: the published way, with an error floor of half a class.
    Argmax,
    /// Expectation over the classes.
    #[default]
    SoftArgmax,
}

/// The three classes of one light.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LightClasses {
    /// Azimuth class.
    pub azimuth: usize,
    /// Elevation class.
    pub elevation: usize,
    /// Intensity class.
    pub intensity: usize,
}

impl LightBins {
    /// The published classes: 36 azimuths, 36 elevations, 20 intensities in [0.2, 2].
    pub fn paper() -> Self {
        Self {
            azimuth: 36,
            elevation: 36,
            intensity: IntensityBins {
                count: 20,
                low: 0.2,
                high: 2.0,
                spacing: IntensitySpacing::Linear,
            },
        }
    }

    /// The classes of our own networks: as published, but intensities relative to the stack's mean
    /// in logarithmic classes over [0.1, 4], which covers lights far brighter than their
    /// neighbours.
    pub fn relative() -> Self {
        Self {
            intensity: IntensityBins {
                low: 0.1,
                high: 4.0,
                spacing: IntensitySpacing::Logarithmic,
                ..Self::paper().intensity
            },
            ..Self::paper()
        }
    }

    /// Number of classes of all three kinds.
    pub fn classes(&self) -> usize {
        self.azimuth + self.elevation + self.intensity.count
    }

    /// Classes of a light; values outside the range fall into the nearest class.
    pub fn encode(&self, light: &Light) -> LightClasses {
        let (azimuth, elevation) = direction_to_angles(light.direction);
        LightClasses {
            azimuth: class_of(angle_position(azimuth, self.azimuth), self.azimuth),
            elevation: class_of(angle_position(elevation, self.elevation), self.elevation),
            intensity: class_of(
                self.intensity.position(light.mean_intensity()),
                self.intensity.count,
            ),
        }
    }

    /// A light at the centres of its classes.
    pub fn centre(&self, classes: LightClasses) -> Light {
        Light::new(
            direction_from_angles(
                angle_at(classes.azimuth as f32 + 0.5, self.azimuth),
                angle_at(classes.elevation as f32 + 0.5, self.elevation),
            ),
            self.intensity.at(classes.intensity as f32 + 0.5),
        )
    }

    /// Reads a light from its three class distributions, each summing to one.
    ///
    /// The confidence is one minus the spread of the two angle distributions relative to that of
    /// a uniform one, so 0 when nothing is known and 1 when one class has all the probability.
    ///
    /// # Shapes
    /// `azimuth: [self.azimuth]`, `elevation: [self.elevation]`, `intensity: [self.intensity.count]`.
    pub fn decode(
        &self,
        azimuth: &[f32],
        elevation: &[f32],
        intensity: &[f32],
        decoding: Decoding,
    ) -> Light {
        let position = |probabilities: &[f32]| match decoding {
            Decoding::Argmax => argmax(probabilities) as f32 + 0.5,
            Decoding::SoftArgmax => expectation(probabilities),
        };
        let direction = direction_from_angles(
            angle_at(position(azimuth), self.azimuth),
            angle_at(position(elevation), self.elevation),
        );
        let spread = (relative_variance(azimuth) + relative_variance(elevation)) / 2.0;
        Light {
            confidence: (1.0 - spread.sqrt()).clamp(0.0, 1.0),
            ..Light::new(direction, self.intensity.at(position(intensity)))
        }
    }

    /// Where azimuth, elevation (radians) and intensity lie on their class axes, in class units: class `k` covers `k..k + 1`.
    pub fn positions(&self, light: &Light) -> [f32; 3] {
        let (azimuth, elevation) = direction_to_angles(light.direction);
        [
            angle_position(azimuth, self.azimuth),
            angle_position(elevation, self.elevation),
            self.intensity.position(light.mean_intensity()),
        ]
    }
}

impl IntensityBins {
    /// Position of an intensity on the class axis, in class units.
    pub fn position(&self, intensity: f32) -> f32 {
        let fraction = match self.spacing {
            IntensitySpacing::Linear => (intensity - self.low) / (self.high - self.low),
            IntensitySpacing::Logarithmic => {
                (intensity.max(f32::MIN_POSITIVE) / self.low).ln() / (self.high / self.low).ln()
            }
        };
        fraction * self.count as f32
    }

    /// Intensity at a position on the class axis; the inverse of [`IntensityBins::position`].
    pub fn at(&self, position: f32) -> f32 {
        let fraction = position / self.count as f32;
        match self.spacing {
            IntensitySpacing::Linear => self.low + fraction * (self.high - self.low),
            IntensitySpacing::Logarithmic => self.low * (self.high / self.low).powf(fraction),
        }
    }
}

fn angle_position(angle: f32, count: usize) -> f32 {
    (angle + FRAC_PI_2) / PI * count as f32
}

fn angle_at(position: f32, count: usize) -> f32 {
    position / count as f32 * PI - FRAC_PI_2
}

fn class_of(position: f32, count: usize) -> usize {
    // The cast saturates: negative and NaN positions give class 0.
    (position.floor() as usize).min(count - 1)
}

fn argmax(probabilities: &[f32]) -> usize {
    let mut best = 0;
    for (class, &probability) in probabilities.iter().enumerate() {
        if probability > probabilities[best] {
            best = class;
        }
    }
    best
}

/// Mean position of a distribution over classes, in class units.
fn expectation(probabilities: &[f32]) -> f32 {
    probabilities
        .iter()
        .enumerate()
        .map(|(class, &probability)| (class as f32 + 0.5) * probability)
        .sum()
}

/// Variance of a distribution over classes, divided by that of the uniform distribution.
fn relative_variance(probabilities: &[f32]) -> f32 {
    let mean = expectation(probabilities);
    let variance: f32 = probabilities
        .iter()
        .enumerate()
        .map(|(class, &probability)| (class as f32 + 0.5 - mean).powi(2) * probability)
        .sum();
    let count = probabilities.len() as f32;
    variance / ((count * count - 1.0) / 12.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::angle_between;
    use proptest::prelude::*;

    fn one_hot(class: usize, count: usize) -> Vec<f32> {
        (0..count)
            .map(|k| f32::from(u8::from(k == class)))
            .collect()
    }

    proptest! {
        #[test]
        fn encode_is_the_inverse_of_centre(
            azimuth in 0usize..36, elevation in 0usize..36, intensity in 0usize..20,
        ) {
            for bins in [LightBins::paper(), LightBins::relative()] {
                let classes = LightClasses { azimuth, elevation, intensity };
                prop_assert_eq!(bins.encode(&bins.centre(classes)), classes);
            }
        }

        #[test]
        fn argmax_error_is_at_most_half_a_class(
            azimuth in -1.5f32..1.5, elevation in -1.5f32..1.5, intensity in 0.2f32..2.0,
        ) {
            let bins = LightBins::paper();
            let light = Light::new(direction_from_angles(azimuth, elevation), intensity);
            let classes = bins.encode(&light);
            let decoded = bins.decode(
                &one_hot(classes.azimuth, 36),
                &one_hot(classes.elevation, 36),
                &one_hot(classes.intensity, 20),
                Decoding::Argmax,
            );
            // Half a class is 2.5 degrees on each of two axes.
            let limit = 2.5f32.to_radians() * std::f32::consts::SQRT_2 + 1e-4;
            prop_assert!(angle_between(light.direction, decoded.direction) < limit);
            prop_assert!((decoded.mean_intensity() - intensity).abs() < 0.0451);
            prop_assert!(decoded.confidence > 0.999);
        }

        #[test]
        fn soft_argmax_has_no_floor(
            azimuth in -1.4f32..1.4, elevation in -1.4f32..1.4, intensity in 0.25f32..1.9,
        ) {
            // Probability shared linearly between the two nearest classes has the exact mean.
            let bins = LightBins::relative();
            let light = Light::new(direction_from_angles(azimuth, elevation), intensity);
            let share = |position: f32, count: usize| {
                let shifted = position - 0.5;
                let class = shifted.floor();
                let mut probabilities = vec![0.0; count];
                probabilities[class as usize] = 1.0 - (shifted - class);
                probabilities[class as usize + 1] = shifted - class;
                probabilities
            };
            let [a, e, i] = bins.positions(&light);
            let decoded = bins.decode(
                &share(a, 36), &share(e, 36), &share(i, 20), Decoding::SoftArgmax,
            );
            prop_assert!(angle_between(light.direction, decoded.direction) < 1e-3);
            prop_assert!((decoded.mean_intensity() / intensity - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn uniform_probabilities_mean_no_confidence() {
        let bins = LightBins::paper();
        let light = bins.decode(
            &[1.0 / 36.0; 36],
            &[1.0 / 36.0; 36],
            &[0.05; 20],
            Decoding::SoftArgmax,
        );
        assert!(light.confidence < 1e-3);
        assert!(angle_between(light.direction, glam::Vec3::Z) < 1e-3);
    }

    #[test]
    fn published_edges() {
        let bins = LightBins::paper();
        let light = Light::new(direction_from_angles(-FRAC_PI_2 + 1e-4, 0.0), 99.0);
        assert_eq!(
            bins.encode(&light),
            LightClasses {
                azimuth: 0,
                elevation: 18,
                intensity: 19
            }
        );
        assert!((bins.intensity.at(0.5) - 0.245).abs() < 1e-6);
    }
}
