use crate::choices::{BitsChoice, FormatChoice, MeshChoice, OutsideChoice};
use clap::Args;
use normalight_core::{DepthSettings, Projection};
use normalight_io::{DerivedSettings, MapSettings, NormalFormat};
use std::path::PathBuf;

/// What is made of normals; the same for `estimate` and `mesh`.
#[derive(Debug, Args)]
pub(crate) struct SurfaceArgs {
    /// Heights, too: height.png (16 bits), height.tiff and height.exr (pixels).
    #[arg(long)]
    pub(crate) depth: bool,
    /// A mesh, too.
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) mesh: Option<MeshChoice>,
    /// Maps for painting and engines, too: normals, albedo, height, curvature and ambient occlusion.
    #[arg(long)]
    pub(crate) maps: bool,
    /// About how many triangles a mesh may have at most: fewer pixels become vertices then.
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(2..))]
    pub(crate) triangles: u32,
    /// Focal length in pixels, for depth as a near camera saw it; without it the camera is far away.
    #[arg(long, value_name = "PIXELS")]
    pub(crate) focal: Option<f32>,
    /// Take the bow off nearly flat objects.
    #[arg(long)]
    pub(crate) flatten: bool,
    /// Fade opposite edges of the maps into each other, so that they repeat without seams.
    #[arg(long, requires = "maps")]
    pub(crate) tileable: bool,
    /// What the maps show outside the object.
    #[arg(long, value_enum, default_value = "flat", requires = "maps")]
    pub(crate) outside: OutsideChoice,
    /// Give the maps of normals and albedo the mask as transparency.
    #[arg(long, requires = "maps")]
    pub(crate) alpha: bool,
    /// Bits of map-normals.png.
    #[arg(long, value_enum, default_value = "16", requires = "maps")]
    pub(crate) map_bits: BitsChoice,
}

impl SurfaceArgs {
    pub(crate) fn settings(&self, normal_format: NormalFormat) -> DerivedSettings {
        DerivedSettings {
            depth: DepthSettings {
                projection: match self.focal {
                    Some(focal) => Projection::Perspective { focal },
                    None => Projection::Orthographic,
                },
                ..DepthSettings::default()
            },
            flatten: self.flatten,
            heights: self.depth,
            mesh: self.mesh.map(Into::into),
            triangles: self.triangles as usize,
            maps: self.maps.then(|| MapSettings {
                normal_format,
                outside: self.outside.into(),
                alpha: self.alpha,
                eight_bits: matches!(self.map_bits, BitsChoice::Eight),
            }),
            tileable: self.tileable,
        }
    }
}

/// Depth, a mesh and maps of normals that were made anywhere.
#[derive(Debug, Args)]
#[command(after_help = MESH_EXAMPLES)]
pub(crate) struct MeshArgs {
    /// The normals: an RGB image of 8 or 16 bits, EXR or TIFF of numbers, or a NumPy array [height, width, 3].
    #[arg(value_name = "NORMALS")]
    pub(crate) normals: PathBuf,
    /// Folder for the results; made when missing.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Image of the object's pixels (bright inside, dark outside); default: where there are normals.
    #[arg(long, value_name = "FILE")]
    pub(crate) mask: Option<PathBuf>,
    /// Which way green points in the normals, and in maps of them.
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "opengl")]
    pub(crate) normal_format: FormatChoice,
    #[command(flatten)]
    pub(crate) surface: SurfaceArgs,
    /// Show no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const MESH_EXAMPLES: &str = "\
Without --depth, --mesh or --maps a mesh in GLB is made.

Examples:
  normalight mesh normals.png --mask mask.png --out vase-mesh
  normalight mesh normals.exr --mesh obj --depth --focal 4200 --out vase-mesh";
