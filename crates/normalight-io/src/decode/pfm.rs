//! Portable float maps: a text head, then rows from the bottom.
use image::{DynamicImage, ImageBuffer};

/// Whether the bytes begin as a float map, RGB or grey.
pub(crate) fn is_pfm(bytes: &[u8]) -> bool {
    matches!(bytes, [b'P', b'F' | b'f', b'\n' | b'\r' | b' ', ..])
}

/// Width, height, and where the samples begin; the sign of the scale is the byte order.
struct Head {
    width: u32,
    height: u32,
    little: bool,
    start: usize,
}

fn head(bytes: &[u8]) -> Option<Head> {
    let mut at = 2;
    let mut word = || -> Option<&str> {
        while bytes.get(at)?.is_ascii_whitespace() {
            at += 1;
        }
        let start = at;
        while !bytes.get(at)?.is_ascii_whitespace() {
            at += 1;
        }
        std::str::from_utf8(&bytes[start..at]).ok()
    };
    let width = word()?.parse().ok()?;
    let height = word()?.parse().ok()?;
    let scale: f32 = word()?.parse().ok()?;
    Some(Head {
        width,
        height,
        little: scale < 0.0,
        start: at + 1,
    })
}

/// Width and height.
pub(crate) fn size(bytes: &[u8]) -> Option<(u32, u32)> {
    head(bytes).map(|head| (head.width, head.height))
}

/// The image; grey fills all channels. `None` for a damaged file. The size was checked before.
pub(crate) fn decode(bytes: &[u8]) -> Option<DynamicImage> {
    let Head {
        width,
        height,
        little,
        start,
    } = head(bytes)?;
    let channels: usize = if bytes[1] == b'F' { 3 } else { 1 };
    let row = width as usize * channels;
    let data = bytes.get(start..start + 4 * row * height as usize)?;
    let values = data.chunks_exact(4 * row).rev().flat_map(|line| {
        line.as_chunks::<4>().0.iter().flat_map(move |&code| {
            let value = match little {
                true => f32::from_le_bytes(code),
                false => f32::from_be_bytes(code),
            };
            std::iter::repeat_n(value, 3 / channels)
        })
    });
    let buffer = ImageBuffer::from_raw(width, height, values.collect())?;
    Some(DynamicImage::ImageRgb32F(buffer))
}
