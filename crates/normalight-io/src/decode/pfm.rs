//! Portable float maps: a text head, then rows from the bottom.
use super::raw::Raw;
use super::source::Source;
use crate::IoError;
use crate::color::Statement;
use image::metadata::Orientation;
use normalight_core::Samples;

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

/// The image; grey fills all channels.
pub(super) fn decode(source: &Source) -> Result<Raw, IoError> {
    let damaged = || source.damaged("its float map is damaged");
    let bytes = source.bytes;
    let head = head(bytes).ok_or_else(damaged)?;
    source.check_size(head.width, head.height)?;
    Ok(Raw {
        width: head.width,
        height: head.height,
        channels: 3,
        samples: Samples::F32(values(bytes, &head).ok_or_else(damaged)?),
        premultiplied: false,
        statement: Statement::Linear,
        orientation: Orientation::NoTransforms,
        notices: Vec::new(),
    })
}

fn values(bytes: &[u8], head: &Head) -> Option<Vec<f32>> {
    let channels: usize = if bytes[1] == b'F' { 3 } else { 1 };
    let row = head.width as usize * channels;
    let data = bytes.get(head.start..head.start + 4 * row * head.height as usize)?;
    let values = data.chunks_exact(4 * row).rev().flat_map(|line| {
        line.as_chunks::<4>().0.iter().flat_map(move |&code| {
            let value = match head.little {
                true => f32::from_le_bytes(code),
                false => f32::from_be_bytes(code),
            };
            std::iter::repeat_n(value, 3 / channels)
        })
    });
    Some(values.collect())
}
