//! A page under a directory that says no more than how to unpack it.
//!
//! The library's decoder hands out only the channels of colours that it knows, and then undoes
//! differences and byte orders over the wrong number of channels: extra channels beside a predictor
//! come out garbled, and so do extra channels in tiles of another byte order. What it is told here
//! is always so many equal channels of grey in one plane; what they mean is decided by [`super::colors`]. The
//! same way leads past it Zstandard and reversed bits, which it does not know, and LZW.
use super::directory::Directory;
use super::layout::{Kind, Layout, Place, bytes};
use super::new_directory::NewDirectory;
use super::tags::{self, compression};
use crate::IoError;
use crate::decode::source::Source;
use std::io::{self, Read, Seek, SeekFrom};

/// The bytes of a file with another header and with more at the end.
pub(super) struct Bare<'a> {
    head: Vec<u8>,
    body: &'a [u8],
    tail: Vec<u8>,
    at: u64,
}

impl<'a> Bare<'a> {
    /// # Errors
    /// Damaged LZW or Zstandard, or more of it than the limits grant.
    pub(super) fn new(
        source: &Source<'a>,
        page: &Directory<'a>,
        layout: &Layout,
    ) -> Result<Self, IoError> {
        let file = page.file;
        let mut tail = Vec::new();
        let mut places = layout.places.clone();
        let mut method = layout.compression;
        let reversed = layout.reversed && method != compression::JPEG;
        let ours = matches!(method, compression::ZSTANDARD | compression::LZW);
        if ours || reversed {
            for (chunk, place) in places.iter_mut().enumerate() {
                let stored = bytes(file.bytes, *place).unwrap_or_default();
                let start = tail.len();
                match reversed {
                    true => {
                        let turned: Vec<u8> = stored.iter().map(|b| b.reverse_bits()).collect();
                        unpack(source, layout, chunk, &turned, &mut tail)?;
                    }
                    false => unpack(source, layout, chunk, stored, &mut tail)?,
                }
                *place = Place {
                    start: (file.bytes.len() + start) as u64,
                    length: (tail.len() - start) as u64,
                };
            }
            if ours {
                method = compression::NONE;
            }
        }
        if tail.len() % 2 == 1 {
            tail.push(0);
        }
        let mut directory = NewDirectory::beside(&file);
        fill(&mut directory, layout, &places, method);
        if let Some(tables) = page.bytes(tags::JPEG_TABLES) {
            directory.set_bytes(tags::JPEG_TABLES, tables);
        }
        let start = file.bytes.len() as u64 + tail.len() as u64;
        let place = directory.write(start, &mut tail);
        if !file.big && place > u64::from(u32::MAX) {
            return Err(source.too_much_memory());
        }
        let mut head = file.bytes[..if file.big { 8 } else { 4 }].to_vec();
        head.extend(directory.word(place));
        Ok(Self {
            head,
            body: file.bytes,
            tail,
            at: 0,
        })
    }

    fn rest(&self) -> &[u8] {
        let Ok(at) = usize::try_from(self.at) else {
            return &[];
        };
        match at {
            at if at < self.head.len() => &self.head[at..],
            at if at < self.body.len() => &self.body[at..],
            at => self.tail.get(at - self.body.len()..).unwrap_or_default(),
        }
    }
}

impl Read for Bare<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let rest = self.rest();
        let count = rest.len().min(to.len());
        to[..count].copy_from_slice(&rest[..count]);
        self.at += count as u64;
        Ok(count)
    }
}

impl Seek for Bare<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let end = (self.body.len() + self.tail.len()) as u64;
        let at = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::End(by) => end.checked_add_signed(by),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
        };
        self.at = at.ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.at)
    }
}

