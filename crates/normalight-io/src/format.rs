use crate::IoError;
use crate::decode::pfm;
use image::ImageFormat;

/// Names of the formats that are read, for messages.
pub(crate) const READ_FORMATS: &str = "PNG, JPEG, TIFF, TGA, BMP, WebP, EXR or PGM/PPM/PFM";

/// A name without the folders before it, whichever way the slashes lean.
pub(crate) fn base_name(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// The part of a base name before its last dot, and after it.
pub(crate) fn split_extension(name: &str) -> (&str, &str) {
    base_name(name)
        .rsplit_once('.')
        .unwrap_or((base_name(name), ""))
}

/// The image format that a file's extension promises; `None` for files that are no images.
pub(crate) fn format_of_extension(name: &str) -> Option<ImageFormat> {
    Some(
        match split_extension(name).1.to_ascii_lowercase().as_str() {
            "png" => ImageFormat::Png,
            "jpg" | "jpeg" | "jpe" | "jfif" => ImageFormat::Jpeg,
            "tif" | "tiff" => ImageFormat::Tiff,
            "tga" => ImageFormat::Tga,
            "bmp" => ImageFormat::Bmp,
            "webp" => ImageFormat::WebP,
            "exr" => ImageFormat::OpenExr,
            "pgm" | "ppm" | "pbm" | "pnm" | "pam" | "pfm" => ImageFormat::Pnm,
            _ => return None,
        },
    )
}

/// Whether a file's extension is neither that of an image nor of a text beside images.
pub(crate) fn is_foreign(name: &str) -> bool {
    let extension = split_extension(name).1;
    let text = ["txt", "lp", "csv", "mat", "json"];
    format_of_extension(name).is_none()
        && !base_name(name).starts_with('.')
        && !text
            .iter()
            .any(|known| extension.eq_ignore_ascii_case(known))
}

/// How people call a format.
pub(crate) fn format_name(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::Tga => "TGA",
        ImageFormat::Bmp => "BMP",
        ImageFormat::WebP => "WebP",
        ImageFormat::OpenExr => "EXR",
        ImageFormat::Pnm => "PNM",
        ImageFormat::Gif => "GIF",
        _ => "another image format",
    }
}

/// How people call a format of photographs that is not read, by its extension in lower case.
pub(crate) fn unread_format(extension: &str) -> Option<&'static str> {
    Some(match extension {
        "heic" | "heif" | "hif" => "HEIC",
        "avif" => "AVIF",
        "jxl" => "JPEG XL",
        "jp2" | "j2k" => "JPEG 2000",
        "gif" => "GIF",
        "psd" | "psb" => "Photoshop",
        "dng" | "cr2" | "cr3" | "nef" | "nrw" | "arw" | "raf" | "orf" | "rw2" | "pef" | "srw" => {
            "camera RAW"
        }
        _ => return None,
    })
}

/// How people call content that is a photograph in a format that is not read.
fn unread_content(bytes: &[u8]) -> Option<&'static str> {
    let brand = bytes.get(4..12).and_then(|head| head.strip_prefix(b"ftyp"));
    match (brand, bytes) {
        (Some(b"avif" | b"avis"), _) => Some("AVIF"),
        (Some(b"crx "), _) => Some("camera RAW"),
        (Some(_), _) => Some("HEIC"),
        (_, [b'G', b'I', b'F', b'8', ..]) => Some("GIF"),
        (_, [0xFF, 0x0A, ..]) => Some("JPEG XL"),
        (_, [b'8', b'B', b'P', b'S', ..]) => Some("Photoshop"),
        (_, [b'I', b'I', b'*', 0, _, _, _, _, b'C', b'R', ..]) => Some("camera RAW"),
        _ => None,
    }
}

/// The error for a file whose extension is that of no image that is read.
pub(crate) fn not_an_image(name: &str) -> IoError {
    let extension = split_extension(name).1;
    let found = match unread_format(&extension.to_ascii_lowercase()) {
        Some(format) => unread(format),
        None => format!("a file with extension {extension:?}"),
    };
    IoError::NotAnImage {
        name: name.to_owned(),
        found,
        expected: READ_FORMATS,
    }
}

fn unread(format: &str) -> String {
    format!("a photograph in {format}, which is not read (export it as TIFF or PNG of 16 bits)")
}

/// The format of a file: its content decides, whatever the extension of an image says.
///
/// TGA has no mark at its beginning: there the extension decides, unless the content is marked as
/// another format.
pub(crate) fn detect_format(name: &str, bytes: &[u8]) -> Result<ImageFormat, IoError> {
    let promised = format_of_extension(name).ok_or_else(|| not_an_image(name))?;
    let found = match (image::guess_format(bytes), unread_content(bytes)) {
        (_, Some(format)) => unread(format),
        (Ok(found), _) if format_name(found) != format_name(ImageFormat::Ico) => return Ok(found),
        // Files beyond 4 GiB, which the library does not tell.
        _ if matches!(bytes, [b'I', b'I', b'+', 0, ..] | [b'M', b'M', 0, b'+', ..]) => {
            return Ok(ImageFormat::Tiff);
        }
        _ if pfm::is_pfm(bytes) => return Ok(ImageFormat::Pnm),
        _ if bytes.is_empty() => "an empty file".to_owned(),
        _ if promised == ImageFormat::Tga => return Ok(promised),
        _ => format!("content that is not {}", format_name(promised)),
    };
    Err(IoError::NotAnImage {
        name: name.to_owned(),
        found,
        expected: READ_FORMATS,
    })
}
