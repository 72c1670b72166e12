//! The capture in archives, or in the pages of one file.
mod place;

use crate::archive::{Archive, ArchiveKind, HEAD, ReadLimits};
use crate::decode::PagedTiff;
use crate::format::{base_name, format_of_extension, split_extension};
use crate::input_plan::{LeftOut, LeftOutReason};
use crate::limits::{MAX_FILE_BYTES, MAX_TEXT_BYTES};
use crate::plan::{StackPlan, is_helper};
use crate::source::{FileSource, LooseFiles, MemoryFiles, Planned};
use crate::text::read_text;
use crate::{IoError, NamedBytes, Notice, ReadOptions, StackInput};
use std::collections::BTreeSet;

/// Archives among some files, and what of all the files belongs to the capture.
pub(crate) struct Packed {
    loose: Box<dyn LooseFiles>,
    archives: Vec<Archive>,
    names: Vec<String>,
    places: Vec<Place>,
    /// What is to be said of them: notices, and files that are left out.
    said: StackPlan,
    /// What messages call them all.
    whole: String,
}

/// Where a file is.
#[derive(Clone, Copy)]
enum Place {
    /// Beside the archives, at this position.
    Loose(usize),
    /// In an archive, at this position of its list.
    Inside(usize, usize),
}

impl Packed {
    /// Opens the archives among some files; the files back when there are none, or nothing in them
    /// below `folder`, which is empty for everywhere.
    ///
    /// Names of files are their paths in the archive, below the archive's name when there are other
    /// files, too.
    ///
    /// # Errors
    /// [`IoError::Archive`], and [`IoError::PhotographsBelow`] for several captures.
    pub(crate) fn open(
        mut files: Box<dyn LooseFiles>,
        folder: &str,
    ) -> Result<Result<Self, Box<dyn LooseFiles>>, IoError> {
        let Opened {
            archives,
            loose,
            mut notices,
        } = Opened::among(&mut *files)?;
        let is_helper_file = |&index: &usize| is_helper(&files.names()[index]);
        let is_alone = archives.len() == 1 && loose.iter().all(is_helper_file);
        let tops = match is_alone {
            true => vec![String::new()],
            false => tops(&archives),
        };
        let (mut paths, mut places) = (Vec::new(), Vec::new());
        for &index in &loose {
            paths.push(base_name(&files.names()[index]).to_owned());
            places.push(Place::Loose(index));
        }
        for (which, archive) in archives.iter().enumerate() {
            for (index, file) in archive.files.iter().enumerate() {
                if place::is_within(place::folder_of(file), folder) {
                    paths.push(format!("{}{file}", tops[which]));
                    places.push(Place::Inside(which, index));
                }
            }
        }
        if places.len() == loose.len() {
            return Ok(Err(files));
        }
        check_pictures(&archives, &paths)?;
        let whole = match is_alone {
            true => archives[0].name.clone(),
            false => "the given files".to_owned(),
        };
        let capture = place::capture(&whole, &paths)?;
        let elsewhere = capture.elsewhere.iter().map(|&index| &paths[index]);
        let mut left_out: Vec<LeftOut> = elsewhere
            .map(|path| LeftOut::new(path, LeftOutReason::OtherFolder))
            .collect();
        for (which, (archive, top)) in archives.iter().zip(&tops).enumerate() {
            let is_of_use = capture.kept.iter().any(|&index| {
                matches!(places[index], Place::Inside(one, _) if one == which)
                    && !is_helper(&paths[index])
            });
            let name = base_name(&archive.name).to_owned();
            if is_of_use {
                let folder = capture.folder.strip_prefix(top.trim_end_matches('/'));
                let folder = folder
                    .unwrap_or_default()
                    .trim_start_matches('/')
                    .to_owned();
                notices.push(match archive.is_paged() {
                    true => Notice::PagesAsPhotographs {
                        file: name,
                        pages: archive.files.len(),
                    },
                    false => Notice::FromArchive {
                        archive: name,
                        folder,
                    },
                });
            } else {
                left_out.push(LeftOut::new(&name, LeftOutReason::NotAnImage));
            }
            let links = archive.links.iter();
            left_out.extend(links.map(|path| LeftOut::new(path, LeftOutReason::Link)));
        }
        let kept = capture.kept;
        Ok(Ok(Self {
            names: kept.iter().map(|&index| paths[index].clone()).collect(),
            places: kept.iter().map(|&index| places[index]).collect(),
            loose: files,
            archives,
            said: StackPlan {
                left_out,
                notices,
                ..StackPlan::default()
            },
            whole,
        }))
    }

