//! A single file to be written.
use anyhow::{Context, Result};
use normalight_io::OutputFolder;
use std::path::Path;

/// Folder and name of a file; tried out before the work that leads to it.
pub(crate) fn place(file: &Path) -> Result<(OutputFolder, &str)> {
    let name = file.file_name().and_then(|name| name.to_str());
    let name = name.with_context(|| format!("{}: no name of a file", file.display()))?;
    let folder = OutputFolder::prepare(file.parent().unwrap_or(Path::new("")))?;
    Ok((folder, name))
}
