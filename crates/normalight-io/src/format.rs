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

/// The format of a file, on which its extension and its first bytes must agree.
///
/// TGA has no mark at its beginning: there the extension decides, unless the content is marked as
/// another format.
pub(crate) fn detect_format(name: &str, bytes: &[u8]) -> Result<ImageFormat, IoError> {
    let not_an_image = |found: String| IoError::NotAnImage {
        name: name.to_owned(),
        found,
        expected: READ_FORMATS,
    };
    let Some(promised) = format_of_extension(name) else {
        let (_, extension) = split_extension(name);
        return Err(not_an_image(format!("a file with extension {extension:?}")));
    };
    match image::guess_format(bytes) {
        Ok(found) if found == promised => Ok(promised),
        Ok(found) => Err(IoError::WrongExtension {
            name: name.to_owned(),
            found: format_name(found).to_owned(),
            expected: format_name(promised),
        }),
        Err(_) if promised == ImageFormat::Tga => Ok(promised),
        Err(_) if bytes.is_empty() => Err(not_an_image("an empty file".to_owned())),
        Err(_) => Err(not_an_image(format!(
            "content that is not {}",
            format_name(promised)
        ))),
    }
}
