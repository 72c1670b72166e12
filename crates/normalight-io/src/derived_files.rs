//! What is made of normals: depth, meshes, maps for painting. The same from every program.
use crate::IoError;
use crate::depth_files::{
    curvature_png, height_exr, height_png, height_tiff, normals_exr, occlusion_png,
};
use crate::mesh_files::{MeshFileFormat, Texture, mesh_as_files};
use crate::texture_maps::{
    MapSettings, Outside, albedo_map_png, albedo_pixels, check, normal_map_png, painted,
};
use normalight_core::{
    Bow, DepthMap, DepthSettings, Mask, NormalMap, Seamless, Vec3, integrate_normals,
};
use serde::{Deserialize, Serialize};

/// What to make of normals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify), tsify(missing_as_null))]
#[serde(default)]
pub struct DerivedSettings {
    /// How normals become depth.
    pub depth: DepthSettings,
    /// Take off the bow of a nearly flat object first.
    pub flatten: bool,
    /// Heights as PNG, TIFF and EXR.
    pub heights: bool,
    /// A mesh in this format.
    pub mesh: Option<MeshFileFormat>,
    /// About how many triangles it may have at most.
    pub triangles: usize,
    /// Maps for painting and engines: normals, albedo, height, curvature, ambient occlusion.
    pub maps: Option<MapSettings>,
    /// Fade opposite edges of the maps into each other, so that they repeat without seams.
    pub tileable: bool,
}

impl Default for DerivedSettings {
    fn default() -> Self {
        Self {
            depth: DepthSettings::default(),
            flatten: false,
            heights: false,
            mesh: None,
            triangles: 1_000_000,
            maps: None,
            tileable: false,
        }
    }
}

impl DerivedSettings {
    /// Whether anything is asked for.
    pub fn wanted(&self) -> bool {
        self.heights || self.mesh.is_some() || self.maps.is_some()
    }
}

/// What is known of derived files: `depth.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify), tsify(missing_as_null))]
pub struct DerivedReport {
    /// What was asked for.
    pub settings: DerivedSettings,
    /// Lowest and highest height in pixels, towards the camera; the mean of each part is zero.
    pub range: [f32; 2],
    /// Connected parts of the mask, whose heights have nothing to do with each other.
    pub parts: usize,
    /// Pixels without a normal, filled in.
    pub missing: usize,
    /// Pixels whose normal is turned too far from the camera to be used, filled in.
    pub steep: usize,
    /// Share of neighbouring pixels between which the surface is torn.
    pub torn: f32,
    /// Pixels of height for one step of grey in `height.png`.
    pub height_step: Option<f32>,
    /// The same in `map-height.png`.
    pub map_height_step: Option<f32>,
    /// Curvature (1 / pixels) that is white in `map-curvature.png`.
    pub curvature_white: Option<f32>,
    /// Every how many pixels the mesh has a vertex.
    pub mesh_step: Option<usize>,
}

/// What was made of normals.
#[derive(Debug, Clone)]
pub struct Derived {
    /// Name and content of every file; `depth.json` is the last.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// What is known of them.
    pub report: DerivedReport,
    /// The shape that they show, the bow taken off if that was asked for.
    pub depth: DepthMap,
}

/// Derives all that is asked for.
///
/// # Shapes
/// `albedo`: `[3, height, width]`, linear; without it there are no colours.
///
/// # Errors
/// Those of [`integrate_normals`], [`DepthMap::mesh`] and [`Seamless::new`];
/// [`CoreError::SampleCount`](normalight_core::CoreError::SampleCount); [`IoError::Encode`].
pub fn derived_files(
    normals: &NormalMap,
    albedo: Option<&[f32]>,
    mask: &Mask,
    settings: DerivedSettings,
) -> Result<Derived, IoError> {
    check(mask, normals.width(), normals.height())?;
    let mut depth = integrate_normals(normals, mask, settings.depth)?;
    let mut flat = None;
    if settings.flatten {
        let bow = Bow::of(&depth);
        depth = bow.removed_from_depth(&depth);
        flat = Some(bow.removed_from_normals(normals));
    }
    let surface = Surface {
        normals: flat.as_ref().unwrap_or(normals),
        albedo,
        depth: &depth,
    };
    let (low, high) = depth.range();
    let mut report = DerivedReport {
        settings,
        range: [low, high],
        parts: depth.parts(),
        missing: depth.missing(),
        steep: depth.steep(),
        torn: depth.torn(),
        height_step: None,
        map_height_step: None,
        curvature_white: None,
        mesh_step: None,
    };
    let mut files = Vec::new();
    if settings.heights {
        let (png, step) = height_png(&depth)?;
        report.height_step = Some(step);
        files.push(("height.png", png));
        files.push(("height.tiff", height_tiff(&depth)?));
        files.push(("height.exr", height_exr(&depth)?));
    }
    if let Some(format) = settings.mesh {
        files.extend(surface.mesh(format, &mut report)?);
    }
    if let Some(how) = settings.maps {
        files.extend(surface.maps(how, &mut report)?);
    }
    let json = serde_json::to_vec_pretty(&report).map_err(|error| IoError::Encode {
        name: "depth.json",
        reason: error.to_string(),
    })?;
    files.push(("depth.json", json));
    Ok(Derived {
        files,
        report,
        depth,
    })
}

