//! Where results go.
use crate::BatchError;
use std::io;
use std::path::{Path, PathBuf};

/// The places of tree and output, without links. They must lie apart: results in the tree would be read as captures
/// or lie among them, and results of captures below the output could be written over captures.
///
/// # Errors
/// [`BatchError::NotApart`], or [`BatchError::Read`].
pub(crate) fn places(root: &Path, output: &Path) -> Result<(PathBuf, PathBuf), BatchError> {
    let real = |path: &Path, reason| BatchError::Read {
        path: path.to_owned(),
        reason,
    };
    let root_place = root.canonicalize().map_err(|reason| real(root, reason))?;
    let place = place_of(output).map_err(|reason| real(output, reason))?;
    let how = match (place == root_place, place.starts_with(&root_place)) {
        (true, _) => Some("the results would lie among the captures of"),
        (false, true) => Some("the results would lie inside the captures of"),
        (false, false) => root_place
            .starts_with(&place)
            .then_some("the results would lie around the captures of"),
    };
    if let Some(how) = how {
        return Err(BatchError::NotApart {
            output: output.to_owned(),
            how,
            root: root.to_owned(),
        });
    }
    Ok((root_place, place))
}

/// The place of a folder that need not be there: its nearest folder that is, without links, and the way on.
pub(crate) fn place_of(path: &Path) -> io::Result<PathBuf> {
    let path = std::path::absolute(path)?;
    for above in path.ancestors() {
        match above.canonicalize() {
            Ok(place) => {
                let rest = path.strip_prefix(above).unwrap_or(Path::new(""));
                return Ok(place.join(rest));
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
    }
    Ok(path)
}
