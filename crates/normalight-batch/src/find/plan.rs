//! What the files of one folder are.
use super::capture;
use crate::walk::Folder;
use crate::{Capture, CaptureKind};
use normalight_core::MIN_IMAGES;
use normalight_io::{
    IoError, LeftOut, MAX_TEXT_BYTES, Notice, content_decides, find_list, is_archive, is_helper,
    plan_contents, read_text,
};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use tiff::decoder::Decoder;

/// How much of a file tells what it is.
const HEAD: u64 = 512;

/// What the names of a folder's files say, and where these do not tell, their first bytes.
#[derive(Debug, Default)]
pub(super) struct FolderPlan {
    /// Number of photographs.
    pub(super) photographs: usize,
    /// Whether they are enough, or so many that what is wrong with them is to be said.
    pub(super) is_capture: bool,
    /// Whether a mask or a picture without lamp lies here.
    pub(super) has_mask: bool,
    pub(super) left_out: Vec<LeftOut>,
    pub(super) notices: Vec<Notice>,
}

/// Plans a folder as its estimate will.
pub(super) fn planned(root: &Path, folder: &Folder) -> FolderPlan {
    let names = names(folder);
    let path = |index: usize| root.join(&folder.path).join(&folder.files[index]);
    let list = find_list(&names, |index| text(&path(index), &names[index]));
    let list = list.unwrap_or_default();
    let listed = list
        .as_ref()
        .map(|(index, text)| (names[*index].as_str(), text.as_str()));
    let heads: Vec<(usize, Vec<u8>)> = (0..names.len())
        .filter(|&index| content_decides(&names[index]))
        .map(|index| (index, head(&path(index))))
        .collect();
    match plan_contents(&names, &heads, listed) {
        Ok(plan) => FolderPlan {
            photographs: plan.images.len(),
            is_capture: plan.images.len() >= MIN_IMAGES,
            has_mask: plan.mask.is_some() || plan.ambient.is_some(),
            left_out: plan.left_out,
            notices: plan.notices,
        },
        Err(error) => with_error(&names, &heads, &error),
    }
}

/// A folder in which something is wrong: with enough photographs it is a capture, whose estimate says what. A list of other
/// things beside no photographs is nobody's concern.
fn with_error(names: &[String], heads: &[(usize, Vec<u8>)], error: &IoError) -> FolderPlan {
    let photographs = match (plan_contents(names, heads, None), error) {
        (Ok(plan), _) => plan.images.len(),
        (Err(IoError::Copies { shots, .. }), _) => 2 * shots,
        (Err(_), _) => 0,
    };
    FolderPlan {
        photographs,
        is_capture: photographs >= MIN_IMAGES,
        ..FolderPlan::default()
    }
}

/// Whether a folder holds a result of this program.
pub(super) fn is_result(root: &Path, folder: &Folder) -> bool {
    const REPORT: &str = "report.json";
    if !folder.files.iter().any(|name| name == REPORT) {
        return false;
    }
    // Of any version: what all of them hold, and nobody else together.
    let place = root.join(&folder.path).join(REPORT);
    let report: Option<serde_json::Value> = bytes(&place, MAX_TEXT_BYTES)
        .ok()
        .and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let has = |key| {
        report
            .as_ref()
            .is_some_and(|report| report.get(key).is_some())
    };
    ["version", "inputs", "weights", "settings"]
        .into_iter()
        .all(has)
}

/// The archives in a folder, and the TIFF files with enough pages.
pub(super) fn archives(root: &Path, folder: &Folder) -> Vec<Capture> {
    let (place, names) = (root.join(&folder.path), names(folder));
    let files = folder.files.iter().zip(&names);
    let found = files.filter_map(|(file, name)| {
        if is_helper(name) {
            return None;
        }
        let (path, file) = (place.join(file), folder.path.join(file));
        let head = head(&path);
        if !is_archive(name, &head) {
            return None;
        }
        if !is_tiff(&head) {
            return Some(capture(&file, CaptureKind::Archive));
        }
        let pages = pages(&path);
        (pages >= MIN_IMAGES).then(|| Capture {
            photographs: Some(pages),
            ..capture(&file, CaptureKind::Pages)
        })
    });
    found.collect()
}

fn is_tiff(head: &[u8]) -> bool {
    head.starts_with(b"II") || head.starts_with(b"MM")
}

/// Number of pages of a TIFF file that are of the size of the first; whether they are the photographs, its estimate decides.
fn pages(path: &Path) -> usize {
    /// Most that are counted: more than there are photographs in any capture.
    const MOST: usize = 10_000;
    let Ok(file) = File::open(path) else { return 0 };
    let Ok(mut decoder) = Decoder::new(BufReader::new(file)) else {
        return 0;
    };
    let Ok(first) = decoder.dimensions() else {
        return 0;
    };
    let mut pages = 1;
    // A circle of pages ends at the latest with the limit.
    for _ in 0..MOST {
        if !decoder.more_images() || decoder.next_image().is_err() {
            break;
        }
        pages += usize::from(decoder.dimensions().is_ok_and(|size| size == first));
    }
    pages
}

fn names(folder: &Folder) -> Vec<String> {
    let names = folder.files.iter();
    names
        .map(|name| name.to_string_lossy().into_owned())
        .collect()
}

/// The first bytes of a file; none of one that cannot be read.
fn head(path: &Path) -> Vec<u8> {
    let mut head = Vec::new();
    if let Ok(file) = File::open(path) {
        // What was read before an error counts, too.
        let _ = file.take(HEAD).read_to_end(&mut head);
    }
    head
}

fn text(path: &Path, name: &str) -> Result<String, IoError> {
    let bytes = bytes(path, MAX_TEXT_BYTES).map_err(|reason| IoError::Read {
        name: name.to_owned(),
        reason,
    })?;
    read_text(name, &bytes)
}

/// At most so many bytes of a file.
fn bytes(path: &Path, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}
