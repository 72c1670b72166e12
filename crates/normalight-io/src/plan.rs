use crate::IoError;
use crate::format::{base_name, format_of_extension, split_extension};

/// Which of some files are the images, in which order, and which is the mask.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StackPlan {
    /// Positions of the images among the names, in the order of the stack.
    pub images: Vec<usize>,
    /// Position of the mask among the names.
    pub mask: Option<usize>,
}

/// Words in the name of a picture that is a result or an aid, not a photograph of the stack.
const NOT_PHOTOGRAPHS: [&str; 4] = ["normal", "albedo", "depth", "ambient"];

/// Decides from names alone which files are the images and which is the mask.
///
/// A list (its name and its text, see [`find_list`]) decides images and order: one name on each
/// line, optionally a count before and the mask after them; folders before a name and words after it
/// are ignored.
/// Without a list, the images are all files with the extension of a known image format in natural
/// order (2 before 10), except masks (`mask` in the name) and names with `normal`, `albedo`,
/// `depth` or `ambient`; upper and lower case are the same. Folders in `names` do not count.
///
/// # Errors
/// A list that names a missing file, has a line that is no image name, or whose count is wrong.
pub fn plan_stack<S: AsRef<str>>(
    names: &[S],
    list: Option<(&str, &str)>,
) -> Result<StackPlan, IoError> {
    let mut candidates: Vec<usize> = (0..names.len())
        .filter(|&index| is_visible_image(names[index].as_ref()))
        .collect();
    candidates.sort_by(|&a, &b| natord::compare(names[a].as_ref(), names[b].as_ref()));
    let beside = best_mask(&candidates, names);
    let Some((list_name, text)) = list else {
        candidates.retain(|&index| {
            let name = names[index].as_ref();
            !is_mask(name) && !NOT_PHOTOGRAPHS.iter().any(|word| has_word(name, word))
        });
        return Ok(StackPlan {
            images: candidates,
            mask: beside,
        });
    };
    let mut images = Vec::new();
    let mut masks = Vec::new();
    let (count, entries) = parse_list(list_name, text)?;
    for entry in entries {
        let found = candidates
            .iter()
            .find(|&&index| base_name(names[index].as_ref()) == entry);
        let Some(&index) = found else {
            return Err(IoError::ListedFileMissing {
                list: list_name.to_owned(),
                entry: entry.to_owned(),
            });
        };
        let kind = if is_mask(entry) {
            &mut masks
        } else {
            &mut images
        };
        if kind.contains(&index) {
            return Err(IoError::ListFormat {
                list: list_name.to_owned(),
                found: format!("{entry} twice"),
                expected: "each file once".to_owned(),
            });
        }
        kind.push(index);
    }
    if let Some(count) = count
        && count != images.len()
    {
        return Err(IoError::ListFormat {
            list: list_name.to_owned(),
            found: format!("{} image names", images.len()),
            expected: format!("{count}, as its first line says"),
        });
    }
    Ok(StackPlan {
        images,
        mask: masks.first().copied().or(beside),
    })
}

/// The list among some files, given a way to see a file's text: `filenames.txt`, else `names.txt`,
/// else the first `.txt` file whose lines are all image names (after an optional count).
///
/// # Errors
/// Those of `read_text` for the first two.
pub fn find_list<S: AsRef<str>>(
    names: &[S],
    mut read_text: impl FnMut(usize) -> Result<String, IoError>,
) -> Result<Option<(usize, String)>, IoError> {
    for wanted in ["filenames.txt", "names.txt"] {
        let found = names
            .iter()
            .position(|name| base_name(name.as_ref()).eq_ignore_ascii_case(wanted));
        if let Some(index) = found {
            return Ok(Some((index, read_text(index)?)));
        }
    }
    let mut texts: Vec<usize> = (0..names.len())
        .filter(|&index| {
            let (stem, extension) = split_extension(names[index].as_ref());
            extension.eq_ignore_ascii_case("txt") && !stem.starts_with('.')
        })
        .collect();
    texts.sort_by(|&a, &b| natord::compare(names[a].as_ref(), names[b].as_ref()));
    for index in texts {
        // Any other text may lie here: one that cannot be read is no list.
        let Ok(text) = read_text(index) else { continue };
        if parse_list("", &text).is_ok_and(|(_, entries)| !entries.is_empty()) {
            return Ok(Some((index, text)));
        }
    }
    Ok(None)
}

