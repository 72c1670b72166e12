use normalight_core::{Light, NormalMap, Vec3};

/// What is known about a stack before a guided light network looks at it once more.
#[derive(Debug, Clone, Copy)]
pub struct Known<'a> {
    /// Normals estimated with these lights, of the stack's size.
    pub normals: &'a NormalMap,
    /// One light per image.
    pub lights: &'a [Light],
}

/// What a guided light network is shown besides photographs and mask, on the pixels of its view: the
/// estimated normals, and how bright a white matt object with these normals would be under the light
/// that was estimated for the image. Where the photograph shows it brighter or darker than that, light
/// or normals are wrong (GCNet, Chen et al. 2020).
#[derive(Debug, Clone)]
pub struct Guidance {
    /// Unit length, zero outside the object; `[size, size]`.
    normals: Vec<Vec3>,
    /// Direction times intensity relative to the stack's mean, one per image.
    lights: Vec<Vec3>,
}

impl Guidance {
    /// Input channels that it takes: the normal's x, y, z, and the shading.
    pub const CHANNELS: usize = 4;

    /// `normals`: `[size, size]`, rows from the top, zero outside the object. `lights`: one per image; only
    /// their relative brightness counts.
    pub fn new(normals: Vec<Vec3>, lights: &[Light]) -> Self {
        let sum: f32 = lights.iter().map(Light::mean_intensity).sum();
        let mean = (sum / lights.len().max(1) as f32).max(1e-12);
        let relative = |light: &Light| light.direction * (light.mean_intensity() / mean);
        Self {
            normals,
            lights: lights.iter().map(relative).collect(),
        }
    }

    /// The channels of a pixel of one image: unit normal and relative intensity times max(0, n . l).
    pub fn channels(&self, image: usize, pixel: usize) -> [f32; Self::CHANNELS] {
        let normal = self.normals[pixel];
        let shading = normal.dot(self.lights[image]).max(0.0);
        [normal.x, normal.y, normal.z, shading]
    }
}
