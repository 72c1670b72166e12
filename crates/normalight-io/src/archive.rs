//! Archives: which files are in them, and the content of each when it is asked for. Nothing is
//! written to a disk.
mod kind;
mod name;
mod pages;
mod tar;
mod zip;

pub(crate) use kind::{ArchiveKind, HEAD};

use crate::IoError;
use crate::limits::{
    ARCHIVE_BYTES_AT_ANY_RATIO, MAX_ARCHIVE_BYTES, MAX_ARCHIVE_FILES, MAX_ARCHIVE_RATIO,
};
use name::{inner_path, shown};
use std::collections::HashSet;
use std::io::{Read, Seek, SeekFrom};

/// Bytes that an archive is read from: a file on a disk or in memory.
pub(crate) trait Source: Read + Seek {}

impl<T: Read + Seek> Source for T {}

/// An archive that was opened: its files are listed and known to be readable in kind.
pub(crate) struct Archive {
    /// The archive's own name, for messages.
    pub(crate) name: String,
    kind: ArchiveKind,
    /// Paths of its files, with forward slashes, each once.
    pub(crate) files: Vec<String>,
    /// Paths of its links, which are not followed.
    pub(crate) links: Vec<String>,
    content: Box<dyn Content>,
}

/// What is wrong with an archive: what was found and what was expected.
struct Fault {
    found: String,
    expected: String,
}

impl Fault {
    fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            found: found.into(),
            expected: expected.into(),
        }
    }

    /// An archive that ends too early or is changed.
    fn damage(reason: impl std::fmt::Display) -> Self {
        Self::new(
            format!("damage, or cut off ({reason})"),
            "a complete archive: fetch or pack it again",
        )
    }

    /// An archive that unpacks to more than `limit` bytes.
    fn too_much(limit: u64) -> Self {
        Self::new(
            format!("files that unpack to more than {limit} bytes"),
            format!("at most {MAX_ARCHIVE_RATIO} times its own size and {MAX_ARCHIVE_BYTES} bytes"),
        )
    }
}

/// The files of an archive, by their place in its list.
trait Content {
    /// A file's bytes, see [`Archive::read`].
    fn read(&mut self, index: usize, limits: &ReadLimits) -> Result<Vec<u8>, Unread>;
}

/// What may be read of one file.
pub(crate) struct ReadLimits {
    /// Most bytes.
    pub(crate) most: u64,
    /// Whether the file will be asked for again.
    pub(crate) again: bool,
}

/// Why a file of an archive cannot be had.
enum Unread {
    Fault(Fault),
    /// It has so many bytes.
    TooLarge(u64),
}

impl From<Fault> for Unread {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

/// The files of an archive as they are found.
#[derive(Default)]
struct Listing {
    files: Vec<String>,
    links: Vec<String>,
    /// Folders included.
    entries: usize,
}

impl Listing {
    /// Counts an entry and makes its name a path within the archive.
    fn path(&mut self, name: &str) -> Result<String, Fault> {
        self.entries += 1;
        check_count(self.entries as u64)?;
        inner_path(name).ok_or_else(|| {
            Fault::new(
                format!("a path that leads out of it ({})", shown(name)),
                "paths within the archive",
            )
        })
    }
}

fn check_count(entries: u64) -> Result<(), Fault> {
    if entries <= MAX_ARCHIVE_FILES as u64 {
        return Ok(());
    }
    Err(Fault::new(
        format!("{entries} files or more"),
        format!("at most {MAX_ARCHIVE_FILES}"),
    ))
}

/// Most bytes that an archive of this size may unpack to.
fn unpacked_limit(packed: u64) -> u64 {
    let by_ratio = packed.saturating_mul(MAX_ARCHIVE_RATIO);
    by_ratio.clamp(ARCHIVE_BYTES_AT_ANY_RATIO, MAX_ARCHIVE_BYTES)
}

impl Archive {
    /// Lists the files of an archive; `kind` is that of its content.
    ///
    /// # Errors
    /// [`IoError::Archive`] for a format that is not read, damage, too many or too large files,
    /// encryption, an unknown compression, paths that lead elsewhere, two files of one name, and
    /// nothing in it.
    pub(crate) fn open(
        name: &str,
        kind: ArchiveKind,
        source: Box<dyn Source>,
    ) -> Result<Self, IoError> {
        Self::list(name, kind, source).map_err(|fault| archive_error(name, kind, fault))
    }

    fn list(name: &str, kind: ArchiveKind, mut source: Box<dyn Source>) -> Result<Self, Fault> {
        let length = source.seek(SeekFrom::End(0)).map_err(Fault::damage)?;
        source.rewind().map_err(Fault::damage)?;
        let (listing, content): (Listing, Box<dyn Content>) = match kind {
            ArchiveKind::Zip => zip::open(source, length)?,
            ArchiveKind::Tar => tar::open(source, length)?,
            ArchiveKind::TarGz => tar::unpack(source, length)?,
            ArchiveKind::Pages => pages::open(name, source)?,
            ArchiveKind::Unread(_) => {
                return Err(Fault::new(
                    "a format that is not read",
                    "zip, tar or tar.gz: unpack it and give the folder",
                ));
            }
        };
        let Listing { files, links, .. } = listing;
        if files.is_empty() {
            return Err(Fault::new("no files", "photographs"));
        }
        let mut seen = HashSet::new();
        if let Some(twice) = files.iter().find(|file| !seen.insert(file.as_str())) {
            return Err(Fault::new(
                format!("two files of one name ({})", shown(twice)),
                "each name once",
            ));
        }
        Ok(Self {
            name: name.to_owned(),
            kind,
            files,
            links,
            content,
        })
    }

    /// Whether it is a picture file whose pages are the photographs.
    pub(crate) fn is_paged(&self) -> bool {
        self.kind == ArchiveKind::Pages
    }

    /// The error for an archive with this one in place of photographs.
    pub(crate) fn holds_archive(&self, inner: &str) -> IoError {
        let fault = Fault::new(
            format!("another archive ({}) in place of photographs", shown(inner)),
            "photographs: unpack it and give what is inside",
        );
        archive_error(&self.name, self.kind, fault)
    }

    /// The bytes of a file of [`Archive::files`], which may be handed out only once unless it is
    /// said to be asked for again.
    ///
    /// # Errors
    /// [`IoError::FileTooLarge`]; [`IoError::Archive`] for damage.
    pub(crate) fn read(&mut self, index: usize, limits: &ReadLimits) -> Result<Vec<u8>, IoError> {
        let read = self.content.read(index, limits);
        read.map_err(|unread| match unread {
            Unread::Fault(fault) => archive_error(&self.name, self.kind, fault),
            Unread::TooLarge(found) => IoError::FileTooLarge {
                name: format!("{}/{}", self.name, self.files[index]),
                found,
                limit: limits.most,
            },
        })
    }
}

fn archive_error(name: &str, kind: ArchiveKind, fault: Fault) -> IoError {
    IoError::Archive {
        name: name.to_owned(),
        format: kind.label(),
        found: fault.found,
        expected: fault.expected,
    }
}
