use crate::{CoreError, ImageStack, Light, Mask};

/// Photographs of an object under lights that are known or estimated: what calibrated photometric stereo starts from.
#[derive(Debug, Clone, Copy)]
pub struct CalibratedStack<'a> {
    stack: &'a ImageStack,
    mask: &'a Mask,
    lights: &'a [Light],
}

impl<'a> CalibratedStack<'a> {
    /// # Errors
    /// [`CoreError::LightCount`] unless there is one light per photograph; those of [`ImageStack::check_mask`].
    pub fn new(
        stack: &'a ImageStack,
        mask: &'a Mask,
        lights: &'a [Light],
    ) -> Result<Self, CoreError> {
        stack.check_mask(mask, "mask")?;
        if lights.len() != stack.len() {
            return Err(CoreError::LightCount {
                found: lights.len(),
                expected: stack.len(),
            });
        }
        Ok(Self {
            stack,
            mask,
            lights,
        })
    }

    /// The photographs.
    pub fn stack(&self) -> &'a ImageStack {
        self.stack
    }

    /// The object's pixels: as large as the photographs, not empty.
    pub fn mask(&self) -> &'a Mask {
        self.mask
    }

    /// One light per photograph.
    pub fn lights(&self) -> &'a [Light] {
        self.lights
    }
}
