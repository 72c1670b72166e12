//! `render`, and the materials and shapes that others draw with, too.

use crate::choices::BitsChoice;
use clap::Args;
use std::path::PathBuf;

/// Draws synthetic stacks with known lights and normals.
///
/// A recipe describes the distribution of shapes, materials, lights and cameras. Stack number k of a
/// recipe is the same on every machine.
#[derive(Debug, Args)]
#[command(after_help = RENDER_EXAMPLES)]
pub(crate) struct RenderArgs {
    /// `world`, `classic`, or a TOML file.
    ///
    /// world: as people photograph things. classic: what the published training sets contain. A file
    /// names a preset and what differs from it.
    #[arg(long, value_name = "NAME|FILE", default_value = "world")]
    pub(crate) recipe: String,
    #[command(flatten)]
    pub(crate) library: LibraryArgs,
    /// Number of stacks.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) count: u32,
    /// Number of the first one.
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub(crate) first: u64,
    /// Images of a stack.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(3..=1024))]
    pub(crate) images: u32,
    /// Side of the images in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 128, value_parser = clap::value_parser!(u32).range(16..=2048))]
    pub(crate) size: u32,
    /// Bits of a stored value.
    #[arg(long, value_enum, default_value = "8")]
    pub(crate) bits: BitsChoice,
    /// Folder for the stacks, in the layout of the published Blobby and Sculpture sets; made when
    /// missing. Every hundredth stack is for validation.
    #[arg(long, value_name = "DIR", required_unless_present = "stats")]
    pub(crate) out: Option<PathBuf>,
    /// Write a contact sheet of normals and photographs as well: sheet.png.
    #[arg(long, requires = "out")]
    pub(crate) sheet: bool,
    /// Print what the stacks look like in numbers.
    #[arg(long)]
    pub(crate) stats: bool,
    /// Print the same for real objects: a folder in DiLiGenT's layout.
    #[arg(long, value_name = "DIR", requires = "stats")]
    pub(crate) compare: Option<PathBuf>,
    /// Show no progress and no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const RENDER_EXAMPLES: &str = "\
Examples:
  normalight render --count 1000 --out stacks
  normalight render --recipe classic --merl merl_nbrdf.npz --count 24 --out look --sheet
  normalight render --stats --count 200 --compare DiLiGenT/pmsData";

/// Materials and shapes from files of the user's.
#[derive(Debug, Args)]
pub(crate) struct LibraryArgs {
    /// Measured materials: an .npz file of fitted networks, `W` of [materials, 675].
    ///
    /// Seven in ten materials then come from it, if the recipe says nothing else.
    #[arg(long, value_name = "FILE")]
    pub(crate) merl: Option<PathBuf>,
    /// A folder or a list of OBJ, PLY and GLB meshes, which become a third of the objects if the recipe says
    /// nothing else.
    ///
    /// Folders are searched with those in them; a list is a text file with one path a line. Given several
    /// times, all are drawn from equally often.
    #[arg(long, value_name = "DIR")]
    pub(crate) meshes: Vec<PathBuf>,
}
