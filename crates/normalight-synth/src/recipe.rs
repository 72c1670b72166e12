//! The numbers that describe a distribution of samples.
mod check;
mod meshes;
mod preset;
mod ranges;

pub use meshes::MeshFolder;
pub use preset::Preset;

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The distribution samples are drawn from.
///
/// Shares and probabilities lie in 0..=1, `[low, high]` pairs are the ends of a range. The default is
/// [`Preset::World`]. As text, a recipe is the name of a preset and whatever differs from it:
///
/// ```toml
/// preset = "world"
/// [materials]
/// measured_share = 0.5
/// measured_file = "merl_nbrdf.npz"
/// ```
///
/// Unknown keys are refused. [`crate::Renderer::new`] checks the numbers and reads the files.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
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
    /// How many samples share a scene.
    pub sampling: SamplingRecipe,
}

/// Distribution of shapes. The first seven are weights, which need not sum to one.
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
    /// Weight of flat objects: coins, plaques, carved stone, cloth, bark.
    pub plate: f32,
    /// Weight of the meshes in `mesh_folders`.
    pub mesh: f32,
    /// Where meshes come from; needed when `mesh` is positive. In files `mesh_folder = "x"` is short for
    /// one folder alone.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mesh_folders: Vec<MeshFolder>,
    /// Where the meshes of validation objects come from instead, see [`crate::Renderer::validation`]; no
    /// file may be in both. None given: from `mesh_folders`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub validation_meshes: Vec<MeshFolder>,
    /// Angle in degrees, 0..=180, above which the faces of a mesh meet in an edge; up to it they are
    /// smooth.
    pub crease_degrees: f32,
    /// Largest tilt of upright objects towards or away from the camera, degrees in 0..=60.
    pub max_tilt_degrees: f32,
    /// Share of upright objects in any orientation instead.
    pub tumbled_share: f32,
    /// Share of objects with bumps, folds or carving on the surface.
    pub relief_share: f32,
    /// Share of the objects with relief where it is strong and detailed.
    pub strong_relief_share: f32,
    /// Share of meshes with such relief on their own surface.
    pub mesh_relief_share: f32,
    /// Share of objects, of any shape, with grooves or grains a few pixels wide, which are darker the deeper
    /// they are for their width.
    pub fine_relief_share: f32,
    /// Share of turned shapes that are open and seen into: bowls, cups.
    pub open_vessel_share: f32,
    /// Object size in pixels that crops are cut from, `[low, high]` in 32..=1024, log-uniform.
    pub crop_object_pixels: [f32; 2],
    /// Share of scenes seen by a camera at a finite distance.
    pub perspective_share: f32,
    /// Its distance in object sizes, `[low, high]` in 2..=100, log-uniform.
    pub camera_distance: [f32; 2],
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
            plate: 0.15,
            mesh: 0.0,
            mesh_folders: Vec::new(),
            validation_meshes: Vec::new(),
            crease_degrees: 40.0,
            max_tilt_degrees: 25.0,
            tumbled_share: 0.1,
            relief_share: 0.5,
            strong_relief_share: 0.15,
            mesh_relief_share: 0.25,
            fine_relief_share: 0.2,
            open_vessel_share: 0.2,
            crop_object_pixels: [64.0, 192.0],
            perspective_share: 0.3,
            camera_distance: [3.0, 20.0],
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
    /// Share of metals with highlights as wide as shading: sand-blasted, coarsely brushed, painted.
    pub broad_metal_share: f32,
    /// Share of materials, of those not measured, that are dark polished stone.
    pub dark_stone_share: f32,
    /// Share of materials without any highlight.
    pub matte_share: f32,
    /// Share of materials with a rough, retro-reflecting diffuse term.
    pub rough_diffuse_share: f32,
    /// Share of materials with a velvet-like rim.
    pub sheen_share: f32,
    /// Share of materials that are measured ones from `measured_file`; the shares above apply to the
    /// rest.
    pub measured_share: f32,
    /// Measured materials as small networks: an `.npz` file with `W` (`[materials, 675]`, f32, in the
    /// order of C); needed when `measured_share` is positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_file: Option<PathBuf>,
    /// Share of the objects made of two or three materials.
    pub mixed_share: f32,
    /// Share of materials with a pattern in their colour.
    pub textured_share: f32,
    /// Share of materials whose roughness changes over the surface.
    pub rough_texture_share: f32,
    /// Share of materials with highlights that are brushed: longer across than along.
    pub brushed_share: f32,
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
            broad_metal_share: 0.5,
            dark_stone_share: 0.05,
            matte_share: 0.2,
            rough_diffuse_share: 0.35,
            sheen_share: 0.1,
            measured_share: 0.0,
            measured_file: None,
            mixed_share: 0.35,
            textured_share: 0.35,
            rough_texture_share: 0.2,
            brushed_share: 0.15,
            albedo: [0.05, 0.95],
            dielectric_f0: [0.02, 0.08],
            roughness: [0.1, 0.8],
        }
    }
}

