use crate::IoError;
use image::ImageFormat;

/// Names of the formats that are read, for messages.
pub(crate) const READ_FORMATS: &str = "PNG, JPEG, TIFF, TGA, BMP, WebP or EXR";

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
        ImageFormat::Gif => "GIF",
        _ => "another image format",
    }
}

/// The error for a file whose extension is that of no image.
pub(crate) fn not_an_image(name: &str) -> IoError {
    let extension = split_extension(name).1;
    IoError::NotAnImage {
        name: name.to_owned(),
        found: format!("a file with extension {extension:?}"),
        expected: READ_FORMATS,
    }
}

/// The format of a file, on which its extension and its first bytes must agree.
///
/// TGA has no mark at its beginning: there the extension decides, unless the content is marked as
/// another format.
pub(crate) fn detect_format(name: &str, bytes: &[u8]) -> Result<ImageFormat, IoError> {
    let promised = format_of_extension(name).ok_or_else(|| not_an_image(name))?;
    let found = match image::guess_format(bytes) {
        Ok(found) if found == promised => return Ok(promised),
        Ok(found) => {
            return Err(IoError::WrongExtension {
                name: name.to_owned(),
                found: format_name(found),
                expected: format_name(promised),
            });
        }
        Err(_) if bytes.is_empty() => "an empty file".to_owned(),
        Err(_) if promised == ImageFormat::Tga => return Ok(promised),
        Err(_) => format!("content that is not {}", format_name(promised)),
    };
    Err(IoError::NotAnImage {
        name: name.to_owned(),
        found,
        expected: READ_FORMATS,
    })
}
