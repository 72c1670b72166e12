//! Lists of photographs.
use crate::IoError;
use crate::format::{base_name, format_of_extension, split_extension};
use crate::plan::kinds::{is_helper, says_rejects};

/// The list among some files, given a way to see a file's text: `filenames.txt`, else a `names.txt` with the name of any
/// image, else the first `.txt` file whose lines are all image names (after an optional count) and whose
/// own name does not say that these are rejects.
///
/// # Errors
/// Those of `read_text` for the first two.
pub fn find_list<S: AsRef<str>>(
    names: &[S],
    mut read_text: impl FnMut(usize) -> Result<String, IoError>,
) -> Result<Option<(usize, String)>, IoError> {
    for wanted in ["filenames.txt", "names.txt"] {
        let found = names.iter().map(AsRef::as_ref).position(|name: &str| {
            base_name(name).eq_ignore_ascii_case(wanted) && !is_helper(name)
        });
        if let Some(index) = found {
            let text = read_text(index)?;
            // Names may be those of people.
            if wanted == "filenames.txt"
                || text.lines().any(|line| image_name(line.trim()).is_some())
            {
                return Ok(Some((index, text)));
            }
        }
    }
    let mut texts: Vec<usize> = (0..names.len())
        .filter(|&index| {
            let name = names[index].as_ref();
            split_extension(name).1.eq_ignore_ascii_case("txt")
                && !is_helper(name)
                && !says_rejects(name)
        })
        .collect();
    texts.sort_by(|&a, &b| natord::compare(names[a].as_ref(), names[b].as_ref()));
    for index in texts {
        // Any other text may lie here: one that cannot be read is no list.
        let Ok(text) = read_text(index) else { continue };
        if parse("", &text).is_ok_and(|(_, entries)| !entries.is_empty()) {
            return Ok(Some((index, text)));
        }
    }
    Ok(None)
}

/// The count and the names of a list file, as they stand there.
pub(super) fn parse<'text>(
    list: &str,
    text: &'text str,
) -> Result<(Option<usize>, Vec<&'text str>), IoError> {
    let mut count = None;
    let mut entries = Vec::new();
    // Editors on Windows begin text files with a byte order mark.
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    for line in lines.filter(|line| !line.is_empty()) {
        match (image_name(line), line.parse()) {
            (Some(name), _) => entries.push(name),
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

/// Names may hold spaces, so the whole line comes first; other words are lights.
fn image_name(line: &str) -> Option<&str> {
    let first_word = line.split_whitespace().next().unwrap_or(line);
    let quoted = line
        .strip_prefix('"')
        .and_then(|rest| rest.split('"').next());
    [Some(line), quoted, Some(first_word)]
        .into_iter()
        .flatten()
        .find(|name| format_of_extension(name).is_some())
}
