//! The files a result is made of, and whether they are still the same.
use crate::CaptureKind;
use normalight_io::is_helper;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};

/// Times within which a file system may not tell two changes apart: two seconds on FAT.
const COARSE: u64 = 2_000_000_000;

/// What the file system says of a file without reading it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Stamp {
    pub(crate) bytes: u64,
    /// When the content was changed, in nanoseconds since 1970.
    modified: u64,
    /// When anything about the file was changed, which no program sets at will; 0 where that is not known.
    changed: u64,
}

/// A file as it was when a result was made of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct InputFile {
    /// Its path below the capture, where that is text.
    pub(crate) name: String,
    pub(crate) stamp: Stamp,
    /// SHA-256 of its content, in hexadecimal.
    pub(crate) sha256: String,
}

/// Each of some files, and the hash of all their names and contents in hexadecimal.
pub(crate) type Contents = (Vec<InputFile>, String);

/// The files of a capture as they are now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Listing {
    folder: PathBuf,
    /// Paths below the folder in the order of their bytes, and what is known of them.
    files: Vec<(PathBuf, Stamp)>,
}

impl Stamp {
    pub(crate) fn of(data: &Metadata) -> Self {
        Self {
            bytes: data.len(),
            modified: data.modified().map_or(0, nanoseconds),
            changed: changed(data),
        }
    }

    /// Whether a change after this time, in nanoseconds since 1970, would show.
    fn is_before(&self, time: u64) -> bool {
        self.modified.max(self.changed).saturating_add(COARSE) < time
    }
}

#[cfg(unix)]
fn changed(data: &Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt;
    let part = |value: i64| u64::try_from(value).unwrap_or(0);
    part(data.ctime())
        .saturating_mul(1_000_000_000)
        .saturating_add(part(data.ctime_nsec()))
}

#[cfg(not(unix))]
fn changed(_data: &Metadata) -> u64 {
    0
}

/// Nanoseconds since 1970.
pub(crate) fn now() -> u64 {
    nanoseconds(SystemTime::now())
}

fn nanoseconds(time: SystemTime) -> u64 {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_nanos()).unwrap_or(u64::MAX)
}

impl Listing {
    /// All files that the estimate of a capture may look at.
    ///
    /// # Errors
    /// A file or folder that cannot be read.
    pub(crate) fn of(place: &Path, kind: CaptureKind) -> io::Result<Self> {
        let mut files = Vec::new();
        let folder = match kind {
            CaptureKind::Archive | CaptureKind::Pages => {
                let name = place.file_name().ok_or(io::ErrorKind::InvalidInput)?;
                files.push((PathBuf::from(name), Stamp::of(&fs::metadata(place)?)));
                place.parent().unwrap_or(place)
            }
            CaptureKind::Folder | CaptureKind::OneInEachFolder => {
                let below = list_into(place, Path::new(""), &mut files)?;
                if kind == CaptureKind::OneInEachFolder {
                    for name in below {
                        list_into(&place.join(&name), &name, &mut files)?;
                    }
                }
                place
            }
        };
        files.sort_by(|(a, _), (b, _)| a.as_os_str().cmp(b.as_os_str()));
        Ok(Self {
            folder: folder.to_owned(),
            files,
        })
    }

    /// Files by themselves, as they were named.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(crate) fn of_files(paths: &[PathBuf]) -> io::Result<Self> {
        let stamped = |path: &PathBuf| Ok((path.clone(), Stamp::of(&fs::metadata(path)?)));
        Ok(Self {
            folder: PathBuf::new(),
            files: paths.iter().map(stamped).collect::<io::Result<_>>()?,
        })
    }

    /// Bytes of all files.
    pub(crate) fn bytes(&self) -> u64 {
        self.files.iter().map(|(_, stamp)| stamp.bytes).sum()
    }

    /// Full paths of the files, the largest first: a photograph more likely than a preview or a mask.
    pub(crate) fn largest_first(&self) -> impl Iterator<Item = PathBuf> {
        let mut files: Vec<&(PathBuf, Stamp)> = self.files.iter().collect();
        files.sort_by_key(|(_, stamp)| std::cmp::Reverse(stamp.bytes));
        files.into_iter().map(|(name, _)| self.folder.join(name))
    }

    /// Whether these are the files of a result, by what the file system says; `read` is when they were read, in nanoseconds
    /// since 1970. False does not say that they are others.
    pub(crate) fn looks_like(&self, before: &[InputFile], read: u64) -> bool {
        self.files.len() == before.len()
            && self
                .files
                .iter()
                .zip(before)
                .all(|((name, stamp), before)| {
                    *stamp == before.stamp && stamp.is_before(read) && text(name) == before.name
                })
    }

    /// Reads all files: what is to be kept of each, and the hash of all names and contents; `None` once `stop` is set.
    ///
    /// # Errors
    /// A file that cannot be read, with its path.
    pub(crate) fn read(&self, stop: &AtomicBool) -> Result<Option<Contents>, (PathBuf, io::Error)> {
        let mut all = Sha256::new();
        let mut files = Vec::with_capacity(self.files.len());
        for (name, stamp) in &self.files {
            let path = self.folder.join(name);
            let content = match content(&path, stop) {
                Ok(Some(content)) => content,
                Ok(None) => return Ok(None),
                Err(reason) => return Err((path, reason)),
            };
            let bytes = name.as_os_str().as_encoded_bytes();
            all.update((bytes.len() as u64).to_le_bytes());
            all.update(bytes);
            all.update(&content);
            files.push(InputFile {
                name: text(name),
                stamp: *stamp,
                sha256: content,
            });
        }
        Ok(Some((files, hex(&all.finalize()))))
    }
}

/// Lists the files of a folder below `name`; the folders in it.
fn list_into(
    folder: &Path,
    name: &Path,
    files: &mut Vec<(PathBuf, Stamp)>,
) -> io::Result<Vec<PathBuf>> {
    let mut folders = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = name.join(entry.file_name());
        if is_helper(&entry.file_name().to_string_lossy()) {
            // A system may write those whenever somebody looks.
            continue;
        }
        if entry.file_type()?.is_dir() {
            folders.push(path);
        } else if let Ok(data) = fs::metadata(entry.path())
            && data.is_file()
        {
            files.push((path, Stamp::of(&data)));
        }
    }
    Ok(folders)
}

/// SHA-256 of a file's content, in hexadecimal.
fn content(path: &Path, stop: &AtomicBool) -> io::Result<Option<String>> {
    let (mut file, mut hash) = (File::open(path)?, Sha256::new());
    let mut piece = vec![0; 1 << 20];
    loop {
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        match file.read(&mut piece)? {
            0 => return Ok(Some(hex(&hash.finalize()))),
            count => hash.update(&piece[..count]),
        }
    }
}

pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn text(name: &Path) -> String {
    name.to_string_lossy().into_owned()
}
