//! Numbers of the TIFF standard, its supplements and DNG.

pub(super) const SUBFILE: u16 = 254;
pub(super) const OLD_SUBFILE: u16 = 255;
pub(super) const WIDTH: u16 = 256;
pub(super) const HEIGHT: u16 = 257;
pub(super) const BITS: u16 = 258;
pub(super) const COMPRESSION: u16 = 259;
pub(super) const PHOTOMETRIC: u16 = 262;
pub(super) const FILL_ORDER: u16 = 266;
pub(super) const DESCRIPTION: u16 = 270;
pub(super) const STRIP_OFFSETS: u16 = 273;
pub(super) const ORIENTATION: u16 = 274;
pub(super) const SAMPLES: u16 = 277;
pub(super) const ROWS_PER_STRIP: u16 = 278;
pub(super) const STRIP_BYTES: u16 = 279;
pub(super) const PLANAR: u16 = 284;
pub(super) const PREDICTOR: u16 = 317;
pub(super) const COLOR_MAP: u16 = 320;
pub(super) const TILE_WIDTH: u16 = 322;
pub(super) const TILE_HEIGHT: u16 = 323;
pub(super) const TILE_OFFSETS: u16 = 324;
pub(super) const TILE_BYTES: u16 = 325;
pub(super) const SUB_DIRECTORIES: u16 = 330;
pub(super) const EXTRA_SAMPLES: u16 = 338;
pub(super) const SAMPLE_FORMAT: u16 = 339;
pub(super) const JPEG_TABLES: u16 = 347;
pub(super) const LUMA: u16 = 529;
pub(super) const SUBSAMPLING: u16 = 530;
pub(super) const REFERENCES: u16 = 532;
pub(super) const PROFILE: u16 = 34_675;
pub(super) const EXIF: u16 = 34_665;
pub(super) const EXIF_COLOR_SPACE: u16 = 0xA001;
pub(super) const EXIF_GAMMA: u16 = 0xA500;
pub(super) const EXIF_INTEROPERABILITY: u16 = 0xA005;
/// In the directory of [`EXIF_INTEROPERABILITY`].
pub(super) const INTEROPERABILITY_INDEX: u16 = 1;
pub(super) const DNG_VERSION: u16 = 50_706;

/// Values of [`COMPRESSION`].
pub(super) mod compression {
    pub(in crate::decode::tiff) const NONE: u64 = 1;
    pub(in crate::decode::tiff) const LZW: u64 = 5;
    pub(in crate::decode::tiff) const JPEG: u64 = 7;
    pub(in crate::decode::tiff) const ZSTANDARD: u64 = 50_000;

    /// Those that the decoder of the library undoes: none, CCITT group 4, JPEG, Deflate under
    /// both numbers, PackBits, WebP; and those that are undone here.
    pub(in crate::decode::tiff) const READ: [u64; 9] =
        [NONE, 4, LZW, JPEG, 8, 32_946, 32_773, ZSTANDARD, 50_001];

    /// How people call one.
    pub(in crate::decode::tiff) fn name(compression: u64) -> String {
        let known = match compression {
            LZW => "LZW",
            ZSTANDARD => "Zstandard",
            2 => "CCITT Huffman",
            3 => "CCITT group 3",
            6 => "old JPEG (TIFF 6.0)",
            9 | 10 | 34_661 => "JBIG",
            33_003..=33_005 | 34_712 => "JPEG 2000",
            34_676 | 34_677 => "LogLuv",
            34_887 => "LERC",
            34_925 => "LZMA",
            50_002 | 52_546 => "JPEG XL",
            other => return format!("compression {other}"),
        };
        format!("{known} compression")
    }

    /// Whether only raw data of cameras has it (Nikon, Sony, Epson, Samsung, Kodak, Panasonic,
    /// Pentax).
    pub(in crate::decode::tiff) fn is_of_cameras(compression: u64) -> bool {
        let known = [
            34_713, 32_767, 32_769, 32_770, 32_772, 65_000, 34_316, 65_535,
        ];
        known.contains(&compression)
    }
}

/// Values of [`PHOTOMETRIC`].
pub(super) mod photometric {
    pub(in crate::decode::tiff) const WHITE_IS_ZERO: u64 = 0;
    pub(in crate::decode::tiff) const BLACK_IS_ZERO: u64 = 1;
    pub(in crate::decode::tiff) const RGB: u64 = 2;
    pub(in crate::decode::tiff) const PALETTE: u64 = 3;
    pub(in crate::decode::tiff) const MASK: u64 = 4;
    pub(in crate::decode::tiff) const YCBCR: u64 = 6;
    /// A mosaic of colours behind a lens, and the same after it was filled up (DNG).
    pub(in crate::decode::tiff) const OF_CAMERAS: [u64; 2] = [32_803, 34_892];

    /// How people call colours that are not read.
    pub(in crate::decode::tiff) fn name(photometric: u64) -> String {
        match photometric {
            5 => "colours of a print (CMYK)".to_owned(),
            8..=10 => "Lab colours".to_owned(),
            32_844 | 32_845 => "LogLuv colours".to_owned(),
            other => format!("colours of kind {other}"),
        }
    }
}
