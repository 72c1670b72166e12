//! What a file's name says about it.
use crate::archive::ArchiveKind;
use crate::format::{base_name, format_of_extension, is_foreign, split_extension};
use crate::input_plan::LeftOutReason;
use crate::names::{folded, stem};

/// Words for masks and for pictures that are results or aids, anywhere in a name.
const MASKS: &[&str] = &["mask", "silhouette", "matte"];
const AMBIENT: &[&str] = &[
    "ambient",
    "noflash",
    "no_flash",
    "no-flash",
    "no flash",
    "nolight",
    "no_light",
    "no-light",
    "no light",
    "nolamp",
    "no_lamp",
    "no-lamp",
    "no lamp",
    "umgebung",
    "flat_field",
    "flatfield",
    "flat field",
];
const MAPS: &[&str] = &[
    "normal",
    "albedo",
    "depth",
    "basecolor",
    "base color",
    "base_color",
    "roughness",
    "metallic",
    "metalness",
    "displacement",
    "curvature",
    "occlusion",
    "specular",
    "diffuse",
    "confidence",
    "emissive",
    "cavity",
    "tonemapped",
    "tone_mapped",
    "contact_sheet",
    "contactsheet",
    "panorama",
    "composite",
];
/// Words that stand in other words too: only alone, between signs or digits.
const SHORT_AMBIENT: &[&str] = &["dark", "off", "unlit", "darkframe"];
const SHORT_MAPS: &[&str] = &[
    "error",
    "height",
    "heightmap",
    "ao",
    "nrm",
    "rough",
    "metal",
    "opacity",
    "bump",
    "disp",
    "gloss",
    "spec",
    "orm",
    "arm",
    "rho",
    "average",
    "median",
    "preview",
    "blend",
    "snapshot",
    "nor",
    "diff",
];

/// Words of texts that list what shall not be used.
const REJECTS: &[&str] = &[
    "reject", "exclude", "skip", "ignore", "omit", "delete", "cull", "outlier", "blur", "unused",
    "remove", "trash", "discard", "failed",
];

/// Words at the end of a name that say which of several copies of a shot it is.
const VARIANTS: &[&str] = &[
    "8bit",
    "8bits",
    "8b",
    "16bit",
    "16bits",
    "16b",
    "32bit",
    "32f",
    "bit",
    "bits",
    "lin",
    "linear",
    "srgb",
    "gamma",
    "small",
    "large",
    "thumb",
    "thumbnail",
    "web",
    "lowres",
    "highres",
    "orig",
    "original",
    "edited",
    "copy",
    "raw",
    "png",
    "jpg",
    "jpeg",
    "tif",
    "tiff",
];

/// A folded stem without the word at its end that says which of several copies it is, and a number before that word:
/// `a_16_bit` is `a`.
pub(super) fn without_variant(stem: &str) -> &str {
    let parted = |name: &'_ str| name.rfind(['_', '-', ' ', '.']).map(|at| (at, at + 1));
    let Some((end, start)) = parted(stem) else {
        return stem;
    };
    let word = &stem[start..];
    if !VARIANTS.contains(&word) {
        return stem;
    }
    let rest = &stem[..end];
    match parted(rest) {
        Some((end, start))
            if word.starts_with("bit") && ["8", "16", "32"].contains(&&rest[start..]) =>
        {
            &rest[..end]
        }
        _ => rest,
    }
}

/// The words that tell the files of one place apart.
pub(super) struct Words {
    /// Words that most names have: they say nothing.
    shared: Vec<&'static str>,
}

impl Words {
    pub(super) fn of<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let stems: Vec<String> = names.map(|name| folded(stem(name))).collect();
        let all = [MASKS, AMBIENT, SHORT_AMBIENT, MAPS, SHORT_MAPS]
            .into_iter()
            .flatten();
        let shared = all.copied().filter(|word| {
            let count = stems.iter().filter(|stem| has_word(stem, word)).count();
            // Among a few files a majority is soon reached by masks and maps.
            2 * count > stems.len() && count >= 3
        });
        Self {
            shared: shared.collect(),
        }
    }

    /// Why a picture is no photograph.
    pub(super) fn reason(&self, name: &str) -> Option<LeftOutReason> {
        let stem = folded(stem(base_name(name)));
        let has = |words: &[&'static str]| {
            let told = |word: &&&'static str| !self.shared.contains(*word) || stem == ***word;
            words
                .iter()
                .filter(told)
                .find(|word| has_word(&stem, word))
                .copied()
        };
        if has(MASKS).is_some() {
            return Some(LeftOutReason::Mask);
        }
        if has(AMBIENT).or_else(|| has(SHORT_AMBIENT)).is_some() {
            return Some(LeftOutReason::Ambient);
        }
        let word = has(MAPS).or_else(|| has(SHORT_MAPS))?;
        Some(LeftOutReason::Map {
            word: word.to_owned(),
        })
    }
}

fn has_word(stem: &str, word: &str) -> bool {
    if !SHORT_MAPS.contains(&word) && !SHORT_AMBIENT.contains(&word) {
        return stem.contains(word);
    }
    stem.split(|c: char| !c.is_alphabetic())
        .any(|part| part == word)
}

/// Images that are no helper files of a system.
pub(super) fn is_visible_image(name: &str) -> bool {
    format_of_extension(name).is_some() && !is_helper(name)
}

/// Files that operating systems and programs leave beside those of people.
pub fn is_helper(name: &str) -> bool {
    let base = base_name(name);
    let known = ["thumbs.db", "desktop.ini", "icon\r"];
    base.starts_with('.')
        || name.split(['/', '\\']).any(|part| part == "__MACOSX")
        || known.iter().any(|known| base.eq_ignore_ascii_case(known))
        || split_extension(name).1.eq_ignore_ascii_case("info")
}

/// Whether a text's name says that it lists what shall not be used.
pub(super) fn says_rejects(name: &str) -> bool {
    let stem = folded(split_extension(name).0);
    let mut words = stem.split(|c: char| !c.is_alphabetic());
    // "bad" is a word, "badger" another; "rejects" and "excluded" are of one kind.
    words.any(|word| word == "bad" || REJECTS.iter().any(|reject| word.starts_with(reject)))
}

/// Why a file that is no image of a known format is left out; `None` for texts, which may be of
/// use, and for images.
pub(super) fn left_out_reason(name: &str) -> Option<LeftOutReason> {
    if is_helper(name) {
        return Some(LeftOutReason::System);
    }
    if !is_foreign(name) {
        return None;
    }
    if ArchiveKind::of_extension(name).is_some() {
        return Some(LeftOutReason::Archive);
    }
    let extension = split_extension(name).1.to_ascii_lowercase();
    Some(match crate::format::unread_format(&extension) {
        Some(format) => LeftOutReason::UnreadFormat {
            format: format.to_owned(),
        },
        None => LeftOutReason::NotAnImage,
    })
}
