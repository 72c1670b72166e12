use crate::EvaluateError;
use normalight_core::{ImageStack, Light, Mask, NormalMap, reduced};

/// An object with the truth about it.
#[derive(Debug, Clone)]
pub struct BenchmarkObject {
    /// Its name.
    pub name: String,
    /// The photographs.
    pub stack: ImageStack,
    /// Its pixels.
    pub mask: Mask,
    /// The true light of each photograph.
    pub lights: Vec<Light>,
    /// The true normals; pixels with zero are left out.
    pub normals: NormalMap,
}

impl BenchmarkObject {
    /// The same object under some of its photographs.
    ///
    /// # Errors
    /// [`EvaluateError::Core`] for too few of them; an index without a photograph counts as none.
    pub fn with_photographs(&self, indices: &[usize]) -> Result<Self, EvaluateError> {
        let images = indices.iter().filter_map(|&at| self.stack.images().get(at));
        let stack = ImageStack::new(images.cloned().collect())?;
        let lights = indices.iter().filter_map(|&at| self.lights.get(at));
        Ok(Self {
            name: self.name.clone(),
            stack,
            mask: self.mask.clone(),
            lights: lights.copied().collect(),
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
        let small = reduced(&self.stack, &self.mask, &self.normals, part, size)?;
        Ok(Self {
            name: self.name.clone(),
            stack: small.stack,
            mask: small.mask,
            lights: self.lights.clone(),
            normals: small.normals,
        })
    }
}
