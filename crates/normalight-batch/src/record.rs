//! What a result was made of, kept beside it.
use crate::inputs::{Contents, InputFile, Listing, hex};
use crate::{BatchError, BatchSettings};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs;
use std::io::{self, Read};
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// Its name in a result folder. It comes last.
pub(crate) const RECORD: &str = "batch.json";

/// The estimate's own report in a result folder.
pub(crate) const REPORT: &str = "report.json";

/// The form in which this program writes records; those of another form are of no use.
const FORMAT: u32 = 1;

/// Most bytes of a record or report that are read: names of as many files as a capture may have.
const MOST: u64 = 64 << 20;

/// What a result was made of: `batch.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Record {
    format: u32,
    /// Path of the capture below the root.
    pub(crate) capture: String,
    /// Version of the program.
    pub(crate) program: String,
    /// Its arguments.
    pub(crate) arguments: Vec<String>,
    /// Hash of version, arguments and the files they name, in hexadecimal.
    pub(crate) settings: String,
    /// When the inputs were read, in nanoseconds since 1970.
    pub(crate) read: u64,
    /// The files that the estimate could look at.
    pub(crate) inputs: Vec<InputFile>,
    /// Hash of their names and contents, in hexadecimal.
    pub(crate) contents: String,
    /// Seconds that the job took.
    pub(crate) seconds: f64,
    /// Names and sizes of the files of the result, without this one.
    pub(crate) files: Vec<(String, u64)>,
}

/// Version, arguments and the files they name, as they stand in each record.
#[derive(Debug, Clone)]
pub(crate) struct Asked {
    program: String,
    arguments: Vec<String>,
    hash: String,
}

impl Asked {
    /// Reads the files that the arguments name.
    ///
    /// # Errors
    /// [`BatchError::Read`].
    pub(crate) fn of(settings: &BatchSettings) -> Result<Self, BatchError> {
        let program = &settings.program;
        let failed = |path, reason| BatchError::Read { path, reason };
        let files = Listing::of_files(&program.files)
            .map_err(|reason| failed(program.files.first().cloned().unwrap_or_default(), reason))?;
        let contents = files
            .read(&AtomicBool::new(false))
            .map_err(|(path, reason)| failed(path, reason))?;
        let mut hash = Sha256::new();
        let mut add = |bytes: &[u8]| {
            hash.update((bytes.len() as u64).to_le_bytes());
            hash.update(bytes);
        };
        add(program.version.as_bytes());
        for argument in &program.arguments {
            add(argument.as_encoded_bytes());
        }
        add(contents.map_or(String::new(), |(_, all)| all).as_bytes());
        Ok(Self {
            program: program.version.clone(),
            arguments: program
                .arguments
                .iter()
                .map(|argument| argument.to_string_lossy().into_owned())
                .collect(),
            hash: hex(&hash.finalize()),
        })
    }

    /// A record of a result that begins to be made; its files and seconds are not known yet.
    pub(crate) fn record(
        &self,
        capture: String,
        (inputs, contents): Contents,
        read: u64,
    ) -> Record {
        Record {
            format: FORMAT,
            capture,
            program: self.program.clone(),
            arguments: self.arguments.clone(),
            settings: self.hash.clone(),
            read,
            inputs,
            contents,
            seconds: 0.0,
            files: Vec::new(),
        }
    }
}

impl Record {
    /// The record in a result folder; `None` where there is none that can be understood.
    pub(crate) fn of(folder: &Path) -> Option<Self> {
        let bytes = bytes(&folder.join(RECORD)).ok()?;
        let record: Self = serde_json::from_slice(&bytes).ok()?;
        (record.format == FORMAT).then_some(record)
    }

    /// Whether it was made as it would be now, and all of it is there. Of the photographs this says nothing.
    pub(crate) fn stands(&self, folder: &Path, capture: &str, asked: &Asked) -> bool {
        self.settings == asked.hash
            && self.capture == capture
            && self.files.iter().any(|(name, _)| name == REPORT)
            && self.files.iter().all(|(name, size)| {
                fs::metadata(folder.join(name)).is_ok_and(|data| data.len() == *size)
            })
    }

    /// As a file.
    ///
    /// # Errors
    /// None that is known: all of it is text and numbers.
    pub(crate) fn to_json(&self) -> io::Result<Vec<u8>> {
        let mut bytes = serde_json::to_vec_pretty(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}

/// The bytes of a record or report.
///
/// # Errors
/// A file that cannot be read, or is larger than any of ours.
pub(crate) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let count = fs::File::open(path)?.take(MOST).read_to_end(&mut bytes)?;
    match count as u64 == MOST {
        true => Err(io::ErrorKind::FileTooLarge.into()),
        false => Ok(bytes),
    }
}
