use super::crops::Crops;
use super::{Points, Scene, SceneLight};
use crate::SynthError;
use crate::lighting::Lamp;
use crate::random::{Random, Stream};
use crate::recipe::SceneRecipe;
use crate::shapes::{View, Window};
use normalight_core::{CoreError, ImageStack, Light, Mask, NormalMap};

/// Photographs of one object with the truth about it, from whatever source.
#[derive(Debug, Clone, Copy)]
pub struct Labelled<'a> {
    /// The photographs, square.
    pub stack: &'a ImageStack,
    /// Which pixels show the object.
    pub mask: &'a Mask,
    /// Its normals.
    pub normals: &'a NormalMap,
    /// One light per photograph.
    pub lights: &'a [Light],
}

impl Scene {
    /// A scene of finished photographs, taken apart: samples of it have brightness, exposure and noise of
    /// their own, drawn from the recipe, and the lamps in an order that `seed` decides.
    ///
    /// `crop`: side of the crops to be cut from it; `None` for the whole picture.
    ///
    /// # Errors
    /// [`SynthError::Photographs`]: sizes or numbers that do not fit, an empty mask, or a picture that is
    /// not square or smaller than the crops.
    pub fn from_photographs(
        recipe: &SceneRecipe,
        seed: u64,
        labelled: Labelled,
        crop: Option<usize>,
    ) -> Result<Self, SynthError> {
        let Labelled {
            stack,
            mask,
            normals,
            lights,
        } = labelled;
        let side = check(labelled, crop)?;
        let window = Window::square(0.5 * side as f32, 0.5 * side as f32, side as f32, side, 0.0);
        // Depth is not known; what is needed of it here is only where there is any.
        let inside = mask.inside().iter();
        let depth: Vec<f32> = inside
            .map(|&inside| if inside { 0.0 } else { f32::NEG_INFINITY })
            .collect();
        let back = depth.clone();
        let view = View::from_planes(window, depth, back, normals.normals().to_vec());
        let points = Points::new(&view);
        let pixels: Vec<usize> = points.pixels.iter().map(|&pixel| pixel as usize).collect();

        let order = Random::new(seed, Stream::Lights).some_of(lights.len(), lights.len());
        let mut values = vec![[0.0; 3]; pixels.len()];
        let radiance = order.iter().map(|&image| {
            stack.linear_pixels(image, &pixels, &mut values);
            let intensity = lights[image].intensity;
            std::array::from_fn(|channel| {
                let factor = 1.0 / intensity[channel].max(f32::MIN_POSITIVE);
                values.iter().map(|value| value[channel] * factor).collect()
            })
        });
        let radiance = radiance.collect();
        let lamps = order
            .iter()
            .map(|&image| Lamp::distant(lights[image].direction));
        let lamps = lamps.collect();
        let crops = crop.map(|size| Crops::new(&view, size));
        let light = SceneLight {
            lamps,
            radiance,
            ambient: None,
        };
        let mut scene = Self::new(seed, recipe, view, crops, light);
        scene.depth_known = false;
        Ok(scene)
    }
}

/// The side of the picture.
fn check(labelled: Labelled, crop: Option<usize>) -> Result<usize, SynthError> {
    let (width, height) = (labelled.stack.width(), labelled.stack.height());
    labelled.stack.check_mask(labelled.mask, "mask")?;
    let (found_width, found_height) = (labelled.normals.width(), labelled.normals.height());
    if (found_width, found_height) != (width, height) {
        return Err(SynthError::Photographs(CoreError::MapSize {
            found_width,
            found_height,
            expected_width: width,
            expected_height: height,
        }));
    }
    if labelled.lights.len() != labelled.stack.len() {
        return Err(SynthError::Photographs(CoreError::LightCount {
            found: labelled.lights.len(),
            expected: labelled.stack.len(),
        }));
    }
    let least = crop.unwrap_or(1);
    if width != height || width < least {
        return Err(SynthError::Size {
            width,
            height,
            least,
        });
    }
    Ok(width)
}
