//! Tar archives, plain and within gzip.
use super::kind::{HEAD, is_tar};
use super::name::shown;
use super::{Content, Fault, Listing, ReadLimits, Source, Unread, unpacked_limit};
use crate::limits::MAX_TAR_HEADER_BYTES;
use flate2::read::MultiGzDecoder;
use std::cell::Cell;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::rc::Rc;
use tar::{Archive, Entries, Entry};

/// The files of a plain tar archive: where each lies.
struct Places {
    source: Box<dyn Source>,
    /// First byte and size.
    places: Vec<(u64, u64)>,
}

/// The files of a tar archive that could only be read from its beginning.
struct Unpacked(Vec<Vec<u8>>);

/// Lists a plain tar archive of `length` bytes; its files are read when they are asked for.
pub(super) fn open(
    mut source: Box<dyn Source>,
    length: u64,
) -> Result<(Listing, Box<dyn Content>), Fault> {
    let meter = Meter::new(u64::MAX);
    let mut places = Vec::new();
    let metered = Metered::new(&mut source, &meter);
    let mut archive = Archive::new(metered);
    let entries = archive.entries_with_seek().map_err(Fault::damage)?;
    let listing = list(entries, &meter, |entry| {
        let (start, size) = (entry.raw_file_position(), entry.size());
        if start.checked_add(size).is_none_or(|end| end > length) {
            return Err(Fault::damage("its last file goes beyond its end"));
        }
        places.push((start, size));
        Ok(())
    })?;
    Ok((listing, Box::new(Places { source, places })))
}

/// Unpacks a tar archive within gzip of `length` bytes into memory.
pub(super) fn unpack(
    mut source: Box<dyn Source>,
    length: u64,
) -> Result<(Listing, Box<dyn Content>), Fault> {
    let mut head = Vec::new();
    let peeked = MultiGzDecoder::new(BufReader::new(&mut source))
        .take(HEAD as u64)
        .read_to_end(&mut head);
    // An archive of nothing begins with its end mark, and damage will be met again.
    let is_blank = head.len() == HEAD && head.iter().all(|&byte| byte == 0);
    if peeked.is_ok() && !is_tar(&head) && !is_blank {
        return Err(Fault::new(
            "another file inside",
            "a tar archive within gzip",
        ));
    }
    source.rewind().map_err(Fault::damage)?;
    let limit = unpacked_limit(length);
    let meter = Meter::new(limit);
    let mut contents = Vec::new();
    let decoder = MultiGzDecoder::new(BufReader::new(source));
    let mut archive = Archive::new(Metered::new(decoder, &meter));
    let entries = archive.entries().map_err(Fault::damage)?;
    let listing = list(entries, &meter, |entry| {
        let size = entry.size();
        if size > limit - meter.total.get() {
            return Err(Fault::too_much(limit));
        }
        let mut bytes = Vec::with_capacity(size as usize);
        entry
            .read_to_end(&mut bytes)
            .map_err(|reason| meter.fault(&reason))?;
        if bytes.len() as u64 != size {
            return Err(Fault::damage("its last file is not whole"));
        }
        contents.push(bytes);
        Ok(())
    })?;
    // Behind the last file stands the check sum of all.
    meter.left.set(u64::MAX);
    io::copy(&mut archive.into_inner(), &mut io::sink()).map_err(|reason| meter.fault(&reason))?;
    Ok((listing, Box::new(Unpacked(contents))))
}

