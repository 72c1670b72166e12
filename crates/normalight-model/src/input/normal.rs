use normalight_core::Light;

/// Light below this, relative to full scale, counts as none when pixels are normalised.
const DARK: f32 = 1e-6;

/// What the normal network sees of the images of one stack, or of a part of it: linear RGB divided by the light's
/// intensity, then each pixel and channel by its root mean square over the images, which takes the albedo away; the
/// direction of the light; perhaps the mask.
#[derive(Debug, Clone)]
pub struct NormalInput {
    mask_channel: bool,
    inside: Vec<bool>,
    /// Reciprocal of the root mean square over the images, `[3, area]`; zero outside the object and where all is dark.
    scale: Vec<f32>,
}

impl NormalInput {
    /// Channels of a pixel: R, G, B, the light's x, y, z, and the mask (1 inside) if the network wants it.
    pub const fn channels(mask_channel: bool) -> usize {
        6 + mask_channel as usize
    }

    /// Channels of what it encodes.
    pub fn channel_count(&self) -> usize {
        Self::channels(self.mask_channel)
    }

    /// Looks once at every image.
    ///
    /// # Shapes
    /// - inside: `[area]`
    /// - `read(image, planes)` writes the image's linear RGB, `[3, area]`, for every light
    pub fn new(
        mask_channel: bool,
        inside: Vec<bool>,
        lights: &[Light],
        mut read: impl FnMut(usize, &mut [f32]),
    ) -> Self {
        let area = inside.len();
        let mut scale = vec![0.0; 3 * area];
        let mut planes = vec![0.0; 3 * area];
        for (image, light) in lights.iter().enumerate() {
            read(image, &mut planes);
            let sums = scale.chunks_exact_mut(area.max(1));
            for ((sums, plane), factor) in sums
                .zip(planes.chunks_exact(area.max(1)))
                .zip(factors(light))
            {
                for (sum, value) in sums.iter_mut().zip(plane) {
                    *sum += (value * factor).powi(2);
                }
            }
        }
        for plane in scale.chunks_exact_mut(area.max(1)) {
            for (sum, &inside) in plane.iter_mut().zip(&inside) {
                let rms = (*sum / lights.len() as f32).sqrt();
                *sum = if inside && rms > DARK { 1.0 / rms } else { 0.0 };
            }
        }
        Self {
            mask_channel,
            inside,
            scale,
        }
    }

    /// Writes one image; each pixel goes to the `place` that it is given. Places that none is given keep their colours
    /// and mask and get the direction like the others.
    ///
    /// # Shapes
    /// - planes: `[3, area]`: linear RGB
    /// - out: `[places, channels]`
    ///
    /// # Panics
    /// If a place lies outside `out`.
    pub fn encode(
        &self,
        planes: &[f32],
        light: &Light,
        place: impl Fn(usize) -> usize,
        out: &mut [f32],
    ) {
        let area = self.inside.len();
        let channels = self.channel_count();
        let direction = light.direction.to_array();
        for pixel in out.chunks_exact_mut(channels) {
            pixel[3..6].copy_from_slice(&direction);
        }
        let factors = factors(light);
        for (pixel, &inside) in self.inside.iter().enumerate() {
            let out = &mut out[place(pixel) * channels..][..channels];
            for (channel, factor) in factors.iter().enumerate() {
                let from = channel * area + pixel;
                out[channel] = planes[from] * factor * self.scale[from];
            }
            if self.mask_channel {
                out[6] = f32::from(u8::from(inside));
            }
        }
    }
}

/// What takes a light's intensity out of each channel.
fn factors(light: &Light) -> [f32; 3] {
    light
        .intensity
        .map(|intensity| 1.0 / intensity.max(f32::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_core::Vec3;

    /// Closed form: two pixels of a matte plane under two coloured lights; albedo and colours of the lights go, what
    /// stays is shading over its root mean square.
    #[test]
    fn albedo_and_the_colours_of_lights_go() {
        let lights = [
            (Vec3::new(0.0, 0.0, 1.0), [0.5, 1.0, 2.0]),
            (Vec3::new(0.6, 0.0, 0.8), [1.5, 0.7, 0.2]),
        ]
        .map(|(direction, intensity)| Light {
            intensity,
            ..Light::new(direction, 1.0)
        });
        let albedo = [[0.2, 0.9, 0.4], [0.7, 0.1, 0.3]];
        let shading = [1.0, 0.8];
        let read = |image: usize, planes: &mut [f32]| {
            for channel in 0..3 {
                for pixel in 0..2 {
                    planes[2 * channel + pixel] =
                        albedo[pixel][channel] * lights[image].intensity[channel] * shading[image];
                }
            }
        };
        let input = NormalInput::new(true, vec![true, true], &lights, read);
        let rms = (shading.map(|s: f32| s * s).iter().sum::<f32>() / 2.0).sqrt();
        for image in 0..2 {
            let (mut planes, mut out) = (vec![0.0; 6], vec![0.0; 14]);
            read(image, &mut planes);
            // The pixels change places.
            input.encode(&planes, &lights[image], |pixel| 1 - pixel, &mut out);
            for pixel in out.chunks_exact(7) {
                let [x, y, z] = lights[image].direction.to_array();
                let expected = [shading[image] / rms; 3];
                for (found, expected) in pixel.iter().zip(expected.iter().chain(&[x, y, z, 1.0])) {
                    assert!((found - expected).abs() < 1e-6, "{pixel:?}");
                }
            }
        }
    }

    #[test]
    fn nothing_is_seen_outside_the_object_or_in_the_dark() {
        let lights = [Light::new(Vec3::Z, 0.0), Light::new(Vec3::X, 1.0)];
        let values = [0.5, 0.0, 0.5, 0.5, 0.0, 0.5, 0.5, 0.0, 0.5];
        let input = NormalInput::new(false, vec![true, true, false], &lights[1..], |_, planes| {
            planes.copy_from_slice(&values);
        });
        let mut out = vec![0.0; 18];
        input.encode(&values, &lights[1], |pixel| pixel, &mut out);
        assert_eq!(out[..6], [1.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
        assert_eq!(out[6..12], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        assert_eq!(out[12..], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        // A light of no intensity gives no infinities in a dark pixel.
        let input = NormalInput::new(false, vec![true; 3], &lights, |_, planes| planes.fill(0.0));
        input.encode(&[0.0; 9], &lights[0], |pixel| pixel, &mut out);
        assert!(out.iter().all(|value| value.is_finite()));
    }
}
