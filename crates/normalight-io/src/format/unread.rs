//! Files that are recognised but not read, and what to do with them.
//!
//! RAW files stay with their own developers: the libraries that read them (rawler, rawloader,
//! quickraw) are LGPL-2.1, which `deny.toml` does not admit, and the one that it would admit
//! (rawkit 0.1) knows one maker only. What they hold is a mosaic of single colours besides, and
//! filling that up is no business of photometric stereo.

/// What to do with raw data: LibRaw's `dcraw_emu -4 -T` is free and gives linear TIFF.
pub(crate) const RAW_ADVICE: &str =
    "export all shots alike as linear TIFF of 16 bits, for example with LibRaw's `dcraw_emu -4 -T`";

const EXPORT: &str = "export it as TIFF or PNG of 16 bits";
const PHONE: &str = "export all shots alike as PNG, or set the phone to its most compatible format";
const ANIMATION: &str = "save each photograph as PNG; 256 colours are too few for shading";
const FILM: &str = "extract one frame for each light, as PNG";
const UNPACK: &str = "unpack it and give the folder";
const TEXT: &str = "is this the right file? Downloads that failed look like this";

/// A format that is not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Unread {
    /// How people call it.
    pub(crate) name: &'static str,
    /// What to do.
    pub(crate) advice: &'static str,
    /// Whether a person would call it a picture.
    pub(crate) is_picture: bool,
}

const fn picture(name: &'static str, advice: &'static str) -> Unread {
    Unread {
        name,
        advice,
        is_picture: true,
    }
}

const fn other(name: &'static str, advice: &'static str) -> Unread {
    Unread {
        name,
        advice,
        is_picture: false,
    }
}

const HEIC: Unread = picture("HEIC", PHONE);
const AVIF: Unread = picture("AVIF", EXPORT);
const JPEG_XL: Unread = picture("JPEG XL", EXPORT);
const JPEG_2000: Unread = picture("JPEG 2000", EXPORT);
const JPEG_XR: Unread = picture("JPEG XR", EXPORT);
const GIF: Unread = picture("GIF", ANIMATION);
const PHOTOSHOP: Unread = picture("Photoshop", EXPORT);
const GIMP: Unread = picture("GIMP", EXPORT);
const RAW: Unread = picture("camera RAW", RAW_ADVICE);
const RADIANCE: Unread = picture("Radiance HDR", "save it as EXR, or as TIFF of 32 bits");
const FITS: Unread = picture("FITS", "save it as TIFF of 32 bits");
const DICOM: Unread = picture("DICOM", EXPORT);
const TEXTURE: Unread = picture("a texture format (DDS, KTX)", EXPORT);
const VECTORS: Unread = picture("SVG", "export it as PNG of pixels");
const ICON: Unread = picture("an icon format", EXPORT);
const PDF: Unread = other("a PDF document", "export its pictures as TIFF or PNG");
const VIDEO: Unread = other("a video", FILM);
const ARCHIVE: Unread = other("an archive", UNPACK);

/// The format that an extension in lower case promises.
pub(crate) fn of_extension(extension: &str) -> Option<Unread> {
    Some(match extension {
        "heic" | "heif" | "hif" | "heics" => HEIC,
        "avif" | "avifs" => AVIF,
        "jxl" => JPEG_XL,
        "jp2" | "j2k" | "jpf" | "jpx" | "j2c" | "jpc" => JPEG_2000,
        "jxr" | "wdp" | "hdp" => JPEG_XR,
        "gif" => GIF,
        "psd" | "psb" => PHOTOSHOP,
        "xcf" => GIMP,
        "hdr" | "rgbe" => RADIANCE,
        "fits" | "fit" | "fts" => FITS,
        "dcm" => DICOM,
        "dds" | "ktx" | "ktx2" => TEXTURE,
        "svg" => VECTORS,
        "ico" => ICON,
        "dng" | "cr2" | "cr3" | "crw" | "nef" | "nrw" | "arw" | "srf" | "sr2" | "raf" | "orf"
        | "ori" | "rw2" | "rwl" | "raw" | "pef" | "ptx" | "srw" | "3fr" | "fff" | "iiq" | "mrw"
        | "mef" | "mos" | "dcr" | "kdc" | "erf" | "x3f" | "gpr" => RAW,
        "pdf" => PDF,
        "mp4" | "mov" | "m4v" | "avi" | "mkv" | "webm" | "mts" | "m2ts" | "3gp" | "wmv" => VIDEO,
        "zip" | "7z" | "rar" | "tar" | "gz" | "tgz" | "xz" | "bz2" => ARCHIVE,
        _ => return None,
    })
}

