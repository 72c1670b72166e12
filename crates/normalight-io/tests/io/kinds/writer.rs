//! TIFF written byte by byte.

/// A tag, its kind (3: 16 bits, 4: 32 bits), its values.
pub type Entry = (u16, u16, Vec<u32>);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    Little,
    Big,
}

/// What packs the bytes of a strip or tile.
pub type Packing = fn(&[u8]) -> Vec<u8>;

/// A picture of one page.
pub struct Tiff {
    pub order: Order,
    /// Offsets of 64 bits.
    pub big: bool,
    pub width: u32,
    pub height: u32,
    pub depth: u16,
    pub channels: usize,
    pub tile: Option<(u32, u32)>,
    pub planar: bool,
    /// Samples as differences to their left neighbours.
    pub differences: bool,
    /// Number of a compression, and what does it.
    pub pack: Option<(u32, Packing)>,
}

pub fn short(tag: u16, value: u32) -> Entry {
    (tag, 3, vec![value])
}

pub fn bits(count: usize, bits: u32) -> Entry {
    (258, 3, vec![bits; count])
}

/// Little-endian, of one uncompressed strip: `tags` without the strip's own.
pub fn tiff(width: u32, height: u32, tags: &[Entry], data: &[u8]) -> Vec<u8> {
    let image = Tiff::new(width, height, 8, 1);
    let mut all = tags.to_vec();
    all.push((278, 4, vec![height]));
    image.file(all, &[data.to_vec()])
}

/// Bytes as PackBits: no runs, only literal stretches.
pub fn pack_bits(bytes: &[u8]) -> Vec<u8> {
    let stretches = bytes.chunks(128);
    stretches
        .flat_map(|part| [&[part.len() as u8 - 1], part].concat())
        .collect()
}

/// Bytes as LZW, first bits first.
pub fn pack_lzw(bytes: &[u8]) -> Vec<u8> {
    let order = weezl::BitOrder::Msb;
    weezl::encode::Encoder::with_tiff_size_switch(order, 8)
        .encode(bytes)
        .unwrap()
}

impl Tiff {
    pub fn new(width: u32, height: u32, depth: u16, channels: usize) -> Self {
        Self {
            order: Order::Little,
            big: false,
            width,
            height,
            depth,
            channels,
            tile: None,
            planar: false,
            differences: false,
            pack: None,
        }
    }

    fn number(&self, value: u64, count: usize) -> Vec<u8> {
        match self.order {
            Order::Little => value.to_le_bytes()[..count].to_vec(),
            Order::Big => value.to_be_bytes()[8 - count..].to_vec(),
        }
    }

    /// The whole file.
    pub fn bytes(&self, tags: &[Entry], at: &impl Fn(u32, u32, usize) -> u32) -> Vec<u8> {
        self.bytes_wide(tags, &|x, y, c| u64::from(at(x, y, c)))
    }

    pub fn bytes_wide(&self, tags: &[Entry], at: &dyn Fn(u32, u32, usize) -> u64) -> Vec<u8> {
        let rows = 5;
        let (wide, high) = self.tile.unwrap_or((self.width, rows));
        let planes = if self.planar { self.channels } else { 1 };
        let mut chunks = Vec::new();
        for plane in 0..planes {
            let channels = match self.planar {
                true => plane..plane + 1,
                false => 0..self.channels,
            };
            for top in (0..self.height).step_by(high as usize) {
                for left in (0..self.width).step_by(wide as usize) {
                    let bottom = match self.tile {
                        Some(_) => top + high,
                        None => (top + high).min(self.height),
                    };
                    let lines = (top..bottom).flat_map(|y| {
                        let line: Vec<u64> = (left..left + wide)
                            .flat_map(|x| channels.clone().map(move |c| (x, c)))
                            .map(|(x, c)| at(x, y, c))
                            .collect();
                        self.line(&line, channels.len())
                    });
                    let lines: Vec<u8> = lines.collect();
                    chunks.push(self.pack.map_or(lines.clone(), |(_, pack)| pack(&lines)));
                }
            }
        }
        let mut all = tags.to_vec();
        all.push(bits(self.channels, u32::from(self.depth)));
        all.push(short(277, self.channels as u32));
        all.push(short(284, if self.planar { 2 } else { 1 }));
        all.push(short(317, if self.differences { 2 } else { 1 }));
        all.push(short(259, self.pack.map_or(1, |(method, _)| method)));
        match self.tile {
            Some((wide, high)) => all.extend([short(322, wide), short(323, high)]),
            None => all.push(short(278, rows)),
        }
        self.file(all, &chunks)
    }

    /// Samples of the whole picture in one chunk, without differences.
    pub fn chunk_bytes(&self, at: &impl Fn(u32, u32, usize) -> u32) -> Vec<u8> {
        let lines = (0..self.height).flat_map(|y| {
            let line: Vec<u64> = (0..self.width)
                .flat_map(|x| (0..self.channels).map(move |c| (x, c)))
                .map(|(x, c)| u64::from(at(x, y, c)))
                .collect();
            self.line(&line, self.channels)
        });
        lines.collect()
    }

    fn line(&self, line: &[u64], channels: usize) -> Vec<u8> {
        let mut line = line.to_vec();
        if self.differences {
            for k in (channels..line.len()).rev() {
                line[k] = line[k].wrapping_sub(line[k - channels]);
            }
        }
        if self.depth >= 8 && self.depth.is_multiple_of(8) {
            let bytes = usize::from(self.depth / 8);
            return line.iter().flat_map(|&v| self.number(v, bytes)).collect();
        }
        let depth = usize::from(self.depth);
        let mut packed = vec![0u8; (line.len() * depth).div_ceil(8)];
        for (k, value) in line.iter().enumerate() {
            for bit in 0..depth {
                if value >> (depth - 1 - bit) & 1 == 1 {
                    let place = k * depth + bit;
                    packed[place / 8] |= 0x80 >> (place % 8);
                }
            }
        }
        packed
    }

