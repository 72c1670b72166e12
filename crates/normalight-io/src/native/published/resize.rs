//! Smaller objects, for a search over architectures.
use super::PublishedObject;
use crate::IoError;
use normalight_core::{Rect, reduced};

impl PublishedObject {
    /// The object in a square of `side` pixels, see [`reduced`].
    ///
    /// # Errors
    /// [`IoError::SetFormat`] when the object is not square or smaller than asked;
    /// [`IoError::Core`] when nothing of the object is left, or `side` is too small.
    pub fn resized(&self, side: usize) -> Result<Self, IoError> {
        let (width, height) = (self.stack.width(), self.stack.height());
        if width != height || width < side {
            return Err(IoError::SetFormat {
                name: self.entry.to_string(),
                found: format!("{width}x{height} pixels"),
                expected: format!("a square of at least {side}x{side}"),
            });
        }
        let whole = Rect::whole(width, height);
        let small = reduced(&self.stack, &self.mask, &self.normals, whole, [side; 2])?;
        Ok(Self {
            entry: self.entry.clone(),
            stack: small.stack,
            mask: small.mask,
            normals: small.normals,
            lights: self.lights.clone(),
        })
    }
}