struct Surface<'a> {
    normals: &'a NormalMap,
    albedo: Option<&'a [f32]>,
    depth: &'a DepthMap,
}

impl Surface<'_> {
    fn mesh(
        &self,
        format: MeshFileFormat,
        report: &mut DerivedReport,
    ) -> Result<Vec<(&'static str, Vec<u8>)>, IoError> {
        let mask = self.depth.mask();
        let step = self.depth.step_for(report.settings.triangles);
        report.mesh_step = Some(step);
        let mesh = self.depth.mesh(self.normals, step)?;
        let how = MapSettings {
            outside: Outside::Dilated,
            ..MapSettings::default()
        };
        let Some(albedo) = self.albedo else {
            return mesh_as_files(&mesh, None, format);
        };
        let texture = Texture {
            pixels: &albedo_pixels(albedo, mask, how.outside)?,
            png: &albedo_map_png(albedo, mask, how)?,
        };
        mesh_as_files(&mesh, Some(texture), format)
    }

    fn maps(
        &self,
        how: MapSettings,
        report: &mut DerivedReport,
    ) -> Result<Vec<(&'static str, Vec<u8>)>, IoError> {
        let mask = self.depth.mask();
        // Half the picture: what is further away is too far to matter.
        let radius = mask.width().max(mask.height()) as f32 / 2.0;
        let (low, _) = self.depth.range();
        // From the lowest point: outside is as low as can be.
        let heights = self.depth.heights().iter().map(|height| height - low);
        let mut maps = Maps {
            mask: mask.clone(),
            normals: self.normals.normals().to_vec(),
            heights: painted(&heights.collect::<Vec<_>>(), mask, how.outside, 0.0),
            curvature: self.depth.mean_curvature(),
            light: self.depth.ambient_occlusion(radius),
            albedo: self.albedo.map(<[f32]>::to_vec),
        };
        if report.settings.tileable {
            maps = maps.seamless()?;
        }
        maps.files(how, report)
    }
}

/// Maps of one size, before they are encoded.
struct Maps {
    mask: Mask,
    normals: Vec<Vec3>,
    heights: Vec<f32>,
    curvature: Vec<f32>,
    light: Vec<f32>,
    albedo: Option<Vec<f32>>,
}

impl Maps {
    fn seamless(self) -> Result<Self, IoError> {
        let seamless = Seamless::new(self.mask.width(), self.mask.height())?;
        let [width, height] = seamless.size();
        // Texture is where either of what is faded into each other is.
        let inside: Vec<f32> = self
            .mask
            .inside()
            .iter()
            .map(|&inside| f32::from(inside))
            .collect();
        let inside = seamless
            .of(&inside)
            .into_iter()
            .map(|share| share > 0.0)
            .collect();
        Ok(Self {
            mask: Mask::new(width, height, inside),
            normals: seamless.of(&self.normals),
            heights: seamless.of(&self.heights),
            curvature: seamless.of(&self.curvature),
            light: seamless.of(&self.light),
            albedo: self.albedo.map(|planes| {
                let planes = planes.chunks(self.mask.inside().len());
                planes.flat_map(|plane| seamless.of(plane)).collect()
            }),
        })
    }

    fn files(
        self,
        how: MapSettings,
        report: &mut DerivedReport,
    ) -> Result<Vec<(&'static str, Vec<u8>)>, IoError> {
        let mask = &self.mask;
        let normals = NormalMap::new(mask.width(), mask.height(), self.normals);
        let highest = self.heights.iter().copied().fold(0.0, f32::max);
        let step = highest.max(f32::MIN_POSITIVE) / 65_535.0;
        report.map_height_step = Some(step);
        let codes = self
            .heights
            .iter()
            .map(|height| (height / step).round() as u16);
        let curvature = painted(&self.curvature, mask, how.outside, 0.0);
        let (curvature, white) = curvature_png(&curvature, mask)?;
        report.curvature_white = Some(white);
        let light = painted(&self.light, mask, how.outside, 1.0);
        let mut files = vec![
            ("map-normals.png", normal_map_png(&normals, mask, how)?),
            ("map-normals.exr", normals_exr(&normals)?),
            (
                "map-height.png",
                crate::depth_files::grey_16("height map", mask, codes.collect())?,
            ),
            ("map-curvature.png", curvature),
            ("map-occlusion.png", occlusion_png(&light, mask)?),
        ];
        if let Some(albedo) = &self.albedo {
            files.push(("map-albedo.png", albedo_map_png(albedo, mask, how)?));
        }
        Ok(files)
    }
}
