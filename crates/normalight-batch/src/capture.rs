//! What was found in a tree.
use normalight_io::{LeftOut, Notice, left_out_lines, notice_lines};
use std::fmt;
use std::path::{Path, PathBuf};

/// Photographs of one object.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Capture {
    /// Its path below the root; empty for the root itself.
    pub path: PathBuf,
    /// The path of its result below the output: the same, but for the root itself its name.
    pub result: PathBuf,
    /// Where the photographs are.
    pub kind: CaptureKind,
    /// How many photographs there are by the names of the files; `None` in an archive, which was not opened.
    pub photographs: Option<usize>,
    /// Files that a person might miss among the photographs, and why they are not.
    pub left_out: Vec<LeftOut>,
    /// What is doubtful about the files by their names.
    pub notices: Vec<Notice>,
}

/// Where the photographs of a capture are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CaptureKind {
    /// The files of a folder, or of an archive in it beside a mask.
    Folder,
    /// One photograph in each of several folders in a folder.
    OneInEachFolder,
    /// An archive.
    Archive,
    /// The pages of a TIFF file.
    Pages,
}

/// Something that is no capture though it looks like one, or may hold one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PassedOver {
    /// Its path below the root; empty for the root itself.
    pub path: PathBuf,
    /// Why.
    pub reason: PassedOverReason,
}

/// Why something is no capture.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum PassedOverReason {
    /// There are photographs, but too few.
    TooFew(usize),
    /// A result of this program.
    Result,
    /// A link to a folder.
    LinkToFolder,
    /// It cannot be read, as the system said.
    Unreadable(String),
}

/// The captures of a tree, in the order of their paths, and what was passed over.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Found {
    /// The captures.
    pub captures: Vec<Capture>,
    /// What is none.
    pub passed_over: Vec<PassedOver>,
    /// Number of folders that were looked at.
    pub folders: usize,
}

impl Capture {
    /// The path below the root on one line, `.` for the root itself.
    pub fn name(&self) -> String {
        name_of(&self.path)
    }
}

impl Found {
    /// In lines for people: one for each capture, with what is left out of it and what is doubtful below; then what was
    /// passed over. With `all` every file that is left out has its line.
    pub fn lines(&self, all: bool) -> Vec<String> {
        let mut lines = Vec::new();
        for capture in &self.captures {
            lines.push(capture.to_string());
            let below = left_out_lines(&capture.left_out, all)
                .into_iter()
                .chain(notice_lines(&capture.notices));
            lines.extend(below.map(|line| format!("  {line}")));
        }
        lines.extend(self.passed_over.iter().map(PassedOver::to_string));
        lines
    }
}

/// A path below the root on one line.
pub(crate) fn name_of(path: &Path) -> String {
    match path.as_os_str().is_empty() {
        true => ".".to_owned(),
        false => path
            .display()
            .to_string()
            .replace('\n', "\\n")
            .replace('\r', "\\r"),
    }
}

impl fmt::Display for Capture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.name();
        match (self.kind, self.photographs) {
            (CaptureKind::OneInEachFolder, Some(count)) => {
                write!(f, "{name}: {count} photographs, one in each folder")
            }
            (CaptureKind::Pages, Some(count)) => {
                write!(f, "{name}: {count} photographs, the pages of a file")
            }
            (_, Some(count)) => write!(f, "{name}: {count} photographs"),
            (CaptureKind::Folder, None) => write!(f, "{name}: an archive beside its mask"),
            (_, None) => write!(f, "{name}: an archive"),
        }
    }
}

impl fmt::Display for PassedOver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", name_of(&self.path), self.reason)
    }
}

impl fmt::Display for PassedOverReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew(count) => write!(
                f,
                "no capture: {count} photograph(s), at least {} are needed",
                normalight_core::MIN_IMAGES
            ),
            Self::Result => f.write_str("no capture: a result of this program"),
            Self::LinkToFolder => f.write_str("a link to a folder, not followed"),
            Self::Unreadable(reason) => write!(f, "cannot be looked at: {reason}"),
        }
    }
}
