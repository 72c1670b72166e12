//! Rendered scenes as files, so that a run need not render them again.
use super::crops::Crops;
use super::{Scene, SceneLight};
use crate::SynthError;
use crate::lighting::Lamp;
use crate::recipe::SceneRecipe;
use crate::shapes::{View, Window};
use glam::Vec3;
use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, TensorView};
use std::collections::HashMap;

/// Largest side of a stored scene in pixels.
const MOST_PIXELS: usize = 4096;

impl Scene {
    /// The scene as a safetensors file, without rounding: `depth` (`[height, width]`, negative infinity
    /// outside the object), `normals` (`[points, 3]`), `lamps` (`[lamps, 4]`: direction and distance),
    /// `radiance` (`[lamps, 3, points]`), `ambient` (`[3, points]`, where there is any) and `window`.
    ///
    /// # Errors
    /// [`SynthError::Stored`] when the file would be too large for its format.
    pub fn to_bytes(&self) -> Result<Vec<u8>, SynthError> {
        let window = &self.view.window;
        let inside = (0..self.view.depth.len()).filter(|&pixel| self.view.is_inside(pixel));
        let normals: Vec<f32> = inside
            .flat_map(|pixel| self.view.normals[pixel].to_array())
            .collect();
        let points = normals.len() / 3;
        let place = [
            window.left,
            window.top,
            window.pitch,
            window.inverse_distance,
        ];
        let lamps = self.light.lamps.iter().flat_map(|lamp| {
            let [x, y, z] = lamp.direction.to_array();
            [x, y, z, lamp.distance.unwrap_or(f32::INFINITY)]
        });
        // Planes are padded for vector instructions; the padding is not kept.
        let planes = |planes: &[Vec<f32>; 3]| -> Vec<f32> {
            planes
                .iter()
                .flat_map(|plane| &plane[..points])
                .copied()
                .collect()
        };
        let mut arrays = vec![
            ("window", vec![4], place.to_vec()),
            (
                "depth",
                vec![window.height, window.width],
                self.view.depth.clone(),
            ),
            ("normals", vec![points, 3], normals),
            ("lamps", vec![self.light.lamps.len(), 4], lamps.collect()),
            (
                "radiance",
                vec![self.light.lamps.len(), 3, points],
                self.light.radiance.iter().flat_map(planes).collect(),
            ),
        ];
        if let Some(ambient) = &self.light.ambient {
            arrays.push(("ambient", vec![3, points], planes(ambient)));
        }
        encode(arrays).map_err(|error| SynthError::Stored {
            name: "scene".to_owned(),
            found: error.to_string(),
            expected: "a scene that can be stored".to_owned(),
        })
    }

    /// Reads what [`Scene::to_bytes`] wrote. `name` is for messages; `crop` is the side of the crops to
    /// be cut from it, `None` for the whole picture. Brightness and camera come from `recipe`, and
    /// [`Scene::reseeded`] must say which samples the scene is for.
    ///
    /// # Errors
    /// [`SynthError::Stored`]: not a stored scene, or one too small for the crops.
    pub fn from_bytes(
        recipe: &SceneRecipe,
        name: &str,
        bytes: &[u8],
        crop: Option<usize>,
    ) -> Result<Self, SynthError> {
        let file = File::open(name, bytes)?;
        let (shape, depth) = file.array("depth")?;
        let side = match shape[..] {
            [height, width] if height == width && width <= MOST_PIXELS => width,
            _ => return Err(file.error(format!("depth of {shape:?}"), "a square picture")),
        };
        if side < crop.unwrap_or(1) {
            let expected = format!("at least {} pixels", crop.unwrap_or(1));
            return Err(file.error(format!("{side} pixels a side"), expected));
        }
        let window = file.shaped("window", &[4])?;
        let window = Window {
            left: window[0],
            top: window[1],
            pitch: window[2],
            width: side,
            height: side,
            inverse_distance: window[3],
        };
        let area = depth.len();
        let mut view = View {
            window,
            // The far side only matters for shadows, which are done.
            back: depth.clone(),
            depth,
            normals: vec![Vec3::ZERO; area],
        };
        let inside: Vec<usize> = (0..area).filter(|&pixel| view.is_inside(pixel)).collect();
        let points = inside.len();
        let normals = file.shaped("normals", &[points, 3])?;
        for (&pixel, normal) in inside.iter().zip(normals.chunks_exact(3)) {
            view.normals[pixel] = Vec3::from_slice(normal);
        }
        let (shape, lamps) = file.array("lamps")?;
        let count = match shape[..] {
            [count, 4] if count > 0 => count,
            _ => return Err(file.error(format!("lamps of {shape:?}"), "[lamps, 4]")),
        };
        let lamps = lamps.chunks_exact(4).map(|lamp| {
            let direction = Vec3::new(lamp[0], lamp[1], lamp[2]);
            match lamp[3].is_finite() {
                true => Lamp::near(direction, lamp[3]),
                false => Lamp::distant(direction),
            }
        });
        let planes = |values: &[f32]| -> [Vec<f32>; 3] {
            std::array::from_fn(|channel| values[channel * points..(channel + 1) * points].to_vec())
        };
        let radiance = file.shaped("radiance", &[count, 3, points])?;
        // A scene of nothing has no values to divide among the lamps.
        let radiance = (0..count).map(|lamp| planes(&radiance[3 * lamp * points..]));
        let crops = crop.map(|size| Crops::new(&view, size));
        let ambient = match file.tensors.tensor("ambient") {
            Ok(_) => Some(planes(&file.shaped("ambient", &[3, points])?)),
            Err(_) => None,
        };
        let light = SceneLight {
            lamps: lamps.collect(),
            radiance: radiance.collect(),
            ambient,
        };
        Ok(Self::new(0, recipe, view, crops, light))
    }
}

