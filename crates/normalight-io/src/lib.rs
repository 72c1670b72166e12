//! Bytes to words and back: image stacks, masks, light files, DiLiGenT folders, exports.
//!
//! Everything works on bytes in memory, so the browser uses the same code; only [`folder`] and
//! [`diligent`] touch files, and they do not exist there. Bytes from outside never panic and
//! never take memory beyond the limits stated here.
#![deny(missing_docs)]

mod decode;
mod error;
mod format;
mod jpeg;
mod light_map;
mod light_text;
mod lights;
mod limits;
mod maps;
mod plan;
mod report;
mod stack;

#[cfg(not(target_arch = "wasm32"))]
pub mod diligent;
#[cfg(not(target_arch = "wasm32"))]
pub mod folder;

pub use decode::{ColorMode, DecodedImage, decode_image, decode_mask};
pub use error::IoError;
pub use light_map::lights_svg;
pub use light_text::{combine_lights, parse_directions, parse_intensities};
pub use lights::{lights_csv, lights_lp, read_lights};
pub use limits::{MAX_FILE_BYTES, MAX_PIXELS, MAX_STACK_BYTES, MAX_TEXT_BYTES};
pub use maps::{NormalFormat, albedo_png, mask_png, normals_npy, normals_png};
pub use plan::{StackPlan, find_list, plan_stack};
pub use report::{Report, StageSeconds, WeightHashes};
pub use stack::{MaskChoice, NamedBytes, StackInput, StackOptions, read_stack};
