use crate::{CoreError, ImageStack, Light, Mask, NormalMap};
use glam::Vec3;

/// Bins along each of x and y for the entropy of normals.
const BINS: usize = 16;

/// What a stack of photographs looks like in numbers, to compare rendered with real ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StackStatistics {
    /// Share of the frame that shows the object.
    pub cover: f64,
    /// Mean value of the object over all images and channels, 0..=1.
    pub mean: f64,
    /// Share of the object's samples that are zero in 8 bits: deep shadow.
    pub black: f64,
    /// Share of the object's samples that are full in 8 bits.
    pub saturated: f64,
    /// Mean over the pixels of the brightest sample over the images, relative to the pixel's mean:
    /// high for shiny things and deep shadows.
    pub contrast: f64,
    /// Entropy of the normals' x and y in 16 x 16 bins, bits: 0 for a plane, 7.6 for a sphere.
    pub normal_entropy: f64,
    /// Mean angle between lights and viewing axis, degrees.
    pub light_mean_degrees: f64,
    /// Largest angle between a light and the viewing axis, degrees.
    pub light_most_degrees: f64,
}

impl StackStatistics {
    /// Of a stack with known normals and lights.
    ///
    /// # Errors
    /// Sizes of mask, normals and stack differ.
    pub fn new(
        stack: &ImageStack,
        mask: &Mask,
        normals: &NormalMap,
        lights: &[Light],
    ) -> Result<Self, CoreError> {
        let (width, height) = (stack.width(), stack.height());
        stack.check_mask(mask, "mask")?;
        if (normals.width(), normals.height()) != (width, height) {
            return Err(CoreError::MapSize {
                found_width: normals.width(),
                found_height: normals.height(),
                expected_width: width,
                expected_height: height,
            });
        }
        let inside = mask.pixels();
        let mut values = vec![[0.0; 3]; inside.len()];
        let mut sums = vec![0.0f64; inside.len()];
        let mut peaks = vec![0.0f64; inside.len()];
        let (mut total, mut black, mut saturated) = (0.0, 0, 0);
        for image in 0..stack.len() {
            stack.linear_pixels(image, &inside, &mut values);
            for (index, colours) in values.iter().enumerate() {
                let mut grey = 0.0;
                for &value in colours {
                    grey += f64::from(value) / 3.0;
                    black += usize::from(value < 0.5 / 255.0);
                    saturated += usize::from(value > 254.5 / 255.0);
                }
                total += grey;
                sums[index] += grey;
                peaks[index] = peaks[index].max(grey);
            }
        }
        let pixels = inside.len().max(1) as f64;
        let images = stack.len() as f64;
        let samples = 3.0 * pixels * images;
        let contrasts = sums.iter().zip(&peaks).filter(|(sum, _)| **sum > 0.0);
        let contrast: f64 = contrasts.map(|(sum, peak)| peak * images / sum).sum();
        let polar = |light: &Light| f64::from(light.direction.z.clamp(-1.0, 1.0)).acos();
        let degrees: Vec<f64> = lights.iter().map(|l| polar(l).to_degrees()).collect();
        Ok(Self {
            cover: inside.len() as f64 / (width * height) as f64,
            mean: total / (pixels * images),
            black: black as f64 / samples,
            saturated: saturated as f64 / samples,
            contrast: contrast / pixels,
            normal_entropy: entropy(inside.iter().map(|&pixel| normals.normals()[pixel])),
            light_mean_degrees: degrees.iter().sum::<f64>() / degrees.len().max(1) as f64,
            light_most_degrees: degrees.iter().copied().fold(0.0, f64::max),
        })
    }

    /// The figures in their order of declaration.
    pub fn figures(&self) -> [f64; 8] {
        [
            self.cover,
            self.mean,
            self.black,
            self.saturated,
            self.contrast,
            self.normal_entropy,
            self.light_mean_degrees,
            self.light_most_degrees,
        ]
    }
}

fn entropy(normals: impl Iterator<Item = Vec3>) -> f64 {
    let mut counts = [0usize; BINS * BINS];
    let mut total = 0usize;
    for normal in normals {
        let bin = |value: f32| (((value + 1.0) / 2.0 * BINS as f32) as usize).min(BINS - 1);
        counts[bin(normal.y) * BINS + bin(normal.x)] += 1;
        total += 1;
    }
    let shares = counts.iter().filter(|&&count| count > 0);
    shares
        .map(|&count| {
            let share = count as f64 / total as f64;
            -share * share.log2()
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Samples, StackImage, Transfer};

    #[test]
    fn planes_have_no_entropy_and_spheres_that_of_their_disc() {
        assert_eq!(entropy(std::iter::repeat_n(Vec3::Z, 100)), 0.0);
        // Seen from the front the normals of a sphere fill a disc of x and y evenly: of the 256 bins
        // about pi / 4 are in use.
        let side = 400;
        let places = (0..side * side).map(|p| {
            let x = (p % side) as f32 / side as f32 * 2.0 - 1.0;
            let y = (p / side) as f32 / side as f32 * 2.0 - 1.0;
            Vec3::new(x, y, (1.0 - x * x - y * y).max(-1.0))
        });
        let sphere = entropy(
            places
                .filter(|place| place.z > 0.0)
                .map(|place| Vec3::new(place.x, place.y, place.z.sqrt())),
        );
        let expected = (256.0 * std::f64::consts::FRAC_PI_4).log2();
        assert!((sphere - expected).abs() < 0.12, "{sphere} {expected}");
    }

    #[test]
    fn shares_count_samples_of_the_object_only() {
        // Of 16 pixels the first two belong to the object: black, full and 51 / 255, and all 51.
        let mut values = vec![255; 48];
        values[..6].copy_from_slice(&[0, 255, 51, 51, 51, 51]);
        let images = (0..3).map(|_| StackImage {
            name: "a.png".to_owned(),
            width: 4,
            height: 4,
            channels: 3,
            samples: Samples::U8(values.clone()),
            transfer: Transfer::Linear,
        });
        let stack = ImageStack::new(images.collect()).unwrap();
        let mask = Mask::new(4, 4, (0..16).map(|pixel| pixel < 2).collect());
        let normals = NormalMap::new(4, 4, vec![Vec3::Z; 16]);
        let lights = [Light::new(Vec3::new(0.0, 0.6, 0.8), 1.0)];
        let found = StackStatistics::new(&stack, &mask, &normals, &lights).unwrap();
        assert_eq!(found.cover, 0.125);
        assert!((found.black - 1.0 / 6.0).abs() < 1e-9);
        assert!((found.saturated - 1.0 / 6.0).abs() < 1e-9);
        assert!((found.mean - (1.2 / 3.0 + 0.2) / 2.0).abs() < 1e-6);
        assert!((found.contrast - 1.0).abs() < 1e-6);
        assert!((found.light_mean_degrees - 36.87).abs() < 0.01);
    }
}