/// Appends the content of a chunk, without LZW and Zstandard.
fn unpack(
    source: &Source,
    layout: &Layout,
    chunk: usize,
    stored: &[u8],
    tail: &mut Vec<u8>,
) -> Result<(), IoError> {
    let expected = layout.row_bytes() * layout.rows(chunk);
    let start = tail.len();
    if start as u64 + expected > source.limits.decode_bytes() {
        return Err(source.too_much_memory());
    }
    let unpacked = match layout.compression {
        compression::ZSTANDARD => unpack_zstandard(stored, expected, tail),
        compression::LZW => unpack_lzw(stored, expected as usize, tail),
        _ => {
            tail.extend_from_slice(stored);
            return Ok(());
        }
    };
    let found = (tail.len() - start) as u64;
    let reason = match unpacked {
        Ok(()) if found == expected => return Ok(()),
        Ok(()) => format!("{found} bytes instead of {expected}"),
        Err(reason) => reason,
    };
    let name = compression::name(layout.compression);
    Err(source.damaged(format!("{name} of strip or tile {}: {reason}", chunk + 1)))
}

fn unpack_zstandard(stored: &[u8], expected: u64, tail: &mut Vec<u8>) -> Result<(), String> {
    let decoder = ruzstd::decoding::StreamingDecoder::new(stored);
    let decoder = decoder.map_err(|error| error.to_string())?;
    let read = decoder.take(expected).read_to_end(tail);
    read.map(|_| ()).map_err(|error| error.to_string())
}

/// The library fails on tiles whose last code ends within a row of padding.
fn unpack_lzw(stored: &[u8], expected: usize, tail: &mut Vec<u8>) -> Result<(), String> {
    let start = tail.len();
    tail.resize(start + expected, 0);
    let mut decoder = weezl::decode::Configuration::with_tiff_size_switch(weezl::BitOrder::Msb, 8)
        .with_yield_on_full_buffer(true)
        .build();
    let (mut read, mut written) = (0, 0);
    while written < expected {
        let step = decoder.decode_bytes(&stored[read..], &mut tail[start + written..]);
        read += step.consumed_in;
        written += step.consumed_out;
        match step.status {
            Ok(weezl::LzwStatus::Ok) if step.consumed_in + step.consumed_out > 0 => {}
            Ok(_) => break,
            Err(error) => return Err(error.to_string()),
        }
    }
    tail.truncate(start + written);
    Ok(())
}

/// What the decoder is told.
fn fill(directory: &mut NewDirectory, layout: &Layout, places: &[Place], method: u64) {
    // Rows of 9 to 15 bits are unpacked here: the decoder reads them as bytes.
    let packed = matches!(layout.bits, 9..=15);
    let bytes = |pixels: u32, channels: usize| {
        (u64::from(pixels) * channels as u64 * u64::from(layout.bits)).div_ceil(8)
    };
    let (width, chunk_width, bits, samples) = match packed {
        false => {
            let (width, chunk) = (u64::from(layout.width), u64::from(layout.chunk.0));
            (width, chunk, u64::from(layout.bits), layout.samples)
        }
        true => {
            let woven = layout.samples;
            let (width, chunk) = (bytes(layout.width, woven), bytes(layout.chunk.0, woven));
            (width, chunk, 8, 1)
        }
    };
    let float = layout.kind == Kind::Float;
    let (offsets, lengths) = match layout.tiled {
        true => (tags::TILE_OFFSETS, tags::TILE_BYTES),
        false => (tags::STRIP_OFFSETS, tags::STRIP_BYTES),
    };
    directory.set(tags::WIDTH, &[width]);
    directory.set(tags::HEIGHT, &[u64::from(layout.height)]);
    directory.set(tags::BITS, &[bits]);
    directory.set(tags::COMPRESSION, &[method]);
    directory.set(tags::PHOTOMETRIC, &[tags::photometric::BLACK_IS_ZERO]);
    directory.set(tags::SAMPLES, &[samples as u64]);
    directory.set(tags::PREDICTOR, &[layout.predictor]);
    directory.set(tags::SAMPLE_FORMAT, &[if float { 3 } else { 1 }]);
    match layout.tiled {
        true => {
            directory.set(tags::TILE_WIDTH, &[chunk_width]);
            directory.set(tags::TILE_HEIGHT, &[u64::from(layout.chunk.1)]);
        }
        false => directory.set(tags::ROWS_PER_STRIP, &[u64::from(layout.chunk.1)]),
    }
    let list = |value: fn(&Place) -> u64| places.iter().map(value).collect::<Vec<_>>();
    directory.set(offsets, &list(|place| place.start));
    directory.set(lengths, &list(|place| place.length));
}