    /// Reads the stack.
    pub(crate) fn read(mut self, options: &ReadOptions) -> Result<StackInput, IoError> {
        let said = std::mem::take(&mut self.said);
        let whole = std::mem::take(&mut self.whole);
        Planned::of(&mut self)?
            .with(said)
            .read(Some(&whole), &mut self, options)
    }
}

impl FileSource for Packed {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn text(&mut self, index: usize) -> Result<String, IoError> {
        let limits = ReadLimits {
            most: MAX_TEXT_BYTES,
            again: true,
        };
        match self.places[index] {
            Place::Loose(index) => self.loose.text(index),
            Place::Inside(archive, file) => {
                let bytes = self.archives[archive].read(file, &limits)?;
                read_text(&self.names[index], &bytes)
            }
        }
    }

    fn take(&mut self, index: usize) -> Result<Vec<u8>, IoError> {
        let limits = ReadLimits {
            most: MAX_FILE_BYTES,
            again: false,
        };
        match self.places[index] {
            Place::Loose(index) => self.loose.take(index),
            Place::Inside(archive, file) => self.archives[archive].read(file, &limits),
        }
    }
}

/// Archives among some files.
struct Opened {
    archives: Vec<Archive>,
    /// Positions of the other files.
    loose: Vec<usize>,
    notices: Vec<Notice>,
}

impl Opened {
    fn among(files: &mut dyn LooseFiles) -> Result<Self, IoError> {
        let (mut archives, mut loose, mut notices) = (Vec::new(), Vec::new(), Vec::new());
        for index in 0..files.names().len() {
            match archive_kind(files, index)? {
                Some(kind) => {
                    notices.extend(other_extension(&files.names()[index], kind));
                    let label = files.label(index);
                    archives.push(Archive::open(&label, kind, files.open(index)?)?);
                }
                None => loose.push(index),
            }
        }
        if archives.is_empty()
            && let Some(place) = paged(files, &loose)?
        {
            let index = loose.remove(place);
            let label = files.label(index);
            let source = files.open(index)?;
            archives.push(Archive::open(&label, ArchiveKind::Pages, source)?);
        }
        Ok(Self {
            archives,
            loose,
            notices,
        })
    }
}

/// The place of the only TIFF file among some, where its pages are enough for a stack.
fn paged(files: &mut dyn LooseFiles, among: &[usize]) -> Result<Option<usize>, IoError> {
    let mut found = None;
    for (place, &index) in among.iter().enumerate() {
        if !is_helper(&files.names()[index]) && PagedTiff::may_be(&files.head(index, HEAD)?) {
            if found.is_some() {
                return Ok(None);
            }
            found = Some(place);
        }
    }
    let mut is_paged = false;
    if let Some(place) = found {
        files.look(among[place], &mut |bytes| {
            is_paged = PagedTiff::is_one(bytes)
        })?;
    }
    Ok(found.filter(|_| is_paged))
}

/// What stands before the paths of each archive's files, with a slash: its name, or the way to it
/// where two of one name would become one folder.
fn tops(archives: &[Archive]) -> Vec<String> {
    let names: BTreeSet<&str> = archives.iter().map(|one| base_name(&one.name)).collect();
    let is_clear = names.len() == archives.len();
    let top = |archive: &Archive| match is_clear {
        true => format!("{}/", base_name(&archive.name)),
        false => format!("{}/", archive.name),
    };
    archives.iter().map(top).collect()
}