/// Distribution of lights. The first five are weights, which need not sum to one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightRecipe {
    /// Weight of a frontal rectangle: azimuth and elevation uniform.
    pub rectangle: f32,
    /// Weight of a cap around the viewing axis, uniform in solid angle.
    pub cap: f32,
    /// Weight of an evenly spaced ring around the viewing axis.
    pub ring: f32,
    /// Weight of a dome: rings of lamps on several heights.
    pub dome: f32,
    /// Weight of a hand moving a lamp along a path around the object.
    pub path: f32,
    /// Half width of the rectangle in degrees, 1..=85.
    pub rectangle_degrees: f32,
    /// Radius of the cap in degrees, `[low, high]` in 1..=85; domes and paths keep within it, too, but for
    /// the few degrees by which hands err.
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
    /// Share of scenes whose lights differ in colour.
    pub colour_share: f32,
    /// Largest relative difference of a channel, 0..=0.5.
    pub colour: f32,
    /// Share of scenes with lamps at a finite distance.
    pub near_share: f32,
    /// Their distance from the object's middle in object sizes, `[low, high]` in 1..=100, log-uniform.
    pub near_distance: [f32; 2],
}

impl Default for LightRecipe {
    fn default() -> Self {
        Self {
            rectangle: 0.35,
            cap: 0.35,
            ring: 0.1,
            dome: 0.05,
            path: 0.15,
            rectangle_degrees: 45.0,
            cap_degrees: [40.0, 75.0],
            ring_degrees: [30.0, 65.0],
            shift_share: 0.3,
            shift_degrees: 15.0,
            equal_share: 0.2,
            mild_share: 0.3,
            intensity: [0.2, 2.0],
            colour_share: 0.3,
            colour: 0.1,
            near_share: 0.15,
            near_distance: [2.0, 6.0],
        }
    }
}

/// Light that does not come straight from the lamp.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TransportRecipe {
    /// Share of scenes with cast shadows.
    pub cast_shadow_share: f32,
    /// Share of scenes where surfaces light each other (one bounce, and all further ones as a factor).
    pub bounce_share: f32,
    /// Share of scenes with ambient light that is the same in all images.
    pub ambient_share: f32,
    /// Strongest ambient light relative to a lamp of intensity 1, 0..=1.
    pub ambient: f32,
}

impl Default for TransportRecipe {
    fn default() -> Self {
        Self {
            cast_shadow_share: 0.8,
            bounce_share: 0.5,
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
    /// Relative noise at full scale, `[low, high]` in 0..=0.2, log-uniform; noise in the dark is a 4th to a
    /// 50th of it.
    pub noise: [f32; 2],
    /// Share of scenes stored in 8 linear bits.
    pub linear_8_bit_share: f32,
    /// Share of scenes stored in 8 bits of sRGB.
    pub srgb_8_bit_share: f32,
    /// Share of scenes stored as JPEG; what the three shares leave is stored in 16 linear bits.
    pub jpeg_share: f32,
    /// JPEG quality on the usual scale, `[low, high]` in 1..=100.
    pub jpeg_quality: [f32; 2],
    /// Share of scenes whose images are out of register.
    pub shift_share: f32,
    /// Deviation of the shift in pixels, `[low, high]` in 0..=2.
    pub shift_pixels: [f32; 2],
    /// Share of scenes that are slightly out of focus.
    pub blur_share: f32,
    /// Deviation of the blur in pixels, `[low, high]` in 0..=1.
    pub blur_pixels: [f32; 2],
}

impl Default for CameraRecipe {
    fn default() -> Self {
        Self {
            mean: [0.03, 0.4],
            clip_share: 0.6,
            noise: [0.001, 0.02],
            linear_8_bit_share: 0.4,
            srgb_8_bit_share: 0.1,
            jpeg_share: 0.15,
            jpeg_quality: [70.0, 97.0],
            shift_share: 0.15,
            shift_pixels: [0.05, 0.4],
            blur_share: 0.3,
            blur_pixels: [0.2, 0.7],
        }
    }
}

/// How crops come out of scenes. Rendering a scene costs more than cutting a crop and taking new
/// pictures of it, so several crops share a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SamplingRecipe {
    /// Crops of one scene, each with lights, exposure and noise of its own, 1..=32.
    pub crops_per_scene: usize,
    /// Lights a scene is rendered with, of which every crop gets some, 1..=256; more when a crop asks
    /// for more.
    pub lights_per_scene: usize,
}

impl Default for SamplingRecipe {
    fn default() -> Self {
        Self {
            crops_per_scene: 8,
            lights_per_scene: 32,
        }
    }
}
