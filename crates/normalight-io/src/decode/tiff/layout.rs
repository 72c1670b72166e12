//! How the samples of a page lie in its file.
use super::directory::Directory;
use super::tags::{self, compression};
use crate::IoError;
use crate::decode::jpeg::marks;
use crate::decode::source::Source;

const EXPORT: &str = "export it as grey or RGB of 8 or 16 bits, uncompressed or with LZW";

/// How the samples of a page lie in its file; checked, so that what is read cannot be garbled.
pub(super) struct Layout {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Bits of a sample: 1 to 16, 32 or 64.
    pub(super) bits: u8,
    /// Channels, extra ones included.
    pub(super) samples: usize,
    pub(super) kind: Kind,
    /// Channels lie apart.
    pub(super) planar: bool,
    pub(super) compression: u64,
    pub(super) predictor: u64,
    /// Bits of a byte are in the other order.
    pub(super) reversed: bool,
    /// Size of the tiles, or of the strips.
    pub(super) chunk: (u32, u32),
    pub(super) tiled: bool,
    /// Where in the file each tile or strip lies.
    pub(super) places: Vec<Place>,
}

/// How numbers are coded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Unsigned,
    Signed,
    Float,
}

#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) start: u64,
    pub(super) length: u64,
}

impl Layout {
    /// # Errors
    /// Anything that the file contradicts itself in, and what is not read, by its name.
    pub(super) fn new(source: &Source, page: &Directory) -> Result<Self, IoError> {
        let short = |tag| page.one(tag).and_then(|value| u32::try_from(value).ok());
        let (Some(width), Some(height)) = (short(tags::WIDTH), short(tags::HEIGHT)) else {
            return Err(source.damaged("it does not say its size"));
        };
        source.check_size(width, height)?;
        let tiled = page.has(tags::TILE_OFFSETS);
        let chunk = match tiled {
            true => (short(tags::TILE_WIDTH), short(tags::TILE_HEIGHT)),
            false => (Some(width), short(tags::ROWS_PER_STRIP).or(Some(height))),
        };
        let (Some(wide), Some(high)) = chunk else {
            return Err(source.damaged("it does not say the size of its tiles"));
        };
        let high = if tiled { high } else { high.min(height) };
        source.check_size(wide, high)?;
        let samples = page.one(tags::SAMPLES).unwrap_or(1);
        if samples == 0 || samples > 1024 {
            return Err(source.damaged(format!("it has {samples} channels")));
        }
        let layout = Self {
            width,
            height,
            bits: bits(source, page)?,
            samples: samples as usize,
            kind: kind(source, page)?,
            planar: samples > 1 && page.one(tags::PLANAR) == Some(2),
            compression: page.one(tags::COMPRESSION).unwrap_or(compression::NONE),
            predictor: page.one(tags::PREDICTOR).unwrap_or(1),
            reversed: page.one(tags::FILL_ORDER) == Some(2),
            chunk: (wide, high),
            tiled,
            places: places(source, page, tiled)?,
        };
        layout.check(source)?;
        Ok(layout)
    }

    /// One plane of those that lie apart.
    pub(super) fn plane(&self, plane: usize) -> Self {
        let count = self.places.len() / self.samples;
        let first = plane * count;
        Self {
            samples: 1,
            planar: false,
            places: self.places[first..first + count].to_vec(),
            ..*self
        }
    }

    /// Channels that lie together in one chunk.
    pub(super) fn woven(&self) -> usize {
        if self.planar { 1 } else { self.samples }
    }

    /// Bytes of one row of a chunk; rows begin with a byte.
    pub(super) fn row_bytes(&self) -> u64 {
        let bits = u64::from(self.chunk.0) * u64::from(self.bits) * self.woven() as u64;
        bits.div_ceil(8)
    }

    /// Rows that the chunk must have: strips end with the picture, tiles reach beyond.
    pub(super) fn rows(&self, chunk: usize) -> u64 {
        let down = self.height.div_ceil(self.chunk.1) as usize;
        let first = (chunk % down) as u64 * u64::from(self.chunk.1);
        match self.tiled {
            true => u64::from(self.chunk.1),
            false => u64::from(self.chunk.1).min(u64::from(self.height) - first),
        }
    }

