//! `estimate`, and the settings of an estimate that `evaluate` shares.

use crate::args::SurfaceArgs;
use crate::choices::{ColorChoice, DecodingChoice, DeviceChoice, FormatChoice, QualityChoice};
use clap::Args;
use normalight_io::LightAxes;
use std::path::PathBuf;

/// Estimates lights and normals of one object.
#[derive(Debug, Args)]
#[command(after_help = ESTIMATE_EXAMPLES)]
pub(crate) struct EstimateArgs {
    /// A folder of photographs, the photographs themselves, or an archive of them.
    ///
    /// PNG, JPEG, TIFF, TGA, BMP, WebP or EXR, all of one size. In a folder, a list file
    /// (filenames.txt or names.txt) decides which files are the photographs and in which order;
    /// without one it is all images but those named mask, normal, albedo, depth or ambient. Zip, tar
    /// and tar.gz archives are read without unpacking them to the disk; capture.zip/photos is a
    /// folder in one.
    #[arg(required = true, value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    /// Folder for the results; made when missing.
    #[arg(long, value_name = "DIR", required_unless_present = "dry_run")]
    pub(crate) out: Option<PathBuf>,
    /// Read the photographs, say what is taken for what and why, and stop.
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) dry_run: bool,
    /// Image of the object's pixels (bright inside, dark outside), or `none` for the whole frame.
    ///
    /// Default: the image named mask beside the photographs, else the transparency of the first
    /// one, else the object as the photographs tell it from its background.
    #[arg(long, value_name = "FILE|none")]
    pub(crate) mask: Option<PathBuf>,
    /// Known lights: lines of `x y z` as in DiLiGenT's light_directions.txt, an .lp file, or our
    /// lights.csv.
    ///
    /// Without it the lights are estimated; light files lying beside the photographs are not used.
    #[arg(long, value_name = "FILE")]
    pub(crate) lights: Option<PathBuf>,
    /// Which way the axes of the light file point, as in x-right,y-down,z-in.
    ///
    /// Each of x, y and z: right, left, up, down, out (to the camera) or in. Default: x-right,y-up,z-out.
    #[arg(long, value_name = "AXES", requires = "lights", default_value_t)]
    pub(crate) light_axes: LightAxes,
    /// Use only this many photographs, spread over the series.
    #[arg(long, value_name = "N")]
    pub(crate) images: Option<usize>,
    /// Lay photographs that a moved camera took over the others (shifts only), instead of refusing them.
    ///
    /// What such a photograph does not show leaves the mask.
    #[arg(long)]
    pub(crate) align: bool,
    /// Subtract the light of a picture without lamp from all photographs: this one, or `auto` for the
    /// one that is recognised by its name (ambient, noflash, off, dark) or by what it shows.
    ///
    /// Without it such a picture is left out.
    #[arg(long, value_name = "FILE|auto")]
    pub(crate) ambient: Option<PathBuf>,
    /// Which way green points in normals.png; normals.npy always has y up.
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "opengl")]
    pub(crate) normal_format: FormatChoice,
    /// How the numbers in the photographs relate to light.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) color: ColorChoice,
    #[command(flatten)]
    pub(crate) surface: SurfaceArgs,
    #[command(flatten)]
    pub(crate) estimation: EstimationArgs,
    /// Name every file in what is said about the input.
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) verbose: bool,
    /// Say nothing about the input, show no progress and no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const ESTIMATE_EXAMPLES: &str = "\
Results: normals.png (16 bit), normals.npy, lights.csv, lights.lp, lights.svg, albedo.png, mask.png, report.json;
with --depth, --mesh and --maps those of `normalight mesh`, and depth.json.

Examples:
  normalight estimate vase --out vase-normals
  normalight estimate vase/*.jpg --mask vase-mask.png --out vase-normals --normal-format directx";

/// How to get from photographs to normals; the same for `estimate` and `evaluate`.
#[derive(Debug, Args)]
pub(crate) struct EstimationArgs {
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceChoice,
    /// What good lights and normals may cost: they are averaged over mirrored and turned views of the
    /// photographs.
    #[arg(long, value_enum, default_value = "default")]
    pub(crate) quality: QualityChoice,
    /// How the light network's classes become numbers.
    #[arg(long, value_enum, default_value = "soft-argmax")]
    pub(crate) decoding: DecodingChoice,
    /// Keep the light network's answer as it is instead of refitting the lights to the normals.
    #[arg(long)]
    pub(crate) no_refit: bool,
    /// Another light network than the one inside this program.
    #[arg(long, value_name = "FILE")]
    pub(crate) light_weights: Option<PathBuf>,
    /// Another normal network than the one inside this program.
    #[arg(long, value_name = "FILE")]
    pub(crate) normal_weights: Option<PathBuf>,
}
