//! The only part of this crate that touches the file system.
mod aside;
mod below;
mod diligent;
mod disk;
mod files;
#[cfg(fuzzing)]
pub mod fuzzing;
mod inside;
mod intensities;
mod lock;
mod meshes;
mod pack;
mod published;
mod read;
mod write;

pub use aside::sweep_leftovers;
pub use diligent::{DiligentObject, list_diligent_objects, read_diligent_object};
pub use files::read_named;
pub use lock::lock_file;
pub use meshes::{mesh_files, read_mesh_file};
pub use pack::pack_files;
pub use published::{
    ObjectToPublish, PublishedEntry, PublishedObject, PublishedPart, PublishedSet, PublishedSplit,
    PublishedWriter,
};
pub use read::{read_lights_path, read_paths};
pub use write::{OutputFolder, write_files};