    fn check(&self, source: &Source) -> Result<(), IoError> {
        if !compression::READ.contains(&self.compression) {
            return Err(source.unread(compression::name(self.compression), EXPORT));
        }
        let whole = matches!(self.bits, 8 | 16 | 32 | 64);
        let coded = match self.kind {
            Kind::Unsigned => whole || self.bits < 16,
            Kind::Signed => whole,
            Kind::Float => whole && self.bits > 8,
        };
        if !coded {
            let kind = match self.kind {
                Kind::Float => "floating-point ",
                Kind::Signed => "signed ",
                Kind::Unsigned => "",
            };
            return Err(source.unread(format!("{kind}samples of {} bits", self.bits), EXPORT));
        }
        let differences = match self.predictor {
            1 => true,
            2 => whole,
            3 => self.kind == Kind::Float,
            _ => false,
        };
        if !differences {
            let found = format!("predictor {} over {} bits", self.predictor, self.bits);
            return Err(source.unread(found, EXPORT));
        }
        let across = self.width.div_ceil(self.chunk.0) as usize;
        let down = self.height.div_ceil(self.chunk.1) as usize;
        let expected = across * down * if self.planar { self.samples } else { 1 };
        if self.places.len() != expected {
            let found = self.places.len();
            return Err(source.damaged(format!(
                "it lists {found} strips or tiles where its size makes {expected}"
            )));
        }
        let row_bits = u64::from(self.chunk.0) * u64::from(self.bits) * self.woven() as u64;
        if across > 1 && !row_bits.is_multiple_of(8) {
            return Err(source.unread("tiles whose rows end within a byte", EXPORT));
        }
        for (chunk, place) in self.places.iter().enumerate() {
            self.check_chunk(source, chunk, *place)?;
        }
        Ok(())
    }

    fn check_chunk(&self, source: &Source, chunk: usize, place: Place) -> Result<(), IoError> {
        let cut = || source.damaged(format!("strip or tile {} is cut off", chunk + 1));
        let bytes = bytes(source.bytes, place).ok_or_else(cut)?;
        let rows = self.rows(chunk);
        if self.compression == compression::NONE && place.length < self.row_bytes() * rows {
            return Err(cut());
        }
        if self.compression != compression::JPEG {
            return Ok(());
        }
        // The decoder would fill what is missing, and cut rows of another width anew.
        let frame = marks::frame(bytes).ok_or_else(cut)?;
        marks::end(bytes).ok_or_else(cut)?;
        if let Some(coding) = frame.uncommon {
            return Err(source.unread(format!("JPEG with {coding}"), EXPORT));
        }
        if frame.bits != 8 || self.bits != 8 {
            return Err(source.unread(
                format!("JPEG of {} bits", frame.bits.max(self.bits)),
                EXPORT,
            ));
        }
        let fits = frame.width == self.chunk.0
            && u64::from(frame.height) >= rows
            && usize::from(frame.components) == self.woven();
        match fits {
            true => source.check_size(frame.width, frame.height),
            false => Err(source.damaged(format!(
                "JPEG {} has {}x{} pixels of {} channels, not those of its strip or tile",
                chunk + 1,
                frame.width,
                frame.height,
                frame.components
            ))),
        }
    }
}

/// Content of a chunk; `None` when it does not lie within the file.
pub(super) fn bytes(file: &[u8], place: Place) -> Option<&[u8]> {
    let start = usize::try_from(place.start).ok()?;
    let length = usize::try_from(place.length).ok()?;
    file.get(start..start.checked_add(length)?)
}

fn bits(source: &Source, page: &Directory) -> Result<u8, IoError> {
    let all = page.all(tags::BITS);
    let first = all.first().copied().unwrap_or(1);
    if all.iter().any(|bits| *bits != first) {
        return Err(source.unread("channels of different depths", EXPORT));
    }
    match first {
        1..=64 => Ok(first as u8),
        _ => Err(source.damaged(format!("its samples have {first} bits"))),
    }
}

fn kind(source: &Source, page: &Directory) -> Result<Kind, IoError> {
    let all = page.all(tags::SAMPLE_FORMAT);
    let first = all.first().copied().unwrap_or(1);
    if all.iter().any(|kind| *kind != first) {
        return Err(source.unread("channels of different kinds of numbers", EXPORT));
    }
    match first {
        // 4 is "nobody said".
        1 | 4 => Ok(Kind::Unsigned),
        2 => Ok(Kind::Signed),
        3 => Ok(Kind::Float),
        _ => Err(source.unread("complex numbers as samples", EXPORT)),
    }
}

fn places(source: &Source, page: &Directory, tiled: bool) -> Result<Vec<Place>, IoError> {
    let (starts, lengths) = match tiled {
        true => (page.all(tags::TILE_OFFSETS), page.all(tags::TILE_BYTES)),
        false => (page.all(tags::STRIP_OFFSETS), page.all(tags::STRIP_BYTES)),
    };
    if starts.is_empty() || starts.len() != lengths.len() {
        return Err(source.damaged("it does not say where its strips or tiles lie"));
    }
    let pairs = starts.into_iter().zip(lengths);
    Ok(pairs
        .map(|(start, length)| Place { start, length })
        .collect())
}
