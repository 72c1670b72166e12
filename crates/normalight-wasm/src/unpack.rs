//! Archives, for a page that shows what is in them.
use crate::error::Failure;
use crate::file::InputFile;
use js_sys::Uint8Array;
use normalight_io::UnpackedFiles;
use wasm_bindgen::prelude::*;

/// The files of the capture in an archive.
#[wasm_bindgen]
pub struct Unpacked(UnpackedFiles);

#[wasm_bindgen]
impl Unpacked {
    /// Opens an archive; nothing for a file that is none.
    ///
    /// # Errors
    /// An archive that is damaged, too large or refused, or holds several captures.
    pub fn open(file: InputFile) -> Result<Option<Unpacked>, Failure> {
        Ok(UnpackedFiles::open(file.into())?.map(Self))
    }

    /// Their paths in the archive.
    #[wasm_bindgen(getter)]
    pub fn names(&self) -> Vec<String> {
        self.0.names().to_vec()
    }

    /// The content of a file, by its place among the names; once.
    ///
    /// # Errors
    /// A damaged archive.
    pub fn take(&mut self, index: usize) -> Result<Uint8Array, Failure> {
        Ok(Uint8Array::from(self.0.take(index)?.bytes.as_slice()))
    }
}

/// Whether a file is an archive, by its first 512 bytes or its name.
#[wasm_bindgen(js_name = isArchive)]
pub fn is_archive(name: &str, head: &[u8]) -> bool {
    normalight_io::is_archive(name, head)
}
