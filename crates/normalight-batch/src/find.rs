//! Which folders and files of a tree are captures.
mod plan;

use crate::walk::walk;
use crate::{BatchError, Capture, CaptureKind, Found, PassedOver, PassedOverReason};
use normalight_core::MIN_IMAGES;
use plan::{FolderPlan, archives, is_result, planned};
use std::path::{Path, PathBuf};

/// Walks a tree and tells what in it is a capture:
///
/// - a folder whose own files are at least three photographs, as
///   [`plan_contents`](normalight_io::plan_contents) takes them;
/// - a folder of folders with one photograph in each;
/// - an archive, where no photographs lie beside it; with a mask beside it, the folder of both;
/// - a TIFF file with at least three pages.
///
/// Below captures there may be further ones. No captures are results of this program (told by their `report.json`), hidden
/// folders, and what links to folders lead to. Archives are not opened.
///
/// # Errors
/// [`BatchError::NotAFolder`], or [`BatchError::Read`] for the root. What cannot be read below it is passed over, and said.
pub fn find_captures(root: &Path) -> Result<Found, BatchError> {
    if root.is_file() {
        return Err(BatchError::NotAFolder {
            path: root.to_owned(),
        });
    }
    let (folders, passed_over) = walk(root)?;
    let mut found = Found {
        folders: folders.len(),
        passed_over,
        captures: Vec::new(),
    };
    let plans: Vec<FolderPlan> = folders.iter().map(|one| planned(root, one)).collect();
    // Folders that hold one photograph of a capture each.
    let mut parts = vec![false; folders.len()];
    for (folder, plan) in folders.iter().zip(&plans) {
        // An archive or a file of many pages is a capture of its own, whatever lies beside it.
        let is_single = |&below: &usize| {
            plans[below].photographs == 1 && archives(root, &folders[below]).is_empty()
        };
        let is_parted = plan.photographs == 0
            && folder.folders.len() >= MIN_IMAGES
            && folder.folders.iter().all(is_single);
        if is_parted && !is_result(root, folder) {
            folder.folders.iter().for_each(|&below| parts[below] = true);
            found.captures.push(Capture {
                photographs: Some(folder.folders.len()),
                ..capture(&folder.path, CaptureKind::OneInEachFolder)
            });
        }
    }
    for (position, (folder, plan)) in folders.iter().zip(plans).enumerate() {
        if parts[position] {
            continue;
        }
        let looks = plan.photographs > 0 || plan.is_capture;
        if is_result(root, folder) {
            found.passed_over.push(PassedOver {
                path: folder.path.clone(),
                reason: PassedOverReason::Result,
            });
        } else if plan.is_capture {
            found.captures.push(Capture {
                photographs: Some(plan.photographs),
                left_out: plan.left_out,
                notices: plan.notices,
                ..capture(&folder.path, CaptureKind::Folder)
            });
        } else {
            let packed = archives(root, folder);
            if let ([_], true) = (&packed[..], plan.has_mask) {
                found.captures.push(Capture {
                    left_out: plan.left_out,
                    ..capture(&folder.path, CaptureKind::Folder)
                });
            } else if packed.is_empty() && looks {
                found.passed_over.push(PassedOver {
                    path: folder.path.clone(),
                    reason: PassedOverReason::TooFew(plan.photographs),
                });
            } else {
                found.captures.extend(packed);
            }
        }
    }
    let by_name = |a: &Path, b: &Path| {
        let text = |path: &Path| path.to_string_lossy().into_owned();
        natord::compare(&text(a), &text(b)).then_with(|| a.cmp(b))
    };
    found.captures.sort_by(|a, b| by_name(&a.path, &b.path));
    found.passed_over.sort_by(|a, b| by_name(&a.path, &b.path));
    name_root(root, &mut found.captures);
    Ok(found)
}

/// A capture of which nothing else is known.
fn capture(path: &Path, kind: CaptureKind) -> Capture {
    Capture {
        path: path.to_owned(),
        result: path.to_owned(),
        kind,
        photographs: None,
        left_out: Vec::new(),
        notices: Vec::new(),
    }
}

/// Gives the result of the root itself a name that no other result has: the output holds more than one result.
fn name_root(root: &Path, captures: &mut [Capture]) {
    let Some(position) = captures
        .iter()
        .position(|one| one.path.as_os_str().is_empty())
    else {
        return;
    };
    let root = root.canonicalize().unwrap_or_else(|_| root.to_owned());
    let mut name = root.file_name().unwrap_or("root".as_ref()).to_owned();
    let is_taken = |name: &Path| captures.iter().any(|one| one.path.starts_with(name));
    while is_taken(Path::new(&name)) {
        name.push("-itself");
    }
    captures[position].result = PathBuf::from(name);
}
