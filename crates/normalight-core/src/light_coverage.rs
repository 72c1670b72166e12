//! From how many sides an object was lit.
use crate::Light;
use crate::uncalibrated::eigenpairs;
use glam::Vec3;

/// Root mean square of the sine of the angle between lights and a plane below which they lie in it. On five objects of
/// DiLiGenT estimated lights of one column of its stage have 0.01 to 0.10 (and normals 17 to 21 degrees of error, with
/// the true lights, too), five photographs and more from all over the stage 0.20 to 0.30 (normals 2 to 11 degrees).
const FLAT: f32 = 0.12;

/// Sine of the tilt from which a light comes from a side at all.
const SIDEWAYS: f32 = 0.17;

/// Degrees without a light, seen from the camera, from which all came from one side: half a turn, and what estimated
/// lights may be wrong by.
const DARK: f32 = 200.0;

/// From how many sides an object was lit: what decides whether normals can be told at all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightCoverage {
    /// Root mean square of the sine of the angle between the lights and the plane through the object that is nearest to
    /// all of them, 0 to 0.58.
    pub off_plane: f32,
    /// The widest angle without a light around the viewing axis, in degrees up to 360: of lights more than ten degrees
    /// from that axis.
    pub dark_degrees: f32,
    /// The middle of the rest: the side that the lights came from, in degrees from the right over the top.
    pub lit_from_degrees: f32,
}

impl LightCoverage {
    /// `None` without lights.
    pub fn of(lights: &[Light]) -> Option<Self> {
        let directions: Vec<Vec3> = lights.iter().map(|light| light.direction).collect();
        if directions.is_empty() {
            return None;
        }
        let moment = |i: usize, j: usize| {
            let product = |d: &Vec3| f64::from(d[i]) * f64::from(d[j]);
            directions.iter().map(product).sum::<f64>() / directions.len() as f64
        };
        let matrix = (0..3).map(|i| (0..3).map(|j| moment(i, j)).collect());
        let smallest = eigenpairs(matrix.collect())
            .last()
            .map_or(0.0, |pair| pair.0);
        let (dark_degrees, lit_from_degrees) = dark_side(&directions);
        Some(Self {
            off_plane: smallest.max(0.0).sqrt() as f32,
            dark_degrees,
            lit_from_degrees,
        })
    }

    /// Whether the lights lie nearly in one plane with the object: which way a surface leans across it cannot be told
    /// then, whatever the number of photographs.
    pub fn is_flat(&self) -> bool {
        self.off_plane < FLAT
    }

    /// The side that all lights came from, in words, if it is one.
    pub fn one_side(&self) -> Option<&'static str> {
        const SIDES: [&str; 8] = [
            "the right",
            "the upper right",
            "above",
            "the upper left",
            "the left",
            "the lower left",
            "below",
            "the lower right",
        ];
        (self.dark_degrees >= DARK).then(|| {
            let eighth = (self.lit_from_degrees / 45.0).round() as usize;
            SIDES[eighth % SIDES.len()]
        })
    }
}

/// The widest angle without a light, and the middle of the rest, in degrees.
fn dark_side(directions: &[Vec3]) -> (f32, f32) {
    let sideways = directions
        .iter()
        .filter(|d| d.truncate().length() > SIDEWAYS);
    let mut angles: Vec<f32> = sideways
        .map(|d| d.y.atan2(d.x).to_degrees().rem_euclid(360.0))
        .collect();
    angles.sort_by(f32::total_cmp);
    let Some((&first, &last)) = angles.first().zip(angles.last()) else {
        // All from the camera: no side is darker than another.
        return (0.0, 0.0);
    };
    let gaps = angles.windows(2).map(|pair| (pair[1] - pair[0], pair[0]));
    let around = (first + 360.0 - last, last);
    let (gap, before) = gaps.fold(around, |widest, one| match one.0 > widest.0 {
        true => one,
        false => widest,
    });
    (gap, (before + gap / 2.0 + 180.0).rem_euclid(360.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A light at this azimuth and tilt from the viewing axis, in degrees.
    fn light(azimuth: f32, tilt: f32) -> Light {
        let (azimuth, tilt) = (azimuth.to_radians(), tilt.to_radians());
        let (sine, cosine) = tilt.sin_cos();
        Light::new(
            Vec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine),
            1.0,
        )
    }

    #[test]
    fn a_ring_is_no_plane_and_no_side() {
        let ring: Vec<Light> = (0..8).map(|k| light(45.0 * k as f32, 45.0)).collect();
        let coverage = LightCoverage::of(&ring).unwrap();
        // Second moments of a ring: sin^2 / 2 twice, cos^2.
        assert!((coverage.off_plane - 0.5).abs() < 1e-6);
        assert!((coverage.dark_degrees - 45.0).abs() < 1e-3);
        assert!(!coverage.is_flat() && coverage.one_side().is_none());
        assert_eq!(LightCoverage::of(&[]), None);
    }

    #[test]
    fn an_arch_over_the_object_is_a_plane() {
        for azimuth in [0.0, 30.0, 77.0] {
            let tilts = [-60.0, -30.0, 0.0, 20.0, 50.0];
            let arch = tilts.map(|tilt| light(azimuth, tilt));
            let coverage = LightCoverage::of(&arch).unwrap();
            assert!(coverage.off_plane < 1e-3 && coverage.is_flat());
        }
        // A lamp that hardly moved shows no more.
        let close = [0.0, 120.0, 240.0].map(|azimuth| light(azimuth, 5.0));
        assert!(LightCoverage::of(&close).unwrap().is_flat());
    }

    #[test]
    fn the_side_has_its_name() {
        for (middle, name) in [
            (0.0, "the right"),
            (90.0, "above"),
            (135.0, "the upper left"),
            (180.0, "the left"),
            (350.0, "the right"),
            (271.0, "below"),
        ] {
            let lights = [-60.0, -20.0, 0.0, 70.0].map(|turn| light(middle + turn - 5.0, 50.0));
            let coverage = LightCoverage::of(&lights).unwrap();
            assert!((coverage.dark_degrees - 230.0).abs() < 1e-2);
            assert_eq!(coverage.one_side(), Some(name));
        }
    }
}
