//! Published sets whose samples are proportional to light, told by how their files lie.
//!
//! - DiLiGenT and what is published like it: `filenames.txt`, `light_directions.txt`,
//!   `light_intensities.txt`, `Normal_gt.mat`, any two of them;
//! - Blobby, Sculpture and what is rendered like them: a list with the lights beside the names;
//! - the captures of the University of Washington, which courses hand out: `cat.0.tga` to
//!   `cat.11.tga` with `cat.mask.tga`, listed below `psmImages/`;
//! - the Yale face databases B, taken with a camera of linear response (Georghiades, Belhumeur and
//!   Kriegman, "From few to many", 2001): `yaleB01_P00A+003E+20.pgm`.
//!
//! Not among them: folders with `names.txt` or `objects.txt`, into which people are asked to put
//! photographs of their own.
use crate::format::{base_name, format_of_extension, split_extension};

/// Whether the files lie as those of such a set; `list` is the text of the list of the photographs.
pub(super) fn is_benchmark<S: AsRef<str>>(names: &[S], list: Option<&str>) -> bool {
    let names: Vec<String> = names
        .iter()
        .map(|name| base_name(name.as_ref()).to_ascii_lowercase())
        .collect();
    is_diligent(&names)
        || list.is_some_and(|text| has_lights(text) || is_washington_list(text))
        || is_washington(&names)
        || is_yale(&names)
}

fn is_diligent(names: &[String]) -> bool {
    let marks = [
        "filenames.txt",
        "light_directions.txt",
        "light_intensities.txt",
        "normal_gt.mat",
    ];
    let has = |mark: &&&str| names.iter().any(|name| name == **mark);
    marks.iter().filter(has).count() >= 2
}

/// Whether lights stand beside the names of a list.
fn has_lights(text: &str) -> bool {
    let beside = |line: &str| {
        let words = line.split_whitespace().skip(1);
        let numbers = words.map(|word| word.parse::<f32>().is_ok());
        let (all, count) = numbers.fold((true, 0), |(all, n), is| (all && is, n + 1));
        all && matches!(count, 3 | 4 | 6)
    };
    let mut lines = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .peekable();
    lines.peek().is_some() && lines.all(beside)
}

/// `cat.0.tga`, `cat.1.tga` and so on without a gap, and `cat.mask.tga`: the only photographs
/// there. People keep them as PNG, too.
fn is_washington(names: &[String]) -> bool {
    let parts = |name: &str| -> Option<(String, String)> {
        let (stem, extension) = split_extension(name);
        let (object, word) = stem.rsplit_once('.')?;
        matches!(extension, "tga" | "png").then(|| (object.to_owned(), word.to_owned()))
    };
    let images: Vec<_> = names
        .iter()
        .filter(|name| format_of_extension(name).is_some())
        .map(|name| parts(name))
        .collect();
    let Some(mask) = images.iter().flatten().find(|(_, word)| word == "mask") else {
        return false;
    };
    let of_object = |word: &str| {
        let wanted = Some((mask.0.clone(), word.to_owned()));
        images.contains(&wanted)
    };
    let shots = (0..).take_while(|k: &usize| of_object(&k.to_string()));
    let shots = shots.count();
    // The mask and somebody's results may lie beside the shots, other photographs may not.
    let numbered = |(_, word): &&(String, String)| word.parse::<usize>().is_ok();
    shots >= 3
        && images.iter().all(Option::is_some)
        && images.iter().flatten().filter(numbered).count() == shots
}

fn is_washington_list(text: &str) -> bool {
    let paths = text.lines().map(str::trim);
    let mut images = paths
        .filter(|line| format_of_extension(line).is_some())
        .peekable();
    images.peek().is_some() && images.all(|line| line.starts_with("psmImages/"))
}

/// Azimuth and elevation of the lamp in every name, as that database writes them.
fn is_yale(names: &[String]) -> bool {
    let mut images = names
        .iter()
        .filter(|name| format_of_extension(name).is_some())
        .peekable();
    images.peek().is_some() && images.all(|name| is_yale_name(name))
}

fn is_yale_name(name: &str) -> bool {
    let stem = split_extension(name).0;
    let shape: String = stem
        .chars()
        .map(|c| match c {
            '0'..='9' => '0',
            '+' | '-' => '+',
            other => other,
        })
        .collect();
    // The picture without lamp lies among them.
    shape == "yaleb00_p00a+000e+00" || shape == "yaleb00_p00_ambient"
}

#[cfg(test)]
mod tests {
    use super::is_benchmark;

    fn washington(extension: &str) -> Vec<String> {
        let words = (0..12).map(|k| k.to_string()).chain(["mask".to_owned()]);
        words
            .map(|word| format!("Owl.{word}.{extension}"))
            .collect()
    }

    #[test]
    fn captures_of_washington() {
        let mut names = washington("tga");
        assert!(is_benchmark(&names, None));
        assert!(is_benchmark(&washington("png"), None));
        // Cameras write JPEG.
        assert!(!is_benchmark(&washington("jpg"), None));
        names.push("Owl.albedo.tga".to_owned());
        assert!(is_benchmark(&names, None));
        names.push("IMG_1.png".to_owned());
        assert!(!is_benchmark(&names, None));
        // Without a mask, or with a gap, only the list can tell.
        let plain = washington("tga")[..12].to_vec();
        assert!(!is_benchmark(&plain, None));
        let list = "2\npsmImages/owl/owl.0.tga\npsmImages/owl/owl.1.tga\n";
        assert!(is_benchmark(&plain, Some(list)));
        assert!(!is_benchmark(
            &plain,
            Some(&list.replace("psmImages", "mine"))
        ));
        let mut gap = washington("tga");
        gap.remove(5);
        assert!(!is_benchmark(&gap, None));
    }

    #[test]
    fn faces_of_yale() {
        let mut names = vec![
            "yaleB01_P00A+003E+20.pgm",
            "yaleB01_P00A-018E-19.pgm",
            "yaleB01_P00_Ambient.pgm",
            "yaleB01_P00.info",
        ];
        assert!(is_benchmark(&names, None));
        names.push("face.pgm");
        assert!(!is_benchmark(&names, None));
        assert!(!is_benchmark(&["face.pgm", "A+003E+20.pgm"], None));
    }

    #[test]
    fn own_folders_are_none() {
        let own = [
            "IMG_1.png",
            "IMG_2.png",
            "mask.png",
            "names.txt",
            "objects.txt",
        ];
        assert!(!is_benchmark(&own, Some("IMG_1.png\nIMG_2.png\n")));
        assert!(is_benchmark(
            &["filenames.txt", "light_directions.txt"],
            None
        ));
        assert!(is_benchmark(
            &own,
            Some("IMG_1.png 0 0 1\nIMG_2.png 0 0.1 0.9\n")
        ));
    }
}
