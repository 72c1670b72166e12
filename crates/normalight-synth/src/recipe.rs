use serde::{Deserialize, Serialize};

/// The distribution samples are drawn from; every part has defaults that trained well.
///
/// Shares and probabilities lie in 0..=1, `[low, high]` pairs are the ends of a range. Call
/// [`SceneRecipe::validate`] on recipes from outside before rendering.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SceneRecipe {
    /// Which objects.
    pub shapes: ShapeRecipe,
    /// What they are made of.
    pub materials: MaterialRecipe,
    /// Where the lights stand and how bright they are.
    pub lights: LightRecipe,
    /// Light that does not come straight from the lamp.
    pub transport: TransportRecipe,
    /// How the camera sees it.
    pub camera: CameraRecipe,
}

/// Distribution of shapes. The first five are weights, which need not sum to one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ShapeRecipe {
    /// Weight of plain spheres.
    pub sphere: f32,
    /// Weight of rotated ellipsoids.
    pub ellipsoid: f32,
    /// Weight of smooth blobs in any orientation.
    pub blob: f32,
    /// Weight of upright turned shapes: vases, bowls, bottles.
    pub lathe: f32,
    /// Weight of upright figures: busts, standing or sitting statues, animals.
    pub statue: f32,
    /// Largest tilt of upright objects towards or away from the camera, degrees in 0..=60.
    pub max_tilt_degrees: f32,
    /// Share of objects with bumps, folds or carving on the surface.
    pub relief_share: f32,
    /// Share of the objects with relief where it is strong and detailed.
    pub strong_relief_share: f32,
    /// Object size in pixels that crops are cut from, `[low, high]` in 32..=1024, log-uniform.
    pub crop_object_pixels: [f32; 2],
    /// Empty border of whole-object views, share of the side, `[low, high]` in 0..=0.3.
    pub margin: [f32; 2],
}

impl Default for ShapeRecipe {
    fn default() -> Self {
        Self {
            sphere: 0.07,
            ellipsoid: 0.13,
            blob: 0.3,
            lathe: 0.25,
            statue: 0.25,
            max_tilt_degrees: 25.0,
            relief_share: 0.5,
            strong_relief_share: 0.15,
            crop_object_pixels: [64.0, 192.0],
            margin: [0.02, 0.07],
        }
    }
}

/// Distribution of materials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MaterialRecipe {
    /// Share of materials that are metal: coloured highlights, hardly any diffuse light.
    pub metal_share: f32,
    /// Share of materials without any highlight.
    pub matte_share: f32,
    /// Share of materials with a rough, retro-reflecting diffuse term.
    pub rough_diffuse_share: f32,
    /// Share of materials with a velvet-like rim.
    pub sheen_share: f32,
    /// Share of the objects made of two or three materials.
    pub mixed_share: f32,
    /// Share of materials with a pattern in their colour.
    pub textured_share: f32,
    /// Diffuse albedo per channel, `[low, high]` in 0..=1.
    pub albedo: [f32; 2],
    /// Reflectance at normal incidence of non-metals, `[low, high]` in 0..=0.2.
    pub dielectric_f0: [f32; 2],
    /// GGX roughness alpha, `[low, high]` in 0.02..=1, log-uniform.
    pub roughness: [f32; 2],
}

impl Default for MaterialRecipe {
    fn default() -> Self {
        Self {
            metal_share: 0.15,
            matte_share: 0.2,
            rough_diffuse_share: 0.35,
            sheen_share: 0.1,
            mixed_share: 0.35,
            textured_share: 0.25,
            albedo: [0.05, 0.95],
            dielectric_f0: [0.02, 0.08],
            roughness: [0.1, 0.8],
        }
    }
}

/// Distribution of lights. The first three are weights, which need not sum to one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightRecipe {
    /// Weight of a frontal rectangle: azimuth and elevation uniform.
    pub rectangle: f32,
    /// Weight of a cap around the viewing axis, uniform in solid angle.
    pub cap: f32,
    /// Weight of an evenly spaced ring around the viewing axis.
    pub ring: f32,
    /// Half width of the rectangle in degrees, 1..=85.
    pub rectangle_degrees: f32,
    /// Radius of the cap in degrees, `[low, high]` in 1..=85.
    pub cap_degrees: [f32; 2],
    /// Angle between ring and viewing axis in degrees, `[low, high]` in 1..=85.
    pub ring_degrees: [f32; 2],
    /// Share of scenes whose lights are shifted to one side.
    pub shift_share: f32,
    /// Largest shift in degrees, 0..=45.
    pub shift_degrees: f32,
    /// Share of scenes with equally bright lights.
    pub equal_share: f32,
    /// Share of scenes with brightness uniform within +-30 %; the rest is log-uniform.
    pub mild_share: f32,
    /// Brightness, `[low, high]` in 0.01..=100, log-uniform.
    pub intensity: [f32; 2],
}

impl Default for LightRecipe {
    fn default() -> Self {
        Self {
            rectangle: 0.4,
            cap: 0.45,
            ring: 0.15,
            rectangle_degrees: 45.0,
            cap_degrees: [40.0, 75.0],
            ring_degrees: [30.0, 65.0],
            shift_share: 0.3,
            shift_degrees: 15.0,
            equal_share: 0.2,
            mild_share: 0.3,
            intensity: [0.2, 2.0],
        }
    }
}

/// Light that does not come straight from the lamp.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TransportRecipe {
    /// Share of scenes with cast shadows.
    pub cast_shadow_share: f32,
    /// Share of scenes where surfaces light each other (one bounce).
    pub bounce_share: f32,
    /// Share of scenes with constant ambient light.
    pub ambient_share: f32,
    /// Strongest ambient light relative to the lamp, 0..=1.
    pub ambient: f32,
}

impl Default for TransportRecipe {
    fn default() -> Self {
        Self {
            cast_shadow_share: 0.6,
            bounce_share: 0.35,
            ambient_share: 0.2,
            ambient: 0.05,
        }
    }
}

/// Distribution of cameras.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CameraRecipe {
    /// Mean value of the object over all images, `[low, high]` in 0.001..=1, log-uniform.
    pub mean: [f32; 2],
    /// Share of scenes exposed without regard to highlights, which then clip at 1.
    pub clip_share: f32,
    /// Noise in the dark and relative noise at full scale, `[low, high]` in 0..=0.2, log-uniform.
    pub noise: [f32; 2],
    /// Share of scenes stored in 8 linear bits.
    pub linear_8_bit_share: f32,
    /// Share of scenes stored in 8 bits of sRGB; the rest is stored in 16 linear bits.
    pub srgb_8_bit_share: f32,
}

impl Default for CameraRecipe {
    fn default() -> Self {
        Self {
            mean: [0.05, 0.4],
            clip_share: 0.6,
            noise: [0.001, 0.02],
            linear_8_bit_share: 0.5,
            srgb_8_bit_share: 0.1,
        }
    }
}
