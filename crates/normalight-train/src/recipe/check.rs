use super::TrainRecipe;
use crate::TrainError;
use normalight_run::{RunError, check};

/// Gigabytes of memory that scenes and validation objects may take.
pub(crate) const MOST_GIGABYTES: f64 = 16.0;

impl TrainRecipe {
    /// Gigabytes of the scenes that one rendering thread holds.
    pub(crate) fn gigabytes_of_scenes(&self) -> f64 {
        let lights = self.scene.sampling.lights_per_scene.max(self.images[1]);
        let pixels = f64::from(self.scene.shapes.crop_object_pixels[1]).max(self.size as f64);
        (self.batch * lights * 12) as f64 * pixels * pixels / 1e9
    }

    /// Scenes of a batch and validation objects are held in memory.
    fn check_memory(&self) -> Result<(), TrainError> {
        const EXPECTED: &str = "at most 16";
        let scenes = self.gigabytes_of_scenes() * self.loader_threads.unwrap_or(1) as f64;
        let field = "gigabytes of scenes (batch, loader_threads, \
                     scene.sampling.lights_per_scene, scene.shapes.crop_object_pixels)";
        check(field, scenes, 0.0..=MOST_GIGABYTES, EXPECTED)?;
        let objects = (self.validation_objects * 144) as f64 * (self.size * self.size) as f64 / 1e9;
        let field = "gigabytes of validation_objects";
        Ok(check(field, objects, 0.0..=MOST_GIGABYTES, EXPECTED)?)
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`RunError::Value`], or the errors of the scene and the architectures.
    pub fn validate(&self) -> Result<(), TrainError> {
        let [fewest, most] = self.images;
        check("steps", self.steps, 1..=100_000_000, "1 or more")?;
        check("batch", self.batch, 1..=1024, "1 to 1024")?;
        let field = "images, fewest";
        check(field, fewest, 3..=most, "3 or more, at most the most")?;
        check("images, most", most, fewest..=256, "at most 256")?;
        check("size", self.size, 16..=512, "16 to 512")?;
        let many = 1_000_000_000;
        check("validate_every", self.validate_every, 1..=many, "1 or more")?;
        let field = "checkpoint_every";
        check(field, self.checkpoint_every, 1..=many, "1 or more")?;
        // More would not leave room for the steps in the seeds of samples.
        check("seed", self.seed, 0..=(1 << 20) - 1, "0 to 1048575")?;
        let field = "validation_objects";
        check(field, self.validation_objects, 1..=10_000, "1 to 10000")?;
        let threads = self.loader_threads.unwrap_or(1);
        check("loader_threads", threads, 1..=1024, "1 to 1024")?;
        self.check_memory()?;
        self.optimiser.validate()?;
        self.network.validate(self.size)?;
        self.scene.validate()?;
        if let Some(cache) = &self.cache {
            check("cache.scenes", cache.scenes, 1..=100_000_000, "1 or more")?;
            if self.published.is_some() {
                return Err(TrainError::Run(RunError::Value {
                    field: "cache",
                    found: "given beside published".into(),
                    expected: "rendered scenes; a published set is read from its own folder",
                }));
            }
        }
        Ok(())
    }
}
