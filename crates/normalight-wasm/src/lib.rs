//! Bindings for the browser: types in, types out, no arithmetic.
//!
//! The TypeScript package around this module (`web/`) runs it in a worker and gives its objects
//! their types; nothing else should call it.

mod callback;
mod derived;
mod engine;
mod error;
mod file;
mod inspect;
mod maps;
mod mask;
mod result;
mod settings;
mod stage;
mod start;
mod unpack;

pub use callback::ProgressCallback;
pub use derived::{Derived, NormalPictures, derive, normal_pictures};
pub use engine::Engine;
pub use file::InputFile;
pub use inspect::{Plan, Thumbnail, plan, thumbnail};
pub use maps::FloatMap;
pub use mask::{ObjectMask, object_mask};
pub use result::Estimated;
pub use settings::{MaskSetting, Settings};
pub use start::start;
pub use unpack::{Unpacked, is_archive};
