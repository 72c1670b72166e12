//! Which page of a file is the picture.
use super::directory::{Directory, File};
use super::tags::{self, compression, photometric};
use crate::IoError;
use crate::decode::source::Source;
use crate::format::unread::RAW_ADVICE;
use std::collections::HashSet;

/// Most pages that are counted, and most directories below one that are looked at.
pub(super) const MAX_PAGES: usize = 10_000;
const MAX_BELOW: usize = 16;

/// The page that is taken.
pub(super) struct Pages<'a> {
    pub(super) page: Directory<'a>,
    /// Which it is, from 1.
    pub(super) number: usize,
    /// How many there are.
    pub(super) of: usize,
}

/// The first page that is neither a preview nor the mask of another.
///
/// # Errors
/// Raw data of a camera: those files begin with a small preview, which must not pass for the
/// picture. No page, or nothing but previews.
pub(super) fn find<'a>(source: &Source, file: &File<'a>) -> Result<Pages<'a>, IoError> {
    let mut seen = HashSet::new();
    let mut at = file.first().unwrap_or(0);
    let mut found = None;
    let mut of = 0;
    // Broken further pages are nobody's concern.
    while at != 0 && of < MAX_PAGES && seen.insert(at) {
        let Some(page) = file.directory(at) else {
            break;
        };
        of += 1;
        if is_raw(file, &page) {
            return Err(source.unread("the RAW data of a camera", RAW_ADVICE));
        }
        at = page.next;
        if of == 1 {
            of = slices(&page).unwrap_or(1);
        }
        if found.is_none() && page.has(tags::WIDTH) && !is_beside(&page) {
            found = Some((page, seen.len()));
        }
    }
    match found {
        Some((page, number)) => Ok(Pages { page, number, of }),
        None if of == 0 => Err(source.damaged("it has no page")),
        None => Err(source.unread("previews only", "export the picture itself")),
    }
}

/// Whether a page is a preview or a mask of another.
pub(super) fn is_beside(page: &Directory) -> bool {
    page.one(tags::SUBFILE).unwrap_or(0) & 0b101 != 0 || page.one(tags::OLD_SUBFILE) == Some(2)
}

fn is_raw(file: &File, page: &Directory) -> bool {
    let below = page.all(tags::SUB_DIRECTORIES);
    let below = below.iter().take(MAX_BELOW);
    let below = below.filter_map(|&at| file.directory(at));
    below.into_iter().any(|page| is_mosaic(&page)) || is_mosaic(page)
}

fn is_mosaic(page: &Directory) -> bool {
    let one = |tag| page.one(tag).unwrap_or(0);
    page.has(tags::DNG_VERSION)
        || photometric::OF_CAMERAS.contains(&one(tags::PHOTOMETRIC))
        || compression::is_of_cameras(one(tags::COMPRESSION))
}

/// Pictures behind one directory, as ImageJ stores large stacks: its description counts them.
pub(super) fn slices(page: &Directory) -> Option<usize> {
    let text = page.bytes(tags::DESCRIPTION)?;
    let text = std::str::from_utf8(&text[..text.len().min(4096)]).ok()?;
    let is_imagej = text.starts_with("ImageJ=") && page.next == 0;
    let mut lines = text.lines().filter_map(|line| line.strip_prefix("images="));
    lines
        .next()?
        .trim()
        .parse()
        .ok()
        .filter(|&count| is_imagej && count > 0)
}
