//! Zip archives.
use super::name::shown;
use super::{Content, Fault, Listing, ReadLimits, Source, Unread, check_count, unpacked_limit};
use crate::plan::is_helper;
use std::io::{Read, Seek, SeekFrom};
use zip::CompressionMethod;
use zip::ZipArchive;
use zip::read::ZipFileEntry;
use zip::result::ZipError;

/// The files of a zip archive; each is unpacked when it is asked for.
struct Zip {
    archive: ZipArchive<Box<dyn Source>>,
    /// Place in the archive and size of each file.
    places: Vec<(usize, u64)>,
}

pub(super) fn open(
    mut source: Box<dyn Source>,
    length: u64,
) -> Result<(Listing, Box<dyn Content>), Fault> {
    check_zip64_count(&mut source, length)?;
    let archive = ZipArchive::new(source).map_err(|error| fault(&error))?;
    if archive.has_duplicate_names() {
        return Err(Fault::new("two files of one name", "each name once"));
    }
    let (mut listing, mut places) = (Listing::default(), Vec::new());
    let (limit, mut total) = (unpacked_limit(length), 0u64);
    for index in 0..archive.len() {
        let entry = archive
            .by_index_data(index)
            .map_err(|error| fault(&error))?;
        let name = entry.name().map_err(|error| fault(&error))?;
        let path = listing.path(&name)?;
        if entry.is_dir() {
            continue;
        }
        if entry.is_symlink() {
            listing.links.push(path);
            continue;
        }
        if !is_helper(&path) {
            check_readable(&entry, &path)?;
        }
        // Their sum, as entries may share their bytes.
        total = total.saturating_add(entry.size());
        if total > limit {
            return Err(Fault::too_much(limit));
        }
        places.push((index, entry.size()));
        listing.files.push(path);
    }
    Ok((listing, Box::new(Zip { archive, places })))
}

fn check_readable(entry: &ZipFileEntry<'_>, path: &str) -> Result<(), Fault> {
    if entry.encrypted() {
        return Err(Fault::new(
            format!("an encrypted file ({})", shown(path)),
            "files without a password: unpack it and give the folder",
        ));
    }
    let method = entry.compression();
    if matches!(
        method,
        CompressionMethod::Stored | CompressionMethod::Deflated
    ) {
        return Ok(());
    }
    Err(Fault::new(
        match method.to_string().as_str() {
            "Unknown" => format!("a file ({}) compressed in an unknown way", shown(path)),
            method => format!("a file ({}) compressed by {method}", shown(path)),
        },
        "files that are stored or deflated: unpack it and give the folder",
    ))
}

impl Content for Zip {
    fn read(&mut self, index: usize, limits: &ReadLimits) -> Result<Vec<u8>, Unread> {
        let (place, size) = self.places[index];
        if size > limits.most {
            return Err(Unread::TooLarge(size));
        }
        let mut file = self
            .archive
            .by_index(place)
            .map_err(|error| fault(&error))?;
        // The sizes of all files together are within the limit.
        let mut bytes = Vec::with_capacity(size as usize);
        let read = file.by_ref().take(size + 1).read_to_end(&mut bytes);
        match read {
            Ok(found) if found as u64 == size => Ok(bytes),
            Ok(found) => Err(Fault::damage(format!("{found} bytes instead of {size}")).into()),
            Err(reason) => Err(Fault::damage(reason).into()),
        }
    }
}

fn fault(error: &ZipError) -> Fault {
    match error {
        ZipError::UnsupportedArchive(reason) => Fault::new(
            format!("what is not read ({reason})"),
            "an archive in one part, stored or deflated",
        ),
        ZipError::InvalidArchive(reason) => Fault::damage(reason),
        ZipError::Io(reason) => Fault::damage(reason),
        other => Fault::damage(other),
    }
}

/// Refuses an archive whose zip64 record says that it holds too many files, before anything is
/// allocated for them (APPNOTE.TXT 6.3.10 of PKWARE, 4.3.14). Without such a record it is at most
/// 65,535, which are counted when they are listed.
fn check_zip64_count(source: &mut Box<dyn Source>, length: u64) -> Result<(), Fault> {
    /// The last record, the largest comment after it, and those of zip64 before it.
    const TAIL: u64 = 22 + 0xFFFF + 20 + 56;
    let mut tail = Vec::new();
    source
        .seek(SeekFrom::Start(length.saturating_sub(TAIL)))
        .and_then(|_| source.take(TAIL).read_to_end(&mut tail))
        .and_then(|_| source.rewind())
        .map_err(Fault::damage)?;
    for (at, mark) in tail.windows(4).enumerate() {
        if mark == b"PK\x06\x06"
            && let Some(&count) = tail[at..].get(32..).and_then(|rest| rest.first_chunk())
        {
            check_count(u64::from_le_bytes(count))?;
        }
    }
    Ok(())
}
