//! What errors a doubt means: lines through what rendered objects showed.
//!
//! Whole pipeline, quality `default`, 16 objects that no training has shown at 128x128 pixels, sorted into tenths, with 12 and
//! with 40 images (`examples/reliability.rs` of normalight-train).

/// Degrees that a normal is off where all views agree.
const NORMAL_FLOOR: f32 = 1.5;

/// Degrees more for each degree that the views are apart: all of them are led astray by the same interreflection, shadow or
/// light that is wrong.
const NORMAL_SLOPE: f32 = 2.3;

/// Beyond this nothing is known.
const NORMAL_MOST: f32 = 18.0;

/// Doubt, as `1 - confidence`, that even the surest light has beyond that of its error: from the soft labels of training.
const LIGHT_LABELS: f32 = 0.055;

/// Degrees for each unit of doubt beyond it.
const LIGHT_SLOPE: f32 = 60.0;

/// What no estimated light is better than.
const LIGHT_FLOOR: f32 = 2.0;

/// Expected error of a normal in degrees, from how far apart the views are of which it is a mean, in degrees.
///
/// Tenths with 12 images had 0.8 / 1.2 / 1.4 / 1.6 / 1.8 / 2.1 / 2.4 / 3.0 / 3.9 / 6.4 degrees of spread and
/// 3.3 / 3.8 / 4.3 / 4.9 / 5.5 / 6.1 / 7.5 / 9.8 / 12.1 / 15.8 of error; with 40 images
/// 1.0 / 1.3 / 1.5 / 1.8 / 2.1 / 2.4 / 3.0 / 3.7 / 4.9 / 8.0 and 3.6 / 4.0 / 4.3 / 4.6 / 5.1 / 6.3 / 8.1 / 9.4 / 11.3 / 14.4.
pub fn expected_normal_error(spread: f32) -> f32 {
    (NORMAL_FLOOR + NORMAL_SLOPE * spread).min(NORMAL_MOST)
}

/// Expected error of an estimated light's direction in degrees, from its confidence (0 to 1).
///
/// Fifths with 12 images had a confidence of 0.89 / 0.88 / 0.85 / 0.83 / 0.77 and 2.1 / 3.8 / 5.2 / 9.2 / 10.6 degrees of
/// error; with 40 images 0.89 / 0.88 / 0.86 / 0.83 / 0.77 and 4.6 / 4.1 / 5.9 / 10.1 / 7.9. Single lights differ much.
pub fn expected_light_error(confidence: f32) -> f32 {
    (LIGHT_SLOPE * (1.0 - confidence - LIGHT_LABELS)).max(LIGHT_FLOOR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_doubt_means_more_error() {
        let normals = [0.0, 0.8, 2.0, 6.4, 90.0].map(expected_normal_error);
        assert!(normals.is_sorted_by(|a, b| a < b), "{normals:?}");
        assert_eq!(normals[4], NORMAL_MOST);
        let lights = [0.95, 0.88, 0.8, 0.2].map(expected_light_error);
        assert!(lights.is_sorted_by(|a, b| a < b), "{lights:?}");
        assert_eq!(lights[0], LIGHT_FLOOR);
    }
}