/// The files among the entries; `keep` takes each, in order.
fn list<R: Read>(
    mut entries: Entries<'_, R>,
    meter: &Meter,
    mut keep: impl FnMut(&mut Entry<'_, R>) -> Result<(), Fault>,
) -> Result<Listing, Fault> {
    let mut listing = Listing::default();
    loop {
        meter.left.set(MAX_TAR_HEADER_BYTES);
        let Some(entry) = entries.next() else { break };
        let mut entry = entry.map_err(|reason| meter.fault(&reason))?;
        meter.left.set(u64::MAX);
        let path = listing.path(&name(&entry.path_bytes()))?;
        let kind = entry.header().entry_type();
        if kind.is_symlink() || kind.is_hard_link() {
            listing.links.push(path);
        } else if kind.is_gnu_sparse() || has_holes(&mut entry) {
            return Err(Fault::new(
                format!("a file with holes ({})", shown(&path)),
                "whole files: pack it without the option for sparse files",
            ));
        } else if (kind.is_file() || kind.is_contiguous()) && !path.is_empty() {
            keep(&mut entry)?;
            listing.files.push(path);
        }
    }
    if meter.ended.get() {
        return Err(Fault::damage("it has no end mark"));
    }
    Ok(listing)
}

/// Whether a file is stored with the holes of POSIX archives by GNU, which are not filled here.
fn has_holes<R: Read>(entry: &mut Entry<'_, R>) -> bool {
    let extensions = entry.pax_extensions().ok().flatten();
    extensions.is_some_and(|mut all| {
        all.any(|one| one.is_ok_and(|one| one.key_bytes().starts_with(b"GNU.sparse.")))
    })
}

/// UTF-8, else Latin-1: every byte is a letter there.
fn name(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(name) => name.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

impl Content for Places {
    fn read(&mut self, index: usize, limits: &ReadLimits) -> Result<Vec<u8>, Unread> {
        let (start, size) = self.places[index];
        if size > limits.most {
            return Err(Unread::TooLarge(size));
        }
        // It lies within the archive, as was seen.
        let mut bytes = vec![0; size as usize];
        self.source
            .seek(SeekFrom::Start(start))
            .and_then(|_| self.source.read_exact(&mut bytes))
            .map_err(Fault::damage)?;
        Ok(bytes)
    }
}

impl Content for Unpacked {
    fn read(&mut self, index: usize, limits: &ReadLimits) -> Result<Vec<u8>, Unread> {
        let bytes = &mut self.0[index];
        if bytes.len() as u64 > limits.most {
            return Err(Unread::TooLarge(bytes.len() as u64));
        }
        Ok(match limits.again {
            true => bytes.clone(),
            false => std::mem::take(bytes),
        })
    }
}

/// What was read so far, and may still be.
struct Meter {
    /// Most bytes in all.
    limit: u64,
    total: Cell<u64>,
    /// Bytes until the next file must have been found.
    left: Cell<u64>,
    /// The end of the bytes was met.
    ended: Cell<bool>,
    /// More than the limit was wanted.
    exceeded: Cell<bool>,
}

impl Meter {
    fn new(limit: u64) -> Rc<Self> {
        Rc::new(Self {
            limit,
            total: Cell::new(0),
            left: Cell::new(u64::MAX),
            ended: Cell::new(false),
            exceeded: Cell::new(false),
        })
    }

    fn fault(&self, reason: &io::Error) -> Fault {
        match self.exceeded.get() {
            true => Fault::too_much(self.limit),
            false => Fault::damage(reason),
        }
    }
}

/// A reader that keeps to its meter.
struct Metered<R> {
    reader: R,
    meter: Rc<Meter>,
}

impl<R> Metered<R> {
    fn new(reader: R, meter: &Rc<Meter>) -> Self {
        Self {
            reader,
            meter: Rc::clone(meter),
        }
    }
}

impl<R: Read> Read for Metered<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let meter = &self.meter;
        let read = self.reader.read(buffer)?;
        meter
            .ended
            .set(meter.ended.get() || (read == 0 && !buffer.is_empty()));
        meter.total.set(meter.total.get() + read as u64);
        if meter.total.get() > meter.limit {
            meter.exceeded.set(true);
            return Err(io::Error::other("more bytes than are unpacked"));
        }
        let left = meter.left.get().checked_sub(read as u64);
        meter.left.set(left.unwrap_or(0));
        match left {
            Some(_) => Ok(read),
            None => Err(io::Error::other("headers of unusual length")),
        }
    }
}

impl<R: Seek> Seek for Metered<R> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.reader.seek(to)
    }
}
