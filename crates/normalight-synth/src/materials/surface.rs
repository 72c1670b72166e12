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
    pub(crate) measured: [Vec3; MAX_LAYERS],
}

/// Most layers of one material.
pub(crate) const MAX_LAYERS: usize = 3;

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
        measured: [Vec3::ZERO; MAX_LAYERS],
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
