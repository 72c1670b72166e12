//! Names of files, which programs and systems write in different ways.
use crate::format::{base_name, split_extension};
use serde::{Deserialize, Serialize};
use std::fmt;
use unicode_normalization::UnicodeNormalization;

/// By what two names were found to mean the same file, the surest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum NameMatch {
    /// Letter by letter.
    Full,
    /// By the end of the path: other folders, slashes, case or Unicode form.
    PathEnd,
    /// By the name without its extension.
    Stem,
    /// By the number in the name.
    Number,
    /// Not by names at all: the first belongs to the first.
    Position,
}

impl fmt::Display for NameMatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Full => "their names",
            Self::PathEnd => "their names without folders",
            Self::Stem => "their names without extensions",
            Self::Number => "the numbers in their names",
            Self::Position => "their order",
        })
    }
}

/// A name made ready for comparisons.
#[derive(Debug, Clone)]
pub(crate) struct NameKey {
    full: String,
    /// Folded parts of the path, the file first.
    parts: Vec<String>,
    stem: String,
    /// The last number in the name.
    pub(crate) number: Option<u64>,
}

impl NameKey {
    pub(crate) fn new(name: &str) -> Self {
        let folded = folded(name);
        let parts: Vec<String> = folded
            .rsplit('/')
            .map(|part| part.trim().to_owned())
            .collect();
        let stem = stem(&parts[0]).to_owned();
        Self {
            full: name.to_owned(),
            number: last_number(&stem),
            parts,
            stem,
        }
    }

    /// Parts of the path that agree, counted from the file.
    fn shared_parts(&self, other: &Self) -> usize {
        let pairs = self.parts.iter().zip(&other.parts);
        pairs.take_while(|(a, b)| a == b).count()
    }
}

/// Which of `keys` mean the same file as `wanted`, by the surest rule that finds any.
pub(crate) fn find(wanted: &NameKey, keys: &[NameKey]) -> Option<(NameMatch, Vec<usize>)> {
    let places = |fits: &dyn Fn(&NameKey) -> bool| -> Vec<usize> {
        (0..keys.len()).filter(|&k| fits(&keys[k])).collect()
    };
    let full = places(&|key| key.full == wanted.full);
    if !full.is_empty() {
        return Some((NameMatch::Full, full));
    }
    let longest = keys.iter().map(|key| key.shared_parts(wanted)).max()?;
    if longest > 0 {
        let ends = places(&|key| key.shared_parts(wanted) == longest);
        return Some((NameMatch::PathEnd, ends));
    }
    let stems = places(&|key| key.stem == wanted.stem);
    (!stems.is_empty()).then_some((NameMatch::Stem, stems))
}

/// One Unicode form, lower case, single spaces, forward slashes, no quotes around.
pub(crate) fn folded(name: &str) -> String {
    let lower = unquoted(name.trim()).nfc().flat_map(char::to_lowercase);
    let lower: String = lower.map(|c| if c == '\\' { '/' } else { c }).collect();
    // A lower letter may be a composition again.
    let lower: String = lower.nfc().collect();
    lower.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A text without the quotes around it.
pub(crate) fn unquoted(text: &str) -> &str {
    for quote in ['"', '\''] {
        let inner = text
            .strip_prefix(quote)
            .and_then(|rest| rest.strip_suffix(quote));
        if let Some(inner) = inner {
            return inner;
        }
    }
    text
}

/// A base name without its extension; what follows a dot but holds no letter is none.
pub(crate) fn stem(name: &str) -> &str {
    let (stem, extension) = split_extension(name);
    let is_extension = extension.len() <= 5 && extension.contains(|c: char| c.is_alphabetic());
    match is_extension && !extension.contains(' ') && !stem.is_empty() {
        true => stem,
        false => base_name(name),
    }
}

fn last_number(stem: &str) -> Option<u64> {
    let end = stem.rfind(|c: char| c.is_ascii_digit())? + 1;
    let digits = stem[..end]
        .bytes()
        .rev()
        .take_while(u8::is_ascii_digit)
        .count();
    stem[end - digits..end].parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(wanted: &str, names: &[&str]) -> Option<(NameMatch, Vec<usize>)> {
        let keys: Vec<NameKey> = names.iter().map(|name| NameKey::new(name)).collect();
        find(&NameKey::new(wanted), &keys)
    }

    #[test]
    fn the_surest_rule_counts() {
        let names = ["x/a.png", "y/a.png", "a.jpg", "A.PNG"];
        assert_eq!(found("a.jpg", &names), Some((NameMatch::Full, vec![2])));
        assert_eq!(
            found("C:\\deep\\y\\a.png", &names),
            Some((NameMatch::PathEnd, vec![1]))
        );
        assert_eq!(
            found("a.png", &names),
            Some((NameMatch::PathEnd, vec![0, 1, 3]))
        );
        assert_eq!(
            found("A.tif", &names[2..3]),
            Some((NameMatch::Stem, vec![0]))
        );
        assert_eq!(found("b.png", &names), None);
        assert_eq!(found("b.png", &[]), None);
    }

    #[test]
    fn unicode_forms_quotes_and_breaks_do_not_count() {
        let composed = "B\u{fc}ste 1.png";
        for other in ["Bu\u{308}ste 1.png", "\"B\u{dc}STE\n 1.png\""] {
            assert_eq!(folded(composed), folded(other));
        }
    }

    #[test]
    fn stems_and_numbers() {
        assert_eq!(
            ["a.b.png", "yale+003.5", "dir/x", ".png"].map(stem),
            ["a.b", "yale+003.5", "x", ".png"]
        );
        assert_eq!(NameKey::new("IMG_0042_b.png").number, Some(42));
        assert_eq!(NameKey::new("b.png").number, None);
    }
}
