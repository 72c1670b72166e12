//! Which of some files are the photographs.
mod benchmark;
mod kinds;
mod list;

pub use kinds::is_helper;
pub use list::find_list;

use crate::format::{base_name, is_image_content, may_hold_image, split_extension};
use crate::input_plan::{LeftOut, LeftOutReason, Order};
use crate::names::{NameKey, NameMatch, find, folded, stem};
use crate::truth::truth_among;
use crate::{IoError, Notice};
use kinds::{Words, left_out_reason};
use std::collections::BTreeMap;

/// Pictures whose names make a series.
const SERIES: usize = 4;

/// Which of some files are the images, in which order, and which is the mask.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StackPlan {
    /// Positions of the images among the names, in the order of the stack.
    pub images: Vec<usize>,
    /// Position of the mask among the names.
    pub mask: Option<usize>,
    /// Position of the picture without lamp among the names.
    pub ambient: Option<usize>,
    /// Position of the true normals among the names.
    pub truth: Option<usize>,
    /// What decided about images and order.
    pub order: Order,
    /// The other files that a person might miss, and why they are not among the images.
    pub left_out: Vec<LeftOut>,
    /// Whether the files lie as those of a benchmark, whose samples are linear.
    pub benchmark: bool,
    /// What is doubtful.
    pub notices: Vec<Notice>,
}

/// Decides from names alone which files are the images and which is the mask.
///
/// A list (its name and its text, see [`find_list`]) decides images and order: one name on each
/// line, optionally a count before and the mask after them; folders before a name and words after it
/// are ignored, and so are case, Unicode form and, where that is clear, the extension.
/// Without a list, the images are all files with the extension of a known image format in natural
/// order (2 before 10), except masks (`mask` in the name) and names that say they are maps or
/// aids (`normal`, `albedo`, `depth`, `roughness`, `ambient`, ...). A word that most names share
/// says nothing. Folders in `names` do not count.
///
/// # Errors
/// A list that names a missing file, has a line that is no image name, or whose count is wrong; the
/// same shots in two formats.
pub fn plan_stack<S: AsRef<str>>(
    names: &[S],
    list: Option<(&str, &str)>,
) -> Result<StackPlan, IoError> {
    plan_contents(names, &[], list)
}

/// Whether a file's content has to tell whether it is an image: its name does not.
pub fn content_decides(name: &str) -> bool {
    !kinds::is_helper(name) && may_hold_image(name)
}

/// As [`plan_stack`], with what the first bytes of files say: their positions and bytes, of those for which
/// [`content_decides`].
///
/// # Errors
/// Those of [`plan_stack`].
pub fn plan_contents<S: AsRef<str>>(
    names: &[S],
    heads: &[(usize, Vec<u8>)],
    list: Option<(&str, &str)>,
) -> Result<StackPlan, IoError> {
    let name = |index: usize| names[index].as_ref();
    let mut images: Vec<bool> = (0..names.len())
        .map(|index| kinds::is_visible_image(name(index)))
        .collect();
    for (index, head) in heads {
        let name = name(*index);
        images[*index] |= content_decides(name) && is_image_content(name, head);
    }
    let is_image = |index: usize| images[index];
    let mut candidates: Vec<usize> = (0..names.len()).filter(|&index| is_image(index)).collect();
    candidates.sort_by(|&a, &b| natord::compare(name(a), name(b)));
    let words = Words::of(candidates.iter().map(|&index| name(index)));
    let beside = best_mask(&candidates, names, &words);
    let mut plan = match list {
        Some((list, text)) => listed(&candidates, names, &words, (list, text))?,
        None => {
            let (aids, images) = candidates
                .iter()
                .partition(|&&index| words.reason(name(index)).is_some());
            let aids: Vec<usize> = aids;
            let mut left_out: Vec<LeftOut> = aids
                .iter()
                .filter_map(|&index| {
                    let reason = words.reason(name(index))?;
                    Some(LeftOut::new(name(index), reason))
                })
                .collect();
            let mut images: Vec<usize> = images;
            let odd = odd_names(&images, names);
            left_out.extend(
                odd.iter()
                    .map(|&index| LeftOut::new(name(index), LeftOutReason::UnlikeNames)),
            );
            images.retain(|index| !odd.contains(index));
            StackPlan {
                left_out,
                images,
                ..StackPlan::default()
            }
        }
    };
    if list.is_none() {
        check_copies(&plan.images, names)?;
    }
    plan.mask = plan.mask.or(beside);
    if let Some(mask) = plan.mask {
        plan.left_out.retain(|left| left.file != name(mask));
    }
    plan.ambient = candidates.iter().copied().find(|&index| {
        !plan.images.contains(&index) && words.reason(name(index)) == Some(LeftOutReason::Ambient)
    });
    for (index, name) in names.iter().map(AsRef::as_ref).enumerate() {
        if let Some(reason) = left_out_reason(name)
            && !is_image(index)
        {
            plan.left_out.push(LeftOut::new(name, reason));
        }
        let is_text = split_extension(name).1.eq_ignore_ascii_case("txt");
        if is_text && kinds::says_rejects(name) && list.is_none_or(|(list, _)| list != name) {
            plan.notices.push(Notice::ListIgnored {
                list: name.to_owned(),
            });
        }
    }
    // A list may have taken it for a photograph.
    plan.truth = truth_among(names).filter(|index| !plan.images.contains(index));
    if let Some(truth) = plan.truth {
        plan.left_out.retain(|left| left.file != name(truth));
    }
    plan.benchmark = benchmark::is_benchmark(names, list.map(|(_, text)| text));
    Ok(plan)
}

