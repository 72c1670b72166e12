//! Bindings for the browser: types in, types out, no arithmetic.
//!
//! The TypeScript package around this module (`web/`) runs it in a worker and gives its objects
//! their types; nothing else should call it. It is built twice, once for each kind of device: with the feature `cpu`
//! also for what computes on none.

#[cfg(not(any(feature = "cpu", feature = "gpu")))]
compile_error!("without `cpu` or `gpu` there is nothing to compute on");

mod callback;
#[cfg(feature = "cpu")]
mod derived;
mod engine;
mod error;
mod file;
mod helper;
#[cfg(feature = "cpu")]
mod inspect;
mod maps;
mod mask;
mod result;
mod settings;
mod stage;
mod start;
#[cfg(feature = "cpu")]
mod unpack;

pub use callback::ProgressCallback;
#[cfg(feature = "cpu")]
pub use derived::{Derived, NormalPictures, derive, normal_pictures};
pub use engine::Engine;
pub use file::InputFile;
#[cfg(feature = "cpu")]
pub use helper::Helper;
pub use helper::{FeatureParcel, HelperPool};
#[cfg(feature = "cpu")]
pub use inspect::{Plan, Thumbnail, plan, thumbnail};
pub use maps::FloatMap;
pub use mask::{ObjectMask, object_mask};
pub use result::Estimated;
pub use settings::{MaskSetting, Settings};
pub use start::start;
#[cfg(feature = "cpu")]
pub use unpack::{Unpacked, is_archive};