/// The count and the names of a list file.
fn parse_list<'text>(
    list: &str,
    text: &'text str,
) -> Result<(Option<usize>, Vec<&'text str>), IoError> {
    let mut count = None;
    let mut entries = Vec::new();
    // Editors on Windows begin text files with a byte order mark.
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    for line in lines.filter(|line| !line.is_empty()) {
        // Names may hold spaces, so the whole line comes first; other words are lights.
        let first_word = line.split_whitespace().next().unwrap_or(line);
        let name = [line, first_word]
            .into_iter()
            .find(|name| format_of_extension(name).is_some());
        match (name, line.parse()) {
            (Some(name), _) => entries.push(base_name(name)),
            (None, Ok(number)) if entries.is_empty() && count.is_none() => count = Some(number),
            _ => {
                return Err(IoError::ListFormat {
                    list: list.to_owned(),
                    found: format!("the line {:?}", line.chars().take(80).collect::<String>()),
                    expected: "the name of an image".to_owned(),
                });
            }
        }
    }
    Ok((count, entries))
}

/// The mask among the candidates: a file called just `mask`, else the first with it in its name.
fn best_mask<S: AsRef<str>>(candidates: &[usize], names: &[S]) -> Option<usize> {
    let masks = || {
        let named = |&&index: &&usize| is_mask(names[index].as_ref());
        candidates.iter().filter(named).copied()
    };
    masks()
        .find(|&index| {
            split_extension(names[index].as_ref())
                .0
                .eq_ignore_ascii_case("mask")
        })
        .or_else(|| masks().next())
}

/// Images whose name does not begin with a dot, as the helper files of some systems do.
fn is_visible_image(name: &str) -> bool {
    format_of_extension(name).is_some() && !base_name(name).starts_with('.')
}

fn is_mask(name: &str) -> bool {
    has_word(name, "mask")
}

fn has_word(name: &str, word: &str) -> bool {
    split_extension(name).0.to_ascii_lowercase().contains(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planned<'a>(names: &[&'a str], list: Option<&str>) -> (Vec<&'a str>, Option<&'a str>) {
        let plan = plan_stack(names, list.map(|text| ("list.txt", text))).unwrap();
        let images = plan.images.iter().map(|&index| names[index]).collect();
        (images, plan.mask.map(|index| names[index]))
    }

    #[test]
    fn natural_order_without_results() {
        let names = [
            "maskPNG/a.10.tga",
            "maskPNG/a.2.TGA",
            "maskPNG/a.Mask.tga",
            "maskPNG/a.albedo.tga",
            "maskPNG/Normal_gt.png",
            "maskPNG/Normal_gt.mat",
            "maskPNG/lights.txt",
            "maskPNG/._a.2.tga",
        ];
        let (images, mask) = planned(&names, None);
        assert_eq!(images, ["maskPNG/a.2.TGA", "maskPNG/a.10.tga"]);
        assert_eq!(mask, Some("maskPNG/a.Mask.tga"));
    }

    #[test]
    fn lists_decide_order_and_mask() {
        let names = ["b.png", "a.png", "depth.png", "mask.png", "old_mask.png"];
        let text = "3\r\nsome/where/b.png\r\nsome\\a.png 0.1 0.2 0.9\ndepth.png\nold_mask.png\n";
        let (images, mask) = planned(&names, Some(text));
        assert_eq!(images, ["b.png", "a.png", "depth.png"]);
        assert_eq!(mask, Some("old_mask.png"));
        let (_, mask) = planned(&names, Some("b.png\n"));
        assert_eq!(mask, Some("mask.png"));
    }

    #[test]
    fn bad_lists_are_named() {
        let plan = |text| plan_stack(&["a.png"], Some(("names.txt", text))).unwrap_err();
        let error = plan("a.png\nb.png");
        assert!(matches!(&error, IoError::ListedFileMissing { list, entry }
            if list == "names.txt" && entry == "b.png"));
        assert!(plan("2\na.png").to_string().contains("names.txt: found 1"));
        assert!(plan("a.png\n0.1 0.2").to_string().contains("0.1 0.2"));
    }

    #[test]
    fn only_lists_of_images_are_lists() {
        let texts = [
            ("lights.txt", "2\n0 0 1\n0 1 0\n"),
            ("empty.txt", ""),
            ("buddha.txt", "1\nx/buddha.0.tga\nx/buddha.mask.tga\n"),
            ("buddha.0.tga", ""),
        ];
        let names = texts.map(|(name, _)| name);
        let read = |index: usize| Ok(texts[index].1.to_owned());
        let found = find_list(&names, read).unwrap();
        assert_eq!(found.map(|(index, _)| index), Some(2));
        assert!(find_list(&names[..2], read).unwrap().is_none());
    }
}