    /// Head, chunks and directory; the tags of the chunks are added.
    fn file(&self, mut tags: Vec<Entry>, chunks: &[Vec<u8>]) -> Vec<u8> {
        let word = if self.big { 8 } else { 4 };
        let offsets = if tags.iter().any(|tag| tag.0 == 322) {
            324
        } else {
            273
        };
        let lengths = if offsets == 324 { 325 } else { 279 };
        tags.push((256, 4, vec![self.width]));
        tags.push((257, 4, vec![self.height]));
        let all: usize = chunks
            .iter()
            .map(|chunk| chunk.len().next_multiple_of(2))
            .sum();
        let head = if self.big { 16 } else { 8 };
        tags.push((offsets, 4, vec![0; chunks.len()]));
        tags.push((lengths, 4, chunks.iter().map(|c| c.len() as u32).collect()));
        tags.sort();
        let (entry, count) = if self.big { (20, 8) } else { (12, 2) };
        let length = count + entry * tags.len() + word;
        let directory = head + all;
        let mut at = head;
        let places = tags.iter_mut().find(|tag| tag.0 == offsets).unwrap();
        for (place, chunk) in places.2.iter_mut().zip(chunks) {
            *place = at as u32;
            at += chunk.len().next_multiple_of(2);
        }
        let mut heap = Vec::new();
        let mut fields = self.number(tags.len() as u64, count);
        for (tag, kind, values) in &tags {
            let width = if *kind == 3 { 2 } else { 4 };
            let stored = values
                .iter()
                .flat_map(|&v| self.number(u64::from(v), width));
            let mut stored: Vec<u8> = stored.collect();
            fields.extend(self.number(u64::from(*tag), 2));
            fields.extend(self.number(u64::from(*kind), 2));
            fields.extend(self.number(values.len() as u64, word));
            if stored.len() <= word {
                stored.resize(word, 0);
                fields.extend(stored);
            } else {
                fields.extend(self.number((directory + length + heap.len()) as u64, word));
                stored.resize(stored.len().next_multiple_of(2), 0);
                heap.extend(stored);
            }
        }
        fields.extend(vec![0; word]);
        fields.extend(heap);
        let samples = chunks.iter().flat_map(|chunk| {
            let mut chunk = chunk.clone();
            chunk.resize(chunk.len().next_multiple_of(2), 0);
            chunk
        });
        let mark = if self.order == Order::Little {
            b'I'
        } else {
            b'M'
        };
        let mut bytes = vec![mark, mark];
        bytes.extend(self.number(if self.big { 43 } else { 42 }, 2));
        if self.big {
            bytes.extend(self.number(8, 2));
            bytes.extend([0, 0]);
        }
        bytes.extend(self.number(directory as u64, word));
        bytes.extend(samples.chain(fields));
        bytes
    }
}

/// Directories one after another, classic and little-endian; each entry is (tag, value).
fn directories(all: &[Vec<(u16, u32)>], data: &[u8]) -> Vec<u8> {
    let mut bytes = b"II*\0".to_vec();
    let mut at = 8;
    bytes.extend(8u32.to_le_bytes());
    for (k, entries) in all.iter().enumerate() {
        at += 2 + 12 * entries.len() + 4;
        bytes.extend((entries.len() as u16).to_le_bytes());
        for (tag, value) in entries {
            bytes.extend(tag.to_le_bytes());
            bytes.extend(4u16.to_le_bytes());
            bytes.extend(1u32.to_le_bytes());
            bytes.extend(value.to_le_bytes());
        }
        let next = if k + 1 < all.len() { at as u32 } else { 0 };
        bytes.extend(next.to_le_bytes());
    }
    bytes.extend(data);
    bytes
}

const SIDE: u32 = 16;

fn entries(start: u32, preview: bool) -> Vec<(u16, u32)> {
    vec![
        (254, u32::from(preview)),
        (256, SIDE),
        (257, SIDE),
        (258, 8),
        (262, 1),
        (273, start),
        (278, SIDE),
        (279, SIDE * SIDE),
    ]
}

/// Pages whose grey grows from a value, faster with each turn; whether each says to be a preview.
pub fn pages(pages: &[(u8, bool)], turn: u32) -> Vec<u8> {
    let start = 8 + pages.len() as u32 * (2 + 12 * 8 + 4);
    let area = SIDE * SIDE;
    let all: Vec<_> = (pages.iter().zip(0..))
        .map(|(page, k)| entries(start + k * area, page.1))
        .collect();
    let data = pages.iter().flat_map(|page| {
        let page = page.0;
        (0..area).map(move |k| page + (k * (turn + 1) % 100) as u8)
    });
    directories(&all, &data.collect::<Vec<u8>>())
}

/// A preview with a directory below it in which `tag` has a value.
pub fn below(tag: u16, value: u32) -> Vec<u8> {
    let mut preview = entries(8 + 2 + 12 * 9 + 4, false);
    let start = 8 + 2 + 12 * 9 + 4 + SIDE * SIDE;
    preview.insert(8, (330, start));
    let mut bytes = directories(&[preview], &vec![90; (SIDE * SIDE) as usize]);
    bytes.extend(1u16.to_le_bytes());
    bytes.extend(tag.to_le_bytes());
    bytes.extend(4u16.to_le_bytes());
    bytes.extend(1u32.to_le_bytes());
    bytes.extend(value.to_le_bytes());
    bytes.extend([0; 4]);
    bytes
}