/// The images that a list names, in its order.
fn listed<S: AsRef<str>>(
    candidates: &[usize],
    names: &[S],
    words: &Words,
    (list, text): (&str, &str),
) -> Result<StackPlan, IoError> {
    let keys: Vec<NameKey> = candidates
        .iter()
        .map(|&index| NameKey::new(names[index].as_ref()))
        .collect();
    let (count, entries) = list::parse(list, text)?;
    let (mut images, mut masks, mut by_stem) = (Vec::new(), Vec::new(), false);
    for entry in entries {
        let (rule, found) = find(&NameKey::new(entry), &keys).unwrap_or((NameMatch::Full, vec![]));
        let [key] = found[..] else {
            return Err(match found.len() {
                0 => IoError::ListedFileMissing {
                    list: list.to_owned(),
                    entry: base_name(entry).to_owned(),
                },
                several => IoError::ListFormat {
                    list: list.to_owned(),
                    found: format!("{entry}, which may be any of {several} files"),
                    expected: "names with their folders".to_owned(),
                },
            });
        };
        by_stem |= rule == NameMatch::Stem;
        let is_mask = words.reason(entry) == Some(LeftOutReason::Mask);
        let kind = if is_mask { &mut masks } else { &mut images };
        if kind.contains(&candidates[key]) {
            return Err(IoError::ListFormat {
                list: list.to_owned(),
                found: format!("{} twice", base_name(entry)),
                expected: "each file once".to_owned(),
            });
        }
        kind.push(candidates[key]);
    }
    if let Some(count) = count
        && count != images.len()
    {
        return Err(IoError::ListFormat {
            list: list.to_owned(),
            found: format!("{} image names", images.len()),
            expected: format!("{count}, as its first line says"),
        });
    }
    let unlisted = candidates.iter().filter(|index| !images.contains(index));
    let left_out = unlisted.map(|&index| {
        let name = names[index].as_ref();
        LeftOut::new(name, words.reason(name).unwrap_or(LeftOutReason::NotListed))
    });
    let notice = by_stem.then(|| Notice::ListByStem {
        list: list.to_owned(),
    });
    Ok(StackPlan {
        left_out: left_out.collect(),
        images,
        mask: masks.first().copied(),
        ambient: None,
        truth: None,
        order: Order::List(list.to_owned()),
        notices: notice.into_iter().collect(),
        benchmark: false,
    })
}

/// The same shots in two formats, depths or sizes: nobody can tell which are meant.
fn check_copies<S: AsRef<str>>(images: &[usize], names: &[S]) -> Result<(), IoError> {
    let mut shots: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for &index in images {
        let name = names[index].as_ref();
        let stem = folded(stem(name));
        let shot = kinds::without_variant(&stem).to_owned();
        shots.entry(shot).or_default().push(name);
    }
    let twice: Vec<&Vec<&str>> = shots.values().filter(|shot| shot.len() > 1).collect();
    // One picture in each of many folders may well be called the same.
    if shots.len() < 3 || 2 * twice.len() < shots.len() {
        return Ok(());
    }
    Err(IoError::Copies {
        first: twice[0][0].to_owned(),
        second: twice[0][1].to_owned(),
        shots: twice.len(),
    })
}

/// Pictures whose names are unlike those of a series: of each such name there is one only, and of the series most of all.
/// What is left out of few pictures would be missed; there they are only said.
fn odd_names<S: AsRef<str>>(images: &[usize], names: &[S]) -> Vec<usize> {
    let pattern = |index: usize| -> String {
        let stem = folded(stem(names[index].as_ref()));
        stem.chars().filter(|c| c.is_alphabetic()).collect()
    };
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for &index in images {
        *counts.entry(pattern(index)).or_default() += 1;
    }
    let usual = counts.values().max().copied().unwrap_or(0);
    // Lamps may have names, too.
    if usual < SERIES || 5 * usual < 3 * images.len() {
        return Vec::new();
    }
    let odd = images.iter().copied();
    odd.filter(|&index| counts[&pattern(index)] == 1).collect()
}

/// The mask among the candidates: a file called just `mask`, else the first with it in its name.
fn best_mask<S: AsRef<str>>(candidates: &[usize], names: &[S], words: &Words) -> Option<usize> {
    let masks: Vec<usize> = candidates
        .iter()
        .copied()
        .filter(|&index| words.reason(names[index].as_ref()) == Some(LeftOutReason::Mask))
        .collect();
    let plain = masks.iter().find(|&&index| {
        let stem = split_extension(names[index].as_ref()).0;
        stem.eq_ignore_ascii_case("mask")
    });
    plain.or(masks.first()).copied()
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
        // Names of people, and a list that is wrong.
        let named = |text: &str| {
            let found = find_list(&["names.txt", "1.png"], |_| Ok(text.to_owned()));
            found.unwrap().is_some()
        };
        assert!(!named("Alice\nBob\n") && named("1.png\nBob\n"));
        assert!(find_list(&names[..2], read).unwrap().is_none());
    }
}
