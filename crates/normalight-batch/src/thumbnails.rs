//! Small pictures of a result, for the page.
use image::imageops::FilterType;
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::io::{self, Cursor};
use std::path::Path;

/// Longer side in pixels: twice what the page shows, for fine screens.
const SIDE: u32 = 192;

/// Most bytes that a map may take: more than the largest photographs that are read have in 16 bits.
const MOST: u64 = 8 * normalight_io::MAX_PIXELS;

/// The maps that are shown, each with its small picture. Their names hold the words for maps, so that nobody takes them for
/// photographs.
pub(crate) const SHOWN: [(&str, &str); 2] = [
    ("normals.png", "thumbnail-normals.png"),
    ("albedo.png", "thumbnail-albedo.png"),
];

/// Names and contents of the small pictures of the maps in a folder.
///
/// # Errors
/// A map that cannot be read, in words.
pub(crate) fn thumbnails(folder: &Path) -> Result<Vec<(&'static str, Vec<u8>)>, String> {
    let small = |(map, name)| {
        let made = small(&folder.join(map));
        made.map(|made| (name, made))
            .map_err(|reason| format!("{map}: cannot be read: {reason}"))
    };
    SHOWN.into_iter().map(small).collect()
}

fn small(path: &Path) -> io::Result<Vec<u8>> {
    let mut reader = ImageReader::open(path)?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST);
    reader.limits(limits);
    let map = reader.decode().map_err(io::Error::other)?;
    let longer = map.width().max(map.height());
    let small = match longer > SIDE {
        // To 8 bits first: a quarter of the memory.
        true => DynamicImage::ImageRgb8(map.into_rgb8()).resize(SIDE, SIDE, FilterType::Triangle),
        false => DynamicImage::ImageRgb8(map.into_rgb8()),
    };
    let mut png = Cursor::new(Vec::new());
    small
        .write_to(&mut png, ImageFormat::Png)
        .map_err(io::Error::other)?;
    Ok(png.into_inner())
}
