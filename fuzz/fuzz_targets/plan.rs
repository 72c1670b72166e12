//! Which of some files are the photographs: arbitrary names and lists.
#![no_main]
use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use normalight_io::{find_list, plan_stack};

#[derive(Debug, Arbitrary)]
enum Name {
    Numbered(u8, u8),
    Word(u8, String, u8),
    Any(String),
}

const WORDS: [&str; 12] = [
    "mask",
    "normal",
    "img_",
    "x/mask_",
    "__MACOSX/",
    "rejects",
    "filenames",
    "ambient",
    "",
    "ao",
    "._",
    "names",
];
const EXTENSIONS: [&str; 8] = [".png", ".txt", ".tif", ".JPG", ".lp", ".heic", "", ".info"];

impl Name {
    fn text(&self) -> String {
        let word = |k: &u8| WORDS[usize::from(*k) % WORDS.len()];
        let extension = |k: &u8| EXTENSIONS[usize::from(*k) % EXTENSIONS.len()];
        match self {
            Self::Numbered(k, number) => format!("{}{number}{}", word(k), extension(k)),
            Self::Word(k, text, end) => format!("{}{text}{}", word(k), extension(end)),
            Self::Any(text) => text.clone(),
        }
    }
}

fuzz_target!(|folder: (Vec<Name>, String, bool)| {
    let (names, text, lists_names) = folder;
    let names: Vec<String> = names.iter().map(Name::text).collect();
    // A list of what is there gets further than any text.
    let text = if lists_names {
        format!("{}\n{text}", names.join("\n"))
    } else {
        text
    };
    let Ok(list) = find_list(&names, |_| Ok(text.clone())) else {
        return;
    };
    let list = list
        .as_ref()
        .map(|(index, text)| (names[*index].as_str(), text.as_str()));
    for list in [None, list] {
        let Ok(plan) = plan_stack(&names, list) else {
            continue;
        };
        let mut used: Vec<usize> = plan.images.iter().copied().chain(plan.mask).collect();
        used.sort_unstable();
        assert!(
            used.windows(2).all(|pair| pair[0] < pair[1]),
            "twice: {plan:?}"
        );
        assert!(used.last().is_none_or(|&last| last < names.len()));
        for left in &plan.left_out {
            let place = names.iter().position(|name| *name == left.file);
            let place = place.expect("only what was there is left out");
            // The same name may stand there twice.
            let twice = names.iter().filter(|name| **name == left.file).count() > 1;
            assert!(
                twice || !used.contains(&place),
                "used and left out: {plan:?}"
            );
        }
        assert_eq!(plan, plan_stack(&names, list).expect("as before"));
    }
});
