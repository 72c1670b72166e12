use crate::{CoreError, Mask};
use glam::Vec3;

/// A unit surface normal for every pixel of an object; zero outside the mask.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalMap {
    width: usize,
    height: usize,
    normals: Vec<Vec3>,
}

impl NormalMap {
    /// A map from one vector per pixel, rows from the top, brought to unit length; vectors without
    /// a direction (zero, NaN) become zero.
    ///
    /// # Panics
    /// `normals` has not width * height entries.
    pub fn new(width: usize, height: usize, normals: Vec<Vec3>) -> Self {
        assert_eq!(normals.len(), width * height);
        let normals = normals.into_iter().map(Vec3::normalize_or_zero).collect();
        Self {
            width,
            height,
            normals,
        }
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// One vector per pixel, rows from the top.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Zero outside the mask.
    ///
    /// # Errors
    /// [`CoreError::MapSize`] when the sizes differ.
    pub fn masked(mut self, mask: &Mask) -> Result<Self, CoreError> {
        if (mask.width(), mask.height()) != (self.width, self.height) {
            return Err(CoreError::MapSize {
                found_width: mask.width(),
                found_height: mask.height(),
                expected_width: self.width,
                expected_height: self.height,
            });
        }
        for (normal, &inside) in self.normals.iter_mut().zip(mask.inside()) {
            if !inside {
                *normal = Vec3::ZERO;
            }
        }
        Ok(self)
    }
}
