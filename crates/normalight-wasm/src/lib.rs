//! The browser's door: types in, types out, no arithmetic.
//!
//! The TypeScript package around this module (`web/`) runs it in a worker and gives its objects
//! their types; nothing else should call it.

mod engine;
mod error;
mod file;
mod look;
mod result;
mod settings;
mod start;
mod watcher;

pub use engine::Engine;
pub use file::InputFile;
pub use look::{plan, thumbnail};
pub use start::start;
pub use watcher::Watcher;
