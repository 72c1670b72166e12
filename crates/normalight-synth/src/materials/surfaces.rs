use super::material::Material;
use super::measured::Measured;
use crate::lanes::padded;
use crate::noise::Lattice;
use glam::Vec3;

/// What one point of the surface is made of. Colours are linear RGB.
///
/// Light is measured so that white matte paper facing a lamp of intensity 1 has the value 1: the
/// reflectance function times pi times the cosine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface {
    /// Share of light scattered diffusely.
    pub(crate) albedo: Vec3,
    /// Oren-Nayar roughness: deviation of the facets' slope in radians, squared.
    pub(crate) facet_variance: f32,
    /// Mirror reflectance at normal incidence.
    pub(crate) f0: Vec3,
    /// GGX widths (alpha) of the narrow highlight along and across the brushing.
    pub(crate) alphas: [f32; 2],
    /// GGX width of the wide highlight.
    pub(crate) wide_alpha: f32,
    /// Weights of the narrow and the wide highlight.
    pub(crate) weights: [f32; 2],
    /// Velvet-like rim.
    pub(crate) sheen: f32,
    /// Axis that brushing runs around.
    pub(crate) axis: Vec3,
    /// Colour factors of the material's measured layers: how much of each is here.
    pub(crate) measured: [Vec3; MAX_SUBSTANCES],
}

/// Most layers of one material.
pub(crate) const MAX_SUBSTANCES: usize = 3;

impl Surface {
    /// Black, without highlights; their widths are harmless rather than zero, because they are computed
    /// wherever any point of the object shines.
    pub(crate) const MATTE: Self = Self {
        albedo: Vec3::ZERO,
        facet_variance: 0.0,
        f0: Vec3::ZERO,
        alphas: [1.0; 2],
        wide_alpha: 1.0,
        weights: [0.0; 2],
        sheen: 0.0,
        axis: Vec3::Y,
        measured: [Vec3::ZERO; MAX_SUBSTANCES],
    };

    /// Everything in between: `share` of `other`, the rest of `self`.
    pub(crate) fn mixed(&self, other: &Self, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + (b - a) * share;
        let pair = |a: [f32; 2], b: [f32; 2]| [mix(a[0], b[0]), mix(a[1], b[1])];
        Self {
            albedo: self.albedo.lerp(other.albedo, share),
            facet_variance: mix(self.facet_variance, other.facet_variance),
            f0: self.f0.lerp(other.f0, share),
            alphas: pair(self.alphas, other.alphas),
            wide_alpha: mix(self.wide_alpha, other.wide_alpha),
            weights: pair(self.weights, other.weights),
            sheen: mix(self.sheen, other.sheen),
            axis: if share < 0.5 { self.axis } else { other.axis },
            measured: std::array::from_fn(|k| self.measured[k].lerp(other.measured[k], share)),
        }
    }
}

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
    /// Colour factors for each measured layer.
    pub(crate) measured: Vec<[Vec<f32>; 3]>,
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
            measured: measured.iter().map(|_| three()).collect(),
            scattered: three(),
            shiny: false,
        };
        for (index, (point, &normal)) in points.zip(normals).enumerate() {
            surfaces.set(index, &point, normal, measured);
        }
        surfaces
    }

    fn set(&mut self, index: usize, surface: &Surface, normal: Vec3, measured: &[Measured]) {
        let variance = surface.facet_variance;
        self.facets[0][index] = 1.0 - 0.5 * variance / (variance + 0.33);
        self.facets[1][index] = 0.45 * variance / (variance + 0.09);
        let tangent = surface.axis.cross(normal);
        let tangent = tangent.normalize_or(normal.any_orthonormal_vector());
        let mut scattered = surface.albedo
            + surface.f0 * (0.5 * (surface.weights[0] + surface.weights[1]).min(1.0));
        for (k, layer) in measured.iter().enumerate() {
            scattered += surface.measured[k] * layer.scattered();
        }
        for channel in 0..3 {
            self.albedo[channel][index] = surface.albedo[channel];
            self.f0[channel][index] = surface.f0[channel];
            self.tangent[channel][index] = tangent[channel];
            self.scattered[channel][index] = scattered[channel].min(1.0);
            for (k, planes) in self.measured.iter_mut().enumerate() {
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
