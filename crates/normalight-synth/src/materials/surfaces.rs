use super::material::Material;
use super::measured::Measured;
use super::surface::Surface;
use crate::lanes::padded;
use crate::noise::Lattice;
use glam::Vec3;

/// The surfaces of many points, one plane for each number; padded with harmless values.
#[derive(Debug, Clone)]
pub(crate) struct Surfaces {
    pub(crate) albedo: [Vec<f32>; 3],
    /// The two factors of Oren & Nayar's formula.
    pub(crate) facets: [Vec<f32>; 2],
    pub(crate) f0: [Vec<f32>; 3],
    pub(crate) alphas: [Vec<f32>; 2],
    pub(crate) wide_alpha: Vec<f32>,
    pub(crate) weights: [Vec<f32>; 2],
    pub(crate) sheen: Vec<f32>,
    /// Unit vector along the brushing, at right angles to the normal.
    pub(crate) tangent: [Vec<f32>; 3],
    /// The measured layers and the colour factors of each.
    pub(crate) measured: Vec<(Measured, [Vec<f32>; 3])>,
    /// Share of light from all around that is scattered, by everything the point is made of.
    pub(crate) scattered: [Vec<f32>; 3],
    /// Whether any point shines at all; matte objects need no highlights computed.
    pub(crate) shiny: bool,
}

impl Surfaces {
    /// Of a material at the given points.
    pub(crate) fn new(material: &Material, places: &[Vec3], normals: &[Vec3]) -> Self {
        let lattice = Lattice::shared();
        let surfaces = places.iter().map(|&place| material.at(lattice, place));
        Self::from_iter(surfaces, normals, material.measured())
    }

    /// One for every normal.
    pub(crate) fn from_iter(
        points: impl Iterator<Item = Surface>,
        normals: &[Vec3],
        measured: &[Measured],
    ) -> Self {
        let count = padded(normals.len());
        let plane = || vec![0.0; count];
        let three = || std::array::from_fn(|_| plane());
        let mut surfaces = Self {
            albedo: three(),
            facets: [vec![1.0; count], plane()],
            f0: three(),
            alphas: [vec![1.0; count], vec![1.0; count]],
            wide_alpha: vec![1.0; count],
            weights: [plane(), plane()],
            sheen: plane(),
            tangent: three(),
            measured: measured
                .iter()
                .map(|layer| (layer.clone(), three()))
                .collect(),
            scattered: three(),
            shiny: false,
        };
        for (index, (point, &normal)) in points.zip(normals).enumerate() {
            surfaces.set(index, &point, normal);
        }
        surfaces
    }

    fn set(&mut self, index: usize, surface: &Surface, normal: Vec3) {
        let variance = surface.facet_variance;
        self.facets[0][index] = 1.0 - 0.5 * variance / (variance + 0.33);
        self.facets[1][index] = 0.45 * variance / (variance + 0.09);
        let tangent = surface.axis.cross(normal);
        let tangent = tangent.normalize_or(normal.any_orthonormal_vector());
        let mut scattered = surface.albedo
            + surface.f0 * (0.5 * (surface.weights[0] + surface.weights[1]).min(1.0));
        for (k, (layer, _)) in self.measured.iter().enumerate() {
            scattered += surface.measured[k] * layer.scattered();
        }
        for channel in 0..3 {
            self.albedo[channel][index] = surface.albedo[channel];
            self.f0[channel][index] = surface.f0[channel];
            self.tangent[channel][index] = tangent[channel];
            self.scattered[channel][index] = scattered[channel].min(1.0);
            for (k, (_, planes)) in self.measured.iter_mut().enumerate() {
                planes[channel][index] = surface.measured[k][channel];
            }
        }
        for lobe in 0..2 {
            self.alphas[lobe][index] = surface.alphas[lobe];
            self.weights[lobe][index] = surface.weights[lobe];
        }
        self.wide_alpha[index] = surface.wide_alpha;
        self.sheen[index] = surface.sheen;
        self.shiny |= surface.weights[0] + surface.weights[1] > 0.0;
    }
}
