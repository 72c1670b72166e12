use crate::SynthError;
use crate::materials::Measured;
use crate::recipe::SceneRecipe;
use crate::sample::Sample;
use crate::scene::{Scene, SceneContext};
use crate::shapes::{Library, check_apart};

/// What part of the object a sample shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Framing {
    /// All of it, its longer side filling the square but for a margin: the view of the light
    /// network.
    WholeObject,
    /// A random square cut from a larger picture of the object, at least 40 % object (less only of the
    /// most slender ones), turned or mirrored, its colours in any order.
    Crop,
}

/// Draws samples from a recipe; everything it does depends on the recipe and the sample's number alone.
pub struct Renderer {
    recipe: SceneRecipe,
    meshes: Library,
    measured: Vec<Measured>,
}

impl Renderer {
    /// Checks the recipe and reads the files it names.
    ///
    /// # Errors
    /// A number out of range, or a file that is missing or has other contents than expected.
    pub fn new(recipe: SceneRecipe) -> Result<Self, SynthError> {
        recipe.validate()?;
        let shapes = &recipe.shapes;
        let meshes = match shapes.mesh > 0.0 {
            true => Library::read(&shapes.mesh_folders, shapes.crease_degrees)?,
            false => Library::default(),
        };
        let measured = match &recipe.materials.measured_file {
            Some(file) if recipe.materials.measured_share > 0.0 => Measured::read(file)?,
            _ => Vec::new(),
        };
        Ok(Self {
            recipe,
            meshes,
            measured,
        })
    }

    /// The renderer of validation objects: the same, but for the meshes where the recipe names others for
    /// validation.
    ///
    /// # Errors
    /// Folders or files that cannot be read, or a mesh that is in both lists.
    pub fn validation(&self) -> Result<Self, SynthError> {
        let shapes = &self.recipe.shapes;
        let meshes = if shapes.validation_meshes.is_empty() || shapes.mesh == 0.0 {
            self.meshes.clone()
        } else {
            check_apart(&shapes.mesh_folders, &shapes.validation_meshes)?;
            Library::read(&shapes.validation_meshes, shapes.crease_degrees)?
        };
        Ok(self.with_meshes(meshes))
    }

    /// Two renderers whose meshes differ: each has every second one of the recipe's.
    ///
    /// # Errors
    /// Those of [`Self::new`]; a single mesh, which cannot be divided.
    pub fn halves(recipe: SceneRecipe) -> Result<[Self; 2], SynthError> {
        let whole = Self::new(recipe)?;
        if whole.meshes.len() == 1 {
            return Err(SynthError::OutOfRange {
                field: "number of meshes in shapes.mesh_folders",
                found: "1".into(),
                expected: "2 or more, to give each half of a search its own",
            });
        }
        Ok([0, 1].map(|half| whole.with_meshes(whole.meshes.half(half))))
    }

    fn with_meshes(&self, meshes: Library) -> Self {
        Self {
            recipe: self.recipe.clone(),
            meshes,
            measured: self.measured.clone(),
        }
    }

    /// The recipe.
    pub fn recipe(&self) -> &SceneRecipe {
        &self.recipe
    }

    /// Sample number `number`: always the same bits for the same arguments, on any machine and thread.
    /// The shape and materials do not depend on `images`.
    ///
    /// # Panics
    /// `images` or `size` is zero.
    pub fn sample(&self, number: u64, images: usize, size: usize, framing: Framing) -> Sample {
        match framing {
            Framing::WholeObject => self.whole_scene(number, images, size).whole(images),
            Framing::Crop => {
                let parts = self.recipe.sampling.crops_per_scene as u64;
                let part = (number % parts) as usize;
                self.crop_scene(number / parts, images, size)
                    .crop(part, images)
            }
        }
    }

    /// The scene behind whole-object sample `number`, with `images` lamps.
    ///
    /// # Panics
    /// `images` or `size` is zero.
    pub fn whole_scene(&self, number: u64, images: usize, size: usize) -> Scene {
        assert!(images > 0 && size > 0, "a scene needs lamps and pixels");
        Scene::of_whole(&self.context(number), images, size)
    }

    /// The scene that crops number `crops_per_scene * number` and following are cut from. It has the
    /// recipe's lamps, or `images` if that is more.
    ///
    /// # Panics
    /// `images` or `size` is zero.
    pub fn crop_scene(&self, number: u64, images: usize, size: usize) -> Scene {
        assert!(images > 0 && size > 0, "a scene needs lamps and pixels");
        let lamps = self.recipe.sampling.lights_per_scene.max(images);
        Scene::for_crops(&self.context(number), lamps, size)
    }

    fn context(&self, seed: u64) -> SceneContext<'_> {
        SceneContext {
            recipe: &self.recipe,
            meshes: &self.meshes,
            measured: &self.measured,
            seed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MaterialRecipe, Preset};

    /// Measured and modelled layers on one object, patterns and brushing on both.
    #[test]
    fn mixtures_of_measured_and_modelled_materials_give_pictures() {
        let recipe = SceneRecipe {
            materials: MaterialRecipe {
                measured_share: 0.5,
                mixed_share: 1.0,
                matte_share: 0.0,
                ..MaterialRecipe::default()
            },
            ..Preset::World.recipe()
        };
        let renderer = Renderer {
            recipe,
            meshes: Library::default(),
            measured: (0..8).map(Measured::for_tests).collect(),
        };
        for number in 0..60 {
            let sample = renderer.sample(number, 3, 40, Framing::WholeObject);
            let inside = sample.mask.iter().filter(|inside| **inside).count();
            let mean = sample.images.iter().sum::<f32>() / (9 * inside) as f32;
            // Cameras are exposed for a mean of 0.03 to 0.4; clipped highlights lower it.
            assert!((1e-3..0.45).contains(&mean), "sample {number}: {mean}");
            let lit = sample.images.iter().filter(|value| **value > 0.0).count();
            assert!(lit > inside, "sample {number}: {lit} of {}", 9 * inside);
        }
    }
}
