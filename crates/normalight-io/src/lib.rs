//! Bytes to words and back: image stacks, masks, light files, DiLiGenT folders, published
//! training sets, meshes, exports.
//!
//! Everything works on bytes in memory, so the browser uses the same code; the functions that take
//! paths do not exist there. Bytes from outside never panic and never take memory beyond the limits
//! stated here.
//!
//! Which of some files are the photographs is decided by their names (a list and a mask count, too):
//!
//! ```
//! use normalight_io::plan_stack;
//!
//! let plan = plan_stack(&["cup10.png", "cup2.png", "cup1.png", "mask.png"], None)?;
//! assert_eq!(plan.images, [2, 1, 0]);
//! assert_eq!(plan.mask, Some(3));
//! # Ok::<(), normalight_io::IoError>(())
//! ```
//!
//! Lights come from `.lp` files, tables or lines of `x y z`:
//!
//! ```
//! use normalight_io::read_lights;
//!
//! let names = ["a.png", "b.png", "c.png"].map(str::to_owned);
//! let text = "3\na.png 0 0 1\nb.png 0 0.6 0.8\nc.png 0.6 0 0.8\n";
//! let lights = read_lights("lights.lp", text.as_bytes(), &names)?;
//! assert_eq!(lights[1].direction.to_array(), [0.0, 0.6, 0.8]);
//! # Ok::<(), normalight_io::IoError>(())
//! ```
#![deny(missing_docs)]

mod archive;
mod assemble;
mod color;
mod decode;
mod depth_files;
mod derived_files;
mod error;
mod format;
mod input;
mod input_plan;
mod light_array;
mod light_axes;
mod light_exports;
mod light_file;
mod light_map;
mod light_match;
mod light_table;
mod light_text;
mod limits;
mod maps;
mod mask_file;
mod matlab;
mod mesh;
mod mesh_files;
mod names;
mod normal_file;
mod notice;
mod packed;
mod page;
mod photographs;
mod plan;
mod previews;
mod report;
mod result_files;
mod shots;
mod source;
mod stack;
mod text;
mod texture_maps;
mod truth;
mod turn;

#[cfg(not(target_arch = "wasm32"))]
mod native;

#[cfg(fuzzing)]
pub use native::fuzzing;

pub use color::ColorMode;
pub use decode::{DecodedImage, decode_image};
pub use depth_files::{
    curvature_png, height_exr, height_png, height_tiff, normals_exr, occlusion_png,
};
pub use derived_files::{Derived, DerivedReport, DerivedSettings, derived_files};
pub use error::IoError;
pub use input::{AmbientChoice, MaskChoice, NamedBytes, ReadOptions, StackInput};
pub use input_plan::{
    ColorDecision, ColorReason, InputPlan, LeftOut, LeftOutReason, LightsDecision, Order,
    left_out_lines, notice_lines,
};
pub use light_axes::{LightAxes, LightAxesError};
pub use light_exports::{lights_csv, lights_lp};
pub use light_file::GivenLights;
pub use light_map::{lights_compared_svg, lights_svg};
pub use light_match::read_lights;
pub use limits::{
    Limits, MAX_ARCHIVE_BYTES, MAX_ARCHIVE_FILES, MAX_ARCHIVE_RATIO, MAX_FILE_BYTES, MAX_FILES,
    MAX_MESH_BYTES, MAX_PIXELS, MAX_STACK_BYTES, MAX_TEXT_BYTES,
};
pub use maps::{
    NormalFormat, albedo_png, mask_png, normal_errors_png, normals_npy, normals_png, npy,
};
pub use mask_file::decode_mask;
pub use matlab::normals_mat;
pub use mesh::read_mesh;
pub use mesh_files::{MeshFileFormat, Texture, mesh_as_files};
pub use names::NameMatch;
#[cfg(not(target_arch = "wasm32"))]
pub use native::{
    DiligentObject, ObjectToPublish, OutputFolder, PublishedEntry, PublishedObject, PublishedPart,
    PublishedSet, PublishedSplit, PublishedWriter, list_diligent_objects, lock_file, mesh_files,
    pack_files, read_diligent_object, read_lights_path, read_mesh_file, read_named, read_paths,
    sweep_leftovers, write_files,
};
pub use normal_file::read_normals;
pub use notice::Notice;
pub use packed::{UnpackedFiles, is_archive};
pub use page::{PAGE_SCRIPT, PAGE_STYLE};
pub use photographs::{Thumbnail, photograph_png, thumbnail};
pub use plan::{StackPlan, content_decides, find_list, is_helper, plan_contents, plan_stack};
pub use previews::{albedo_rgba, normals_rgba};
pub use report::{ExpectedErrors, Report, ReportSettings, StageSeconds, WeightHashes, report_json};
pub use result_files::{OutputName, RunDescription, result_files};
pub use stack::read_stack;
pub use text::read_text;
pub use texture_maps::{MapSettings, Outside, albedo_map_png, normal_map_png};
pub use truth::{Truth, TruthErrors};