fn encode(
    arrays: Vec<(&str, Vec<usize>, Vec<f32>)>,
) -> Result<Vec<u8>, safetensors::SafeTensorError> {
    let arrays: Vec<(&str, Vec<usize>, Vec<u8>)> = arrays
        .into_iter()
        .map(|(name, shape, values)| {
            let bytes = values.iter().flat_map(|value| value.to_le_bytes());
            (name, shape, bytes.collect())
        })
        .collect();
    let views = arrays
        .iter()
        .map(|(name, shape, bytes)| {
            TensorView::new(Dtype::F32, shape.clone(), bytes).map(|view| (*name, view))
        })
        .collect::<Result<Vec<_>, _>>()?;
    safetensors::serialize(views, None::<HashMap<String, String>>)
}

/// A file being read, with errors that name it.
struct File<'a> {
    name: &'a str,
    tensors: SafeTensors<'a>,
}

impl<'a> File<'a> {
    fn open(name: &'a str, bytes: &'a [u8]) -> Result<Self, SynthError> {
        let tensors = SafeTensors::deserialize(bytes).map_err(|error| SynthError::Stored {
            name: name.to_owned(),
            found: error.to_string(),
            expected: "a stored scene".to_owned(),
        })?;
        Ok(Self { name, tensors })
    }

    /// Shape and values.
    fn array(&self, array: &str) -> Result<(Vec<usize>, Vec<f32>), SynthError> {
        let view = self.tensors.tensor(array);
        let view = view.map_err(|error| self.error(error.to_string(), array))?;
        if view.dtype() != Dtype::F32 {
            return Err(self.error(format!("{array} of {:?}", view.dtype()), "F32"));
        }
        let values = view.data().chunks_exact(4);
        let values = values.map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]]));
        Ok((view.shape().to_vec(), values.collect()))
    }

    fn shaped(&self, array: &str, shape: &[usize]) -> Result<Vec<f32>, SynthError> {
        let (found, values) = self.array(array)?;
        if found != shape {
            return Err(self.error(format!("{array} of {found:?}"), format!("{shape:?}")));
        }
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(self.error(format!("{value} in {array}"), "finite numbers"));
        }
        Ok(values)
    }

    fn error(&self, found: String, expected: impl Into<String>) -> SynthError {
        SynthError::Stored {
            name: self.name.to_owned(),
            found,
            expected: expected.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Preset, Renderer};

    #[test]
    fn a_stored_scene_gives_the_same_samples() {
        let recipe = Preset::World.recipe();
        let renderer = Renderer::new(recipe.clone()).unwrap();
        for number in 0..6 {
            let scene = renderer.crop_scene(number, 8, 32);
            let bytes = scene.to_bytes().unwrap();
            let stored = Scene::from_bytes(&recipe, "scene", &bytes, Some(32)).unwrap();
            assert_eq!(stored.lamps(), scene.lamps());
            let (scene, stored) = (scene.reseeded(7), stored.reseeded(7));
            for (one, other) in [
                (scene.crop(3, 6), stored.crop(3, 6)),
                (scene.whole(4), stored.whole(4)),
            ] {
                assert_eq!((&one.images, &one.mask), (&other.images, &other.mask));
                assert_eq!((&one.normals, &one.lights), (&other.normals, &other.lights));
                // Outside the object it is NaN, which does not equal itself.
                let bits = |depth: &[f32]| depth.iter().map(|z| z.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&one.depth), bits(&other.depth));
            }
            // Another seed gives other samples of the same object.
            let other = Scene::from_bytes(&recipe, "scene", &bytes, Some(32)).unwrap();
            assert_ne!(other.reseeded(8).crop(3, 6).images, scene.crop(3, 6).images);
        }
    }

    #[test]
    fn damaged_files_are_refused_by_name() {
        let recipe = Preset::World.recipe();
        let renderer = Renderer::new(recipe.clone()).unwrap();
        let bytes = renderer.whole_scene(1, 3, 24).to_bytes().unwrap();
        let error = |bytes: &[u8], crop| match Scene::from_bytes(&recipe, "scene-1", bytes, crop) {
            Ok(_) => panic!("it was read"),
            Err(error) => error.to_string(),
        };
        assert!(error(&bytes[..bytes.len() - 4], None).starts_with("scene-1: "));
        assert!(error(&bytes, Some(32)).contains("24 pixels a side found"));
        let renamed = String::from_utf8_lossy(&bytes).into_owned();
        assert!(renamed.contains("radiance"));
        let at = bytes
            .windows(8)
            .position(|name| name == b"radiance")
            .unwrap();
        let mut other = bytes.clone();
        other[at] = b'R';
        assert!(error(&other, None).contains("radiance"));
        let mut nan = bytes;
        let last = nan.len() - 4;
        nan[last..].copy_from_slice(&f32::NAN.to_le_bytes());
        assert!(error(&nan, None).contains("finite"));
    }
}
