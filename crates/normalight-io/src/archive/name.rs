//! Names of files in archives, which may be meant to lead elsewhere.

/// A name as a path within the archive: forward slashes, no empty parts and no `.`; `None` for one
/// that leads out of it: with `..`, a drive, a slash at its beginning, or a zero byte, at which
/// other programs stop.
pub(super) fn inner_path(name: &str) -> Option<String> {
    let slashes = name.replace('\\', "/");
    let parts: Vec<&str> = slashes
        .split('/')
        .filter(|part| !part.is_empty() && *part != ".")
        .collect();
    let is_drive = matches!(slashes.as_bytes(), [letter, b':', ..] if letter.is_ascii_alphabetic());
    let leads_out =
        slashes.starts_with('/') || is_drive || slashes.contains('\0') || parts.contains(&"..");
    (!leads_out).then(|| parts.join("/"))
}

/// A name for a message: what would move the cursor or colour the screen is spelled out, and a long
/// one is cut.
pub(super) fn shown(name: &str) -> String {
    const LONGEST: usize = 120;
    let mut letters = name.chars();
    let start: String = letters.by_ref().take(LONGEST).collect();
    let more = if letters.next().is_some() { "..." } else { "" };
    format!("{start:?}{more}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_stay_within() {
        for (name, path) in [
            ("a/b.png", Some("a/b.png")),
            ("./a//b.png", Some("a/b.png")),
            ("vase\\2.png", Some("vase/2.png")),
            ("photos/", Some("photos")),
            ("./", Some("")),
            ("a..b/..c.png", Some("a..b/..c.png")),
            ("../b.png", None),
            ("a/../b.png", None),
            ("a\\..\\b.png", None),
            ("/etc/b.png", None),
            ("\\\\host\\b.png", None),
            ("C:\\b.png", None),
            ("c:b.png", None),
            ("b.png\0.txt", None),
        ] {
            assert_eq!(inner_path(name).as_deref(), path, "{name:?}");
        }
    }

    #[test]
    fn names_are_shown_safely() {
        assert_eq!(shown("a\u{1b}[31m\nb"), "\"a\\u{1b}[31m\\nb\"");
        assert_eq!(shown(&"x".repeat(500)).len(), 125);
    }
}
