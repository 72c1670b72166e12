use crate::lanes::padded;
use crate::shapes::View;
use glam::Vec3;

/// The visible points of a view in the order of their pixels, each coordinate a padded plane.
pub(crate) struct Points {
    /// Their pixels.
    pub(crate) pixels: Vec<u32>,
    pub(crate) places: Vec<Vec3>,
    pub(crate) normals: Vec<Vec3>,
    /// `places` once more; padding is zero.
    pub(crate) place: [Vec<f32>; 3],
    /// `normals` once more; padding is zero, which no lamp lights.
    pub(crate) normal: [Vec<f32>; 3],
    /// Unit vectors towards the camera; padding looks up.
    pub(crate) to_camera: [Vec<f32>; 3],
    /// How many times as deep as wide the narrow grooves are that the points lie in, padded; empty without
    /// any.
    pub(crate) grooves: Vec<f32>,
}

impl Points {
    pub(crate) fn new(view: &View) -> Self {
        let pixels: Vec<u32> = (0..view.depth.len())
            .filter(|&pixel| view.is_inside(pixel))
            .map(|pixel| pixel as u32)
            .collect();
        let rays: Vec<_> = pixels
            .iter()
            .map(|&p| view.window.ray(p as usize))
            .collect();
        let depths = pixels.iter().map(|&pixel| view.depth[pixel as usize]);
        let places: Vec<Vec3> = rays.iter().zip(depths).map(|(ray, z)| ray.at(z)).collect();
        let normals: Vec<Vec3> = pixels.iter().map(|&p| view.normals[p as usize]).collect();
        let to_camera: Vec<Vec3> = rays.iter().map(|ray| ray.to_camera()).collect();
        Self::from_parts(pixels, places, normals, &to_camera)
    }

    pub(crate) fn from_parts(
        pixels: Vec<u32>,
        places: Vec<Vec3>,
        normals: Vec<Vec3>,
        to_camera: &[Vec3],
    ) -> Self {
        Self {
            place: planes(&places, Vec3::ZERO),
            normal: planes(&normals, Vec3::ZERO),
            to_camera: planes(to_camera, Vec3::Z),
            pixels,
            places,
            normals,
            grooves: Vec::new(),
        }
    }

    /// With the grooves of each pixel, if there are any.
    pub(crate) fn with_grooves(mut self, grooves: &[f32]) -> Self {
        if !grooves.is_empty() {
            let of_points = self.pixels.iter().map(|&pixel| grooves[pixel as usize]);
            self.grooves = of_points.collect();
            self.grooves.resize(padded(self.pixels.len()), 0.0);
        }
        self
    }

    pub(crate) fn count(&self) -> usize {
        self.pixels.len()
    }
}

fn planes(vectors: &[Vec3], padding: Vec3) -> [Vec<f32>; 3] {
    std::array::from_fn(|axis| {
        let mut plane: Vec<f32> = vectors.iter().map(|vector| vector[axis]).collect();
        plane.resize(padded(vectors.len()), padding[axis]);
        plane
    })
}
