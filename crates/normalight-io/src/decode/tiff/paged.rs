//! A file of several pages as files of one page each: whole captures come like this out of scientific programs.
use super::directory::{Directory, File};
use super::new_directory::NewDirectory;
use super::pages::{MAX_PAGES, is_beside, slices};
use super::tags;
use normalight_core::MIN_IMAGES;
use std::collections::HashSet;

/// Entries that point elsewhere in the file, or say that a page is one of several (descriptions do).
const LEFT_OUT: [u16; 9] = [
    tags::DESCRIPTION,
    tags::SUBFILE,
    tags::OLD_SUBFILE,
    tags::EXIF,
    tags::SUB_DIRECTORIES,
    tags::STRIP_OFFSETS,
    tags::STRIP_BYTES,
    tags::TILE_OFFSETS,
    tags::TILE_BYTES,
];

/// The pages of a file that may be photographs of one stack.
pub(crate) struct PagedTiff {
    bytes: Vec<u8>,
    pages: Vec<Page>,
}

/// Where a page's directory is, and how far behind the place it names its samples lie.
#[derive(Clone, Copy)]
struct Page {
    directory: u64,
    behind: u64,
}

impl PagedTiff {
    /// `None` for files that are no TIFF, have fewer pages than a stack has photographs, or pages of several sizes.
    pub(crate) fn open(bytes: Vec<u8>) -> Option<Self> {
        let pages = find(&File::new(&bytes)?);
        (pages.len() >= MIN_IMAGES).then_some(Self { bytes, pages })
    }

    /// Whether a file that begins like this is a TIFF at all.
    pub(crate) fn may_be(head: &[u8]) -> bool {
        File::new(head).is_some()
    }

    /// Whether some bytes are such a file.
    pub(crate) fn is_one(bytes: &[u8]) -> bool {
        File::new(bytes).is_some_and(|file| find(&file).len() >= MIN_IMAGES)
    }

    /// Number of pages.
    pub(crate) fn len(&self) -> usize {
        self.pages.len()
    }

    /// A file of one page, with its samples as they are packed; samples outside the file are left out.
    pub(crate) fn page(&self, index: usize) -> Vec<u8> {
        let page = self.pages[index];
        let Some(file) = File::new(&self.bytes) else {
            return Vec::new();
        };
        match file.directory(page.directory) {
            Some(directory) => alone(&file, &directory, page.behind),
            None => Vec::new(),
        }
    }
}

fn find(file: &File) -> Vec<Page> {
    let (mut pages, mut sizes, mut seen) = (Vec::new(), HashSet::new(), HashSet::new());
    let mut at = file.first().unwrap_or(0);
    while at != 0 && pages.len() < MAX_PAGES && seen.insert(at) {
        let Some(page) = file.directory(at) else {
            break;
        };
        if page.has(tags::WIDTH) && !is_beside(&page) {
            sizes.insert((page.one(tags::WIDTH), page.one(tags::HEIGHT)));
            let length: u64 = page.all(lengths(&page)).iter().sum();
            let is_first = pages.is_empty();
            let count = slices(&page).filter(|_| is_first).unwrap_or(1);
            let within = |k: &u64| k * length <= file.bytes.len() as u64;
            let behind = (0..count.min(MAX_PAGES) as u64).filter(within);
            pages.extend(behind.map(|k| Page {
                directory: at,
                behind: k * length,
            }));
        }
        at = page.next;
    }
    match sizes.len() {
        1 => pages,
        _ => Vec::new(),
    }
}

/// The entry that says how long strips or tiles are.
fn lengths(page: &Directory) -> u16 {
    match page.has(tags::TILE_OFFSETS) {
        true => tags::TILE_BYTES,
        false => tags::STRIP_BYTES,
    }
}

fn alone(file: &File, page: &Directory, behind: u64) -> Vec<u8> {
    let head = if file.big { 16 } else { 8 };
    let mut bytes = file.bytes[..head].to_vec();
    let mut directory = NewDirectory::beside(file);
    for entry in &page.entries {
        if !LEFT_OUT.contains(&entry.tag) {
            directory.copy(entry);
        }
    }
    let (offsets, lengths) = match lengths(page) {
        tags::TILE_BYTES => (tags::TILE_OFFSETS, tags::TILE_BYTES),
        other => (tags::STRIP_OFFSETS, other),
    };
    let (mut places, mut sizes) = (Vec::new(), Vec::new());
    for (start, length) in page.all(offsets).into_iter().zip(page.all(lengths)) {
        let chunk = (start.checked_add(behind)).and_then(|start| {
            let range =
                usize::try_from(start).ok()?..usize::try_from(start.checked_add(length)?).ok()?;
            file.bytes.get(range)
        });
        let chunk = chunk.unwrap_or_default();
        places.push(bytes.len() as u64);
        sizes.push(chunk.len() as u64);
        bytes.extend_from_slice(chunk);
        if bytes.len() % 2 == 1 {
            bytes.push(0);
        }
    }
    directory.set(offsets, &places);
    directory.set(lengths, &sizes);
    let start = bytes.len() as u64;
    let place = directory.write(start, &mut bytes);
    let first = directory.word(place);
    bytes[head - first.len()..head].copy_from_slice(&first);
    bytes
}