/// The format that the first bytes show. TIFFs of cameras are told by their directories, later.
pub(crate) fn of_content(bytes: &[u8]) -> Option<Unread> {
    if let Some(b"ftyp") = bytes.get(4..8) {
        return Some(of_brands(bytes));
    }
    if let Some(b"moov" | b"mdat" | b"wide") = bytes.get(4..8) {
        return Some(VIDEO);
    }
    if let Some(b"ustar") = bytes.get(257..262) {
        return Some(ARCHIVE);
    }
    if let Some(b"DICM") = bytes.get(128..132) {
        return Some(DICOM);
    }
    if let [
        b'R',
        b'I',
        b'F',
        b'F',
        _,
        _,
        _,
        _,
        b'A',
        b'V',
        b'I',
        b' ',
        ..,
    ] = bytes
    {
        return Some(VIDEO);
    }
    const STARTS: [(&[u8], Unread); 35] = [
        (b"\0\0\0\x0CJXL \r\n\x87\n", JPEG_XL),
        (b"\xFF\x0A", JPEG_XL),
        (b"\0\0\0\x0CjP  \r\n\x87\n", JPEG_2000),
        (b"\xFF\x4F\xFF\x51", JPEG_2000),
        (b"II\xBC", JPEG_XR),
        (b"GIF8", GIF),
        (b"8BPS", PHOTOSHOP),
        (b"gimp xcf", GIMP),
        (b"#?RADIANCE", RADIANCE),
        (b"#?RGBE", RADIANCE),
        (b"SIMPLE  =", FITS),
        (b"DDS ", TEXTURE),
        (b"\xABKTX", TEXTURE),
        (b"<svg", VECTORS),
        (b"\0\0\x01\0", ICON),
        (b"II*\0\x10\0\0\0CR", RAW),
        (b"II\x1A\0\0\0HEAPCCDR", RAW),
        (b"FUJIFILMCCD-RAW", RAW),
        (b"IIRO", RAW),
        (b"IIRS", RAW),
        (b"MMOR", RAW),
        (b"IIU\0", RAW),
        (b"\0MRM", RAW),
        (b"FOVb", RAW),
        (b"%PDF", PDF),
        (
            b"%!PS",
            other(
                "a PostScript document",
                "export its pictures as TIFF or PNG",
            ),
        ),
        (b"\x1A\x45\xDF\xA3", VIDEO),
        (b"PK\x03\x04", ARCHIVE),
        (b"7z\xBC\xAF\x27\x1C", ARCHIVE),
        (b"Rar!", ARCHIVE),
        (b"\x1F\x8B", ARCHIVE),
        (b"\xFD7zXZ", ARCHIVE),
        (
            b"version https://git-lfs",
            other(
                "a note of Git LFS in place of the file",
                "fetch it with `git lfs pull`",
            ),
        ),
        (b"<!DOCTYPE", other("a web page", TEXT)),
        (b"<html", other("a web page", TEXT)),
    ];
    let known = STARTS.iter().find(|(start, _)| bytes.starts_with(start));
    known.map(|(_, format)| *format)
}

/// What a file of boxes (ISO/IEC 14496-12) holds, by its brands: the main one, else any of those
/// that it is compatible with.
fn of_brands(bytes: &[u8]) -> Unread {
    let length = bytes
        .first_chunk()
        .map_or(0, |&head| u32::from_be_bytes(head)) as usize;
    let brands = bytes.get(8..length.clamp(12, 256).min(bytes.len()));
    let brands = brands.unwrap_or_default().as_chunks::<4>().0;
    let of_brand = |brand: &[u8; 4]| match brand {
        b"avif" | b"avis" => Some(AVIF),
        b"heic" | b"heix" | b"hevc" | b"hevx" | b"heim" | b"heis" => Some(HEIC),
        b"crx " => Some(RAW),
        b"jp2 " | b"jpx " => Some(JPEG_2000),
        b"jxl " => Some(JPEG_XL),
        _ => None,
    };
    let still = brands.iter().find_map(of_brand);
    let is_image = brands
        .iter()
        .any(|brand| matches!(brand, b"mif1" | b"msf1"));
    still.unwrap_or(if is_image { HEIC } else { VIDEO })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brands_of_boxes() {
        let boxed = |brands: &[u8]| {
            let length = (8 + brands.len() as u32).to_be_bytes();
            of_content(&[&length[..], b"ftyp", brands, b"\0\0\0\0mdat"].concat())
        };
        assert_eq!(boxed(b"heic\0\0\0\0mif1heic"), Some(HEIC));
        assert_eq!(boxed(b"mif1\0\0\0\0mif1avif"), Some(AVIF));
        assert_eq!(boxed(b"mif1\0\0\0\0mif1"), Some(HEIC));
        assert_eq!(boxed(b"crx \0\0\0\x01crx isom"), Some(RAW));
        assert_eq!(boxed(b"qt  \0\0\0\0qt  "), Some(VIDEO));
        assert_eq!(boxed(b"isom\0\0\x02\0isomiso2mp41"), Some(VIDEO));
        for cut in 0..12 {
            assert!(matches!(
                of_content(&b"\0\0\0\x18ftypheic"[..cut]),
                None | Some(VIDEO)
            ));
        }
    }
}
