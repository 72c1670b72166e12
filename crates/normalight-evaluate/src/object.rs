use crate::EvaluateError;
use normalight_core::{ImageStack, Light, Mask, NormalMap, Vec3, reduced};

/// An object with what is known of the truth about it.
#[derive(Debug, Clone)]
pub struct BenchmarkObject {
    /// Its name.
    pub name: String,
    /// The photographs.
    pub stack: ImageStack,
    /// Its pixels.
    pub mask: Mask,
    /// The true light of each photograph; `None` where they are withheld, or not one direction each.
    pub lights: Option<Vec<Light>>,
    /// The true normals; pixels with zero are left out. `None` where they are withheld.
    pub normals: Option<NormalMap>,
}

impl BenchmarkObject {
    /// The same object under some of its photographs.
    ///
    /// # Errors
    /// [`EvaluateError::Core`] for too few of them; an index without a photograph counts as none.
    pub fn with_photographs(&self, indices: &[usize]) -> Result<Self, EvaluateError> {
        let images = indices.iter().filter_map(|&at| self.stack.images().get(at));
        let stack = ImageStack::new(images.cloned().collect())?;
        let chosen = |lights: &Vec<Light>| {
            let lights = indices.iter().filter_map(|&at| lights.get(at));
            lights.copied().collect()
        };
        Ok(Self {
            name: self.name.clone(),
            stack,
            mask: self.mask.clone(),
            lights: self.lights.as_ref().map(chosen),
            normals: self.normals.clone(),
        })
    }

    /// The smallest frame around the object, at most `side` pixels long; smaller objects stay as they are.
    ///
    /// # Errors
    /// [`EvaluateError::Core`]: those of [`reduced`].
    pub fn reduced_to(&self, side: usize) -> Result<Self, EvaluateError> {
        // An object without pixels is refused by what follows.
        let Some(part) = self.mask.bounding_box() else {
            return Ok(self.clone());
        };
        let part = part.grown(1, self.mask.width(), self.mask.height());
        let longer = part.width.max(part.height);
        if longer <= side {
            return Ok(self.clone());
        }
        let shorter = |length: usize| (length * side).div_ceil(longer);
        let size = [part.width, part.height].map(shorter);
        let unknown = || {
            let pixels = vec![Vec3::ZERO; self.mask.inside().len()];
            NormalMap::new(self.mask.width(), self.mask.height(), pixels)
        };
        let normals = self.normals.clone().unwrap_or_else(unknown);
        let small = reduced(&self.stack, &self.mask, &normals, part, size)?;
        Ok(Self {
            name: self.name.clone(),
            stack: small.stack,
            mask: small.mask,
            lights: self.lights.clone(),
            normals: self.normals.as_ref().map(|_| small.normals),
        })
    }
}
