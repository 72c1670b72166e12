//! Which folder of an archive holds the photographs.
use crate::IoError;
use crate::format::format_of_extension;
use crate::plan::{is_helper, plan_stack};
use normalight_core::MIN_IMAGES;
use std::collections::{BTreeMap, BTreeSet};

/// The files of a capture.
#[derive(Debug, PartialEq)]
pub(super) struct Place {
    /// The folder of the photographs; empty when they lie in none or in several.
    pub(super) folder: String,
    /// Positions of the files that belong to the capture.
    pub(super) kept: Vec<usize>,
    /// Positions of pictures that do not.
    pub(super) elsewhere: Vec<usize>,
}

/// Decides among the paths of all files: a capture is the one folder with enough photographs, what
/// else lies in it, and what lies in the folders above it and is no photograph there (a mask, a
/// list). As for a folder on a disk, folders further down do not count. Where no folder has enough,
/// as with one shot in each, all files belong together.
///
/// # Errors
/// [`IoError::PhotographsBelow`] for several such folders side by side, under the name `whole`.
pub(super) fn capture(whole: &str, paths: &[String]) -> Result<Place, IoError> {
    let mut folders: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, path) in paths.iter().enumerate() {
        folders.entry(folder_of(path)).or_default().push(index);
    }
    let photographs: BTreeMap<&str, Vec<usize>> = folders
        .into_iter()
        .map(|(folder, files)| (folder, photographs_of(paths, &files)))
        .collect();
    let enough: Vec<&str> = photographs
        .iter()
        .filter(|(_, shots)| shots.len() >= MIN_IMAGES)
        .map(|(folder, _)| *folder)
        .collect();
    let top = enough
        .iter()
        .find(|top| enough.iter().all(|one| is_within(one, top)));
    let folder = match (top, &enough[..]) {
        (Some(folder), _) => folder,
        (None, []) => {
            return Ok(Place {
                folder: String::new(),
                kept: (0..paths.len()).collect(),
                elsewhere: Vec::new(),
            });
        }
        (None, several) => {
            let below = several.iter().map(|folder| match *folder {
                "" => format!("{} beside them", photographs[folder].len()),
                name => format!("{} in {name}", photographs[folder].len()),
            });
            return Err(IoError::PhotographsBelow {
                name: whole.to_owned(),
                below: below.collect::<Vec<_>>().join(", "),
            });
        }
    };
    // One shot of something else above the folder is none of its photographs.
    let above: BTreeSet<usize> = photographs
        .iter()
        .filter(|(other, _)| *other != folder)
        .flat_map(|(_, shots)| shots.iter().copied())
        .collect();
    let (kept, others): (Vec<usize>, Vec<usize>) = (0..paths.len()).partition(|index| {
        let path = &paths[*index];
        is_helper(path) || is_within(folder, folder_of(path)) && !above.contains(index)
    });
    let is_picture = |index: &usize| is_picture(&paths[*index]);
    Ok(Place {
        folder: (*folder).to_owned(),
        kept,
        elsewhere: others.into_iter().filter(is_picture).collect(),
    })
}

fn photographs_of(paths: &[String], files: &[usize]) -> Vec<usize> {
    let names: Vec<&str> = files.iter().map(|&index| paths[index].as_str()).collect();
    match plan_stack(&names, None) {
        Ok(plan) => plan.images.into_iter().map(|place| files[place]).collect(),
        // The same shots twice are photographs all the same: that is said when they are taken.
        Err(_) => files
            .iter()
            .copied()
            .filter(|&index| is_picture(&paths[index]))
            .collect(),
    }
}

fn is_picture(path: &str) -> bool {
    format_of_extension(path).is_some() && !is_helper(path)
}

/// The folder that a path lies in; empty at the top.
pub(super) fn folder_of(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// Whether a folder is `above` or lies in it.
pub(super) fn is_within(folder: &str, above: &str) -> bool {
    let rest = folder.strip_prefix(above);
    above.is_empty() || rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(folders: &[(&str, usize)]) -> Vec<String> {
        let shots = |&(folder, count): &(&str, usize)| {
            let folder = folder.to_owned();
            (1..=count).map(move |k| format!("{folder}IMG_{k}.png"))
        };
        folders.iter().flat_map(shots).collect()
    }

    fn found(folders: &[(&str, usize)], more: &[&str]) -> (String, Vec<String>, Vec<String>) {
        let mut all = paths(folders);
        all.extend(more.iter().map(|&path| path.to_owned()));
        let place = capture("a.zip", &all).unwrap();
        let named = |indices: &[usize]| indices.iter().map(|&i| all[i].clone()).collect();
        (place.folder, named(&place.kept), named(&place.elsewhere))
    }

    #[test]
    fn one_folder_with_what_lies_above_it() {
        let (folder, kept, elsewhere) = found(
            &[("v/photos/", 4), ("v/", 1), ("v/photos/small/", 4)],
            &[
                "mask.png",
                "v/names.txt",
                "results/mask.png",
                "v/x.lp",
                "old/a.txt",
            ],
        );
        assert_eq!(folder, "v/photos");
        let expected = [
            "v/photos/IMG_1.png",
            "v/photos/IMG_4.png",
            "mask.png",
            "v/names.txt",
        ];
        assert!(
            expected
                .iter()
                .all(|path| kept.contains(&(*path).to_owned()))
        );
        assert_eq!(kept.len(), 4 + 3);
        // The single one above, the thumbnails, and a mask elsewhere.
        assert_eq!(elsewhere.len(), 1 + 4 + 1);
    }

    #[test]
    fn one_shot_in_each_folder_belongs_together() {
        let (folder, kept, elsewhere) = found(
            &[("light1/", 1), ("light2/", 1), ("light3/", 2)],
            &["mask.png"],
        );
        assert_eq!((folder.as_str(), kept.len(), elsewhere.len()), ("", 5, 0));
    }

    #[test]
    fn several_captures_are_named() {
        let all = paths(&[("bear/", 5), ("cat/", 6), ("", 2)]);
        let error = capture("a.zip", &all).unwrap_err().to_string();
        assert!(
            error.contains("a.zip") && error.contains("5 in bear, 6 in cat"),
            "{error}"
        );
        // "bears" does not lie in "bear".
        assert!(capture("a.zip", &paths(&[("bear/", 5), ("bears/", 6)])).is_err());
        assert!(capture("a.zip", &paths(&[("bear/", 5), ("bear/s/", 6)])).is_ok());
    }

    #[test]
    fn helpers_are_no_photographs() {
        let (folder, kept, elsewhere) = found(&[("v/", 3), ("__MACOSX/v/", 3)], &["v/._IMG_1.png"]);
        assert_eq!((folder.as_str(), kept.len(), elsewhere.len()), ("v", 7, 0));
    }
}
