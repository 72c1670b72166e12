//! A result takes its place.
use crate::record::{RECORD, REPORT, Record};
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Moves a complete result, its record among its files, to its final place on the same file system.
///
/// A place that is not there yet gets all at once. Otherwise (the result is made anew, or results lie below it) first the
/// record goes, then each file is replaced, the report and the new record last: whenever this ends, files are whole, and
/// what is not complete has no record.
///
/// # Errors
/// With the path that stands in the way.
pub(crate) fn install(made: &Path, place: &Path) -> Result<(), (PathBuf, io::Error)> {
    if let Some(above) = place.parent() {
        fs::create_dir_all(above).map_err(|reason| (above.to_owned(), reason))?;
    }
    if !place.exists() && fs::rename(made, place).is_ok() {
        return Ok(());
    }
    fs::create_dir_all(place).map_err(|reason| (place.to_owned(), reason))?;
    let before = Record::of(place).map_or_else(Vec::new, |record| record.files);
    for name in [RECORD, REPORT] {
        remove(&place.join(name))?;
    }
    let mut names = Vec::new();
    let failed = |reason| (made.to_owned(), reason);
    for entry in fs::read_dir(made).map_err(failed)? {
        names.push(entry.map_err(failed)?.file_name());
    }
    names.sort_by_key(|name| (rank(name), name.clone()));
    for (old, _) in before {
        // Names in a record lead nowhere else.
        let is_plain = Path::new(&old).file_name() == Some(OsStr::new(&old));
        if is_plain && !names.iter().any(|name| *name == *old) {
            remove(&place.join(old))?;
        }
    }
    for name in names {
        let to = place.join(&name);
        fs::rename(made.join(&name), &to).map_err(|reason| (to, reason))?;
    }
    Ok(())
}

fn rank(name: &OsStr) -> u8 {
    match name.to_str() {
        Some(REPORT) => 1,
        Some(RECORD) => 2,
        _ => 0,
    }
}

/// Takes a file away, which may not be there.
fn remove(path: &Path) -> Result<(), (PathBuf, io::Error)> {
    match fs::remove_file(path) {
        Err(reason) if reason.kind() != io::ErrorKind::NotFound => Err((path.to_owned(), reason)),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(path: &Path, files: &[(&str, &str)]) {
        fs::create_dir_all(path).unwrap();
        for (name, text) in files {
            fs::write(path.join(name), text).unwrap();
        }
    }

    fn names(path: &Path) -> Vec<String> {
        let entries = fs::read_dir(path).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn results_below_and_files_of_others_stay() {
        let top = tempfile::tempdir().unwrap();
        let (made, place) = (top.path().join("made"), top.path().join("out/vase"));
        folder(&place.join("detail"), &[("normals.png", "below")]);
        folder(&place, &[("notes.txt", "by hand")]);
        let first = r#"{"format": 1, "capture": "vase", "program": "1", "arguments": [], "settings": "", "read": 0,
            "inputs": [], "contents": "", "seconds": 0, "files": [["report.json", 1], ["mesh.glb", 1], ["../x", 1]]}"#;
        folder(
            &made,
            &[("report.json", "1"), ("mesh.glb", "1"), (RECORD, first)],
        );
        fs::write(top.path().join("out/x"), "no file of ours").unwrap();
        install(&made, &place).unwrap();
        folder(&made, &[("report.json", "2"), (RECORD, "{}")]);
        install(&made, &place).unwrap();
        assert_eq!(
            names(&place),
            [RECORD, "detail", "notes.txt", "report.json"]
        );
        assert_eq!(fs::read_to_string(place.join("report.json")).unwrap(), "2");
        assert_eq!(names(&place.join("detail")), ["normals.png"]);
        assert!(top.path().join("out/x").exists());
    }

    #[test]
    fn a_folder_in_the_way_is_named_and_leaves_no_record() {
        let top = tempfile::tempdir().unwrap();
        let (made, place) = (top.path().join("made"), top.path().join("vase"));
        folder(&place.join("normals.png"), &[("of a capture", "")]);
        folder(&made, &[("normals.png", "1"), (RECORD, "{}")]);
        let (path, _) = install(&made, &place).unwrap_err();
        assert_eq!(path, place.join("normals.png"));
        assert_eq!(names(&place), ["normals.png"]);
    }
}
