//! PNG files around arbitrary chunks: their checksums are right and their streams are compressed, which
//! no mutation of bytes would achieve.
use arbitrary::Arbitrary;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// A chunk before or after the pixels.
#[derive(Debug, Clone, Arbitrary)]
pub enum Chunk {
    Gamma(u32),
    Srgb(u8),
    CodePoints([u8; 4]),
    Chromaticities([u32; 8]),
    /// A colour profile, compressed or as it is.
    Profile(Vec<u8>, bool),
    Exif(Vec<u8>),
    Palette(Vec<u8>),
    Transparency(Vec<u8>),
    SignificantBits(Vec<u8>),
    Animation([u32; 2]),
    Text(Vec<u8>),
    CompressedText(Vec<u8>),
    Other([u8; 4], Vec<u8>),
}

/// A file; most are of a kind that exists, because sizes, depths and colours are picked from those
/// there are.
#[derive(Debug, Clone, Arbitrary)]
pub struct Png {
    pub width: u8,
    pub height: u8,
    pub depth: u8,
    pub color: u8,
    pub interlaced: bool,
    pub before: Vec<Chunk>,
    pub pixels: Vec<u8>,
    /// Whether the pixels are as many as the head says.
    pub complete: bool,
    pub after: Vec<Chunk>,
}

const DEPTHS: [u8; 5] = [8, 16, 1, 2, 4];
/// Grey, RGB, palette, grey and alpha, RGB and alpha: code and channels.
const COLORS: [(u8, usize); 5] = [(0, 1), (2, 3), (3, 1), (4, 2), (6, 4)];

impl Png {
    /// Width and height as the head has them.
    pub fn size(&self) -> (usize, usize) {
        (
            1 + usize::from(self.width % 64),
            1 + usize::from(self.height % 64),
        )
    }

    /// The file.
    pub fn bytes(&self) -> Vec<u8> {
        let (width, height) = self.size();
        let depth = DEPTHS[usize::from(self.depth) % DEPTHS.len()];
        let (color, channels) = COLORS[usize::from(self.color) % COLORS.len()];
        let mut head = Vec::new();
        head.extend((width as u32).to_be_bytes());
        head.extend((height as u32).to_be_bytes());
        head.extend([depth, color, 0, 0, u8::from(self.interlaced)]);
        let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
        put(&mut file, b"IHDR", &head);
        self.before.iter().for_each(|chunk| chunk.put(&mut file));
        let mut pixels = self.pixels.clone();
        if self.complete {
            // Enough for the seven passes of an interlaced picture; more does no harm.
            let row = 1 + (width * channels * usize::from(depth)).div_ceil(8);
            pixels.resize(row * height + 16 * (width + height), 0);
            if !self.interlaced {
                pixels.chunks_exact_mut(row).for_each(|row| row[0] %= 5);
            }
        }
        put(&mut file, b"IDAT", &compressed(&pixels));
        self.after.iter().for_each(|chunk| chunk.put(&mut file));
        put(&mut file, b"IEND", &[]);
        file
    }
}

impl Chunk {
    fn put(&self, file: &mut Vec<u8>) {
        let numbers = |numbers: &[u32]| -> Vec<u8> {
            numbers
                .iter()
                .flat_map(|number| number.to_be_bytes())
                .collect()
        };
        match self {
            Self::Gamma(gamma) => put(file, b"gAMA", &gamma.to_be_bytes()),
            Self::Srgb(intent) => put(file, b"sRGB", &[*intent]),
            Self::CodePoints(points) => put(file, b"cICP", points),
            Self::Chromaticities(points) => put(file, b"cHRM", &numbers(points)),
            Self::Profile(profile, true) => {
                put(
                    file,
                    b"iCCP",
                    &[b"p\0\0", &compressed(profile)[..]].concat(),
                );
            }
            Self::Profile(profile, false) => put(file, b"iCCP", profile),
            Self::Exif(exif) => put(file, b"eXIf", exif),
            Self::Palette(colors) => put(file, b"PLTE", colors),
            Self::Transparency(values) => put(file, b"tRNS", values),
            Self::SignificantBits(bits) => put(file, b"sBIT", bits),
            Self::Animation(frames) => put(file, b"acTL", &numbers(frames)),
            Self::Text(text) => put(file, b"tEXt", text),
            Self::CompressedText(text) => {
                put(file, b"zTXt", &[b"t\0\0", &compressed(text)[..]].concat());
            }
            Self::Other(kind, content) => put(file, kind, content),
        }
    }
}

fn put(file: &mut Vec<u8>, kind: &[u8; 4], content: &[u8]) {
    file.extend((content.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(content);
    let sum = crc32fast::hash(&file[start..]);
    file.extend(sum.to_be_bytes());
}

/// A zlib stream.
pub(crate) fn compressed(content: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(content).expect("memory takes all");
    encoder.finish().expect("memory takes all")
}
