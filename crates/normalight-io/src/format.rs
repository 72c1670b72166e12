//! Which format a file is of: by its name and by its content.
pub(crate) mod unread;

use crate::IoError;
use crate::decode::pfm;
use image::ImageFormat;
use unread::Unread;

/// Names of the formats that are read, for messages.
pub(crate) const READ_FORMATS: &str = "PNG, JPEG, TIFF, TGA, BMP, WebP, EXR, QOI or PGM/PPM/PFM";

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
            "png" | "apng" => ImageFormat::Png,
            "jpg" | "jpeg" | "jpe" | "jfif" | "mpo" => ImageFormat::Jpeg,
            "tif" | "tiff" | "btf" | "tf8" => ImageFormat::Tiff,
            "tga" => ImageFormat::Tga,
            "bmp" | "dib" => ImageFormat::Bmp,
            "qoi" => ImageFormat::Qoi,
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
        ImageFormat::Qoi => "QOI",
        _ => "another image format",
    }
}

/// How people call a format of photographs that is not read, by its extension in lower case.
pub(crate) fn unread_format(extension: &str) -> Option<&'static str> {
    let format = unread::of_extension(extension)?;
    format.is_picture.then_some(format.name)
}

/// Whether only a file's content can tell that it is an image that is read: its name promises nothing, or a format of
/// pictures that is not read. Previews and copies under other extensions are none of the photographs.
pub(crate) fn may_hold_image(name: &str) -> bool {
    let extension = split_extension(name).1.to_ascii_lowercase();
    extension.is_empty() || unread_format(&extension).is_some()
}

/// Whether bytes begin as an image that is read does. Raw files begin as TIFF files do: a name that promises
/// another format of pictures outweighs that.
pub(crate) fn is_image_content(name: &str, head: &[u8]) -> bool {
    let extension = split_extension(name).1.to_ascii_lowercase();
    let promised = unread_format(&extension).is_some();
    unread::of_content(head).is_none()
        && (image::guess_format(head)
            .is_ok_and(|format| is_read(format) && !(promised && format == ImageFormat::Tiff))
            || pfm::is_pfm(head))
}

/// The error for a file whose extension is that of no image that is read.
pub(crate) fn not_an_image(name: &str) -> IoError {
    let extension = split_extension(name).1;
    let found = match unread::of_extension(&extension.to_ascii_lowercase()) {
        Some(format) => words(format),
        None => format!("a file with extension {extension:?}"),
    };
    IoError::NotAnImage {
        name: name.to_owned(),
        found,
        expected: READ_FORMATS,
    }
}

fn words(format: Unread) -> String {
    let Unread { name, advice, .. } = format;
    match format.is_picture {
        true => format!("a photograph in {name}, which is not read ({advice})"),
        false => format!("{name} ({advice})"),
    }
}

/// The format of a file: its content decides, whatever the extension of an image says.
///
/// TGA has no mark at its beginning: there the extension decides, unless the content is marked as
/// another format.
pub(crate) fn detect_format(name: &str, bytes: &[u8]) -> Result<ImageFormat, IoError> {
    let promised = match format_of_extension(name) {
        Some(promised) => promised,
        None if may_hold_image(name) && is_image_content(name, bytes) => ImageFormat::Png,
        None => return Err(not_an_image(name)),
    };
    let found = match (image::guess_format(bytes), unread::of_content(bytes)) {
        // The header of a TGA may begin like anything.
        (_, Some(format)) if promised != ImageFormat::Tga || format.is_picture => words(format),
        (Ok(found), _) if is_read(found) => return Ok(found),
        // Files beyond 4 GiB, which the library does not tell.
        _ if matches!(bytes, [b'I', b'I', b'+', 0, ..] | [b'M', b'M', 0, b'+', ..]) => {
            return Ok(ImageFormat::Tiff);
        }
        _ if pfm::is_pfm(bytes) => return Ok(ImageFormat::Pnm),
        _ if bytes.is_empty() => "an empty file".to_owned(),
        _ if promised == ImageFormat::Tga => return Ok(promised),
        _ if bytes.iter().take(4096).all(|&byte| byte == 0) => {
            "nothing but zeros (a copy or download that failed?)".to_owned()
        }
        _ => format!("content that is not {}", format_name(promised)),
    };
    Err(IoError::NotAnImage {
        name: name.to_owned(),
        found,
        expected: READ_FORMATS,
    })
}

fn is_read(format: ImageFormat) -> bool {
    use ImageFormat::{Bmp, Jpeg, OpenExr, Png, Pnm, Qoi, Tga, Tiff, WebP};
    let read = [Bmp, Jpeg, OpenExr, Png, Pnm, Qoi, Tga, Tiff, WebP];
    read.contains(&format)
}
