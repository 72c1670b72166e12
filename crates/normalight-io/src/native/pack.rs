//! Archives of results.
use super::aside::new_file;
use super::files::read_error;
use super::write::write_error;
use crate::IoError;
use std::fs::File;
use std::io;
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// Packs files of a folder, by name, into a zip archive beside them, as they are: formats of results are compressed already.
/// The archive takes its name when it is complete.
///
/// # Errors
/// [`IoError::Read`] for a file that is not there; [`IoError::Write`] for the archive.
pub fn pack_files<N: AsRef<str>>(folder: &Path, archive: &str, files: &[N]) -> Result<(), IoError> {
    let path = folder.join(archive);
    let failed = |reason: io::Error| write_error(&path, reason);
    let aside = new_file(folder).map_err(failed)?;
    let mut zip = ZipWriter::new(aside);
    for name in files {
        let file = folder.join(name.as_ref());
        let mut source = File::open(&file).map_err(|reason| read_error(&file, reason))?;
        let length = source
            .metadata()
            .map_err(|reason| read_error(&file, reason))?
            .len();
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(length >= u64::from(u32::MAX));
        zip.start_file(name.as_ref(), options)
            .map_err(io::Error::from)
            .and_then(|()| io::copy(&mut source, &mut zip).map(drop))
            .map_err(failed)?;
    }
    let aside = zip.finish().map_err(io::Error::from).map_err(failed)?;
    aside.as_file().sync_all().map_err(failed)?;
    aside.persist(&path).map_err(|error| failed(error.error))?;
    Ok(())
}