/// The kind of a file that is an archive by its content.
fn archive_kind(files: &mut dyn LooseFiles, index: usize) -> Result<Option<ArchiveKind>, IoError> {
    if is_helper(&files.names()[index]) {
        return Ok(None);
    }
    let head = files.head(index, HEAD)?;
    let label = files.label(index);
    match (
        ArchiveKind::of_content(&head),
        ArchiveKind::of_extension(&label),
    ) {
        (None, Some(promised)) => Err(IoError::Archive {
            name: label,
            format: promised.label(),
            found: match head.is_empty() {
                true => "nothing in it".to_owned(),
                false => "content of another kind".to_owned(),
            },
            expected: "a complete archive: fetch or pack it again".to_owned(),
        }),
        (kind, _) => Ok(kind),
    }
}

fn other_extension(name: &str, kind: ArchiveKind) -> Option<Notice> {
    (ArchiveKind::of_extension(name) != Some(kind)).then(|| Notice::ContentOverExtension {
        file: name.to_owned(),
        content: kind.label().to_owned(),
        extension: split_extension(name).1.to_owned(),
    })
}

/// Refuses archives that hold other archives and no picture.
fn check_pictures(archives: &[Archive], paths: &[String]) -> Result<(), IoError> {
    let is_picture = |path: &String| format_of_extension(path).is_some() && !is_helper(path);
    if paths.iter().any(is_picture) {
        return Ok(());
    }
    let is_archive = |path: &&String| ArchiveKind::of_extension(path).is_some() && !is_helper(path);
    for archive in archives {
        if let Some(inner) = archive.files.iter().find(is_archive) {
            return Err(archive.holds_archive(inner));
        }
    }
    Ok(())
}

/// The files of the capture in an archive, for who wants them before the stack is read, as a page
/// that shows them; [`read_stack`](crate::read_stack) opens archives by itself. Each file is
/// unpacked when it is taken (those of a tar.gz at once).
pub struct UnpackedFiles(Packed);

impl UnpackedFiles {
    /// Opens an archive; `None` for a file that is none by its content and its extension. A TIFF whose pages are
    /// enough for a stack counts as one.
    ///
    /// # Errors
    /// [`IoError::Archive`], and [`IoError::PhotographsBelow`] for several captures.
    pub fn open(file: NamedBytes) -> Result<Option<Self>, IoError> {
        let files = Box::new(MemoryFiles::new(vec![file]));
        Ok(Packed::open(files, "")?.ok().map(Self))
    }

    /// Their paths in the archive.
    pub fn names(&self) -> &[String] {
        &self.0.names
    }

    /// What there is to say of the archive.
    pub fn notices(&self) -> &[Notice] {
        &self.0.said.notices
    }

    /// What of the archive is not among the files, and why.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.0.said.left_out
    }

    /// A file, which is handed out once.
    ///
    /// # Errors
    /// [`IoError::FileTooLarge`]; [`IoError::Archive`] for damage.
    ///
    /// # Panics
    /// An index that is none of [`UnpackedFiles::names`].
    pub fn take(&mut self, index: usize) -> Result<NamedBytes, IoError> {
        Ok(NamedBytes {
            name: self.0.names[index].clone(),
            bytes: FileSource::take(&mut self.0, index)?,
        })
    }
}

/// Whether a file may hold several photographs: an archive, by its content or its name, or a TIFF, which may have pages.
/// `head` are its first bytes, 512 of them where it has as many.
pub fn is_archive(name: &str, head: &[u8]) -> bool {
    let kind = ArchiveKind::of_content(head).or_else(|| ArchiveKind::of_extension(name));
    (kind.is_some() || PagedTiff::may_be(head)) && !is_helper(name)
}
