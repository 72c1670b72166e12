//! EXR: colours or luminance, in layers and parts, read block by block.
mod layer;

use super::raw::Raw;
use super::source::Source;
use crate::color::{Curves, Encoding, Primaries, Statement, to_srgb};
use crate::{IoError, Notice};
use exr::block::reader::ChunksReader;
use exr::block::{UncompressedBlock, read};
use exr::meta::attribute::{IntegerBounds, SampleType};
use exr::meta::header::Header;
use image::metadata::Orientation;
use layer::{Layer, layers};
use normalight_core::Samples;
use std::io::Cursor;

/// The first layer with colours, or else with luminance, under whatever name, in the frame of the
/// display window: what lies beyond is left out, what is missing is black.
///
/// # Errors
/// Damaged, deep data, shared colours, or no layer that is a picture.
pub(super) fn decode(source: &Source) -> Result<Raw, IoError> {
    let failed = |error: exr::error::Error| source.damaged(error.to_string());
    // The library only says that it cannot.
    let is_deep = source.bytes.get(5).is_some_and(|flags| flags & 0b1000 != 0);
    if is_deep {
        return Err(source.unread("deep data", "flatten it and export it again"));
    }
    let reader = read(Cursor::new(source.bytes), false).map_err(failed)?;
    let layers = layers(reader.headers());
    let Some(layer) = layers.first() else {
        return Err(source.unread(
            format!("the channels {}", names(reader.headers())),
            "export the picture as channels R, G and B, or Y",
        ));
    };
    let header = &reader.headers()[layer.part];
    let window = header.shared_attributes.display_window;
    let (width, height) = (window.size.0 as u32, window.size.1 as u32);
    source.check_size(width, height)?;
    let statement = statement(header);
    let data = header.own_attributes.layer_position;
    let stored = header.layer_size;
    source.check_size(stored.0 as u32, stored.1 as u32)?;
    if layer.is_luminance_chroma(header) {
        return Err(source.unread(
            "luminance and colours that pixels share (luminance-chroma)",
            "export it as RGB",
        ));
    }
    let offset = (
        i64::from(data.0) - i64::from(window.position.0),
        i64::from(data.1) - i64::from(window.position.1),
    );
    let part = layer.part;
    let mut frame = Frame {
        window,
        offset,
        channels: layer.channels.len(),
        values: vec![0.0; width as usize * height as usize * layer.channels.len()],
    };
    let mut chunks = reader
        .filter_chunks(false, |_, _, block| {
            block.layer == part && block.level == exr::math::Vec2(0, 0)
        })
        .map_err(failed)?
        .sequential_decompressor(false);
    let mut area = 0;
    while let Some(block) = chunks.decompress_next_block() {
        let block = block.map_err(failed)?;
        area += block.index.pixel_size.area() as u64;
        let header = &chunks.meta_data().headers[part];
        frame
            .place(&block, header, layer)
            .ok_or_else(|| source.damaged("a block is too short"))?;
    }
    if area != stored.area() as u64 {
        return Err(source.damaged("blocks are missing"));
    }
    let mut notices = Vec::new();
    if layers.len() > 1 {
        notices.push(Notice::SeveralLayers {
            file: source.name.to_owned(),
            taken: layer.name.clone(),
            others: layers[1..].iter().map(|layer| layer.name.clone()).collect(),
        });
    }
    Ok(Raw {
        width,
        height,
        channels: layer.channels.len(),
        samples: Samples::F32(frame.values),
        // As the format has it.
        premultiplied: true,
        statement,
        orientation: Orientation::NoTransforms,
        notices,
    })
}

/// Linear, in the primaries that the file states.
fn statement(header: &Header) -> Statement {
    let Some(stated) = header.shared_attributes.chromaticities else {
        return Statement::Linear;
    };
    let points = [stated.red, stated.green, stated.blue, stated.white];
    let primaries: Primaries = points.map(|point| [point.0, point.1]);
    let name = "linear in its own primaries".to_owned();
    to_srgb(primaries)
        .and_then(|matrix| Encoding::statement(name, Curves::Linear, Some(matrix)))
        .unwrap_or_else(|reason| Statement::unknown(reason, Statement::Linear))
}

/// Names of channels, for a message.
fn names(headers: &[Header]) -> String {
    let all = headers.iter().flat_map(|header| &header.channels.list);
    let all: Vec<String> = all.map(|channel| channel.name.to_string()).collect();
    crate::notice::some_names(&all)
}

/// The picture as far as it is read.
struct Frame {
    window: IntegerBounds,
    /// Where the data begins in the window.
    offset: (i64, i64),
    channels: usize,
    /// `[height, width, channels]`
    values: Vec<f32>,
}

impl Frame {
    /// Puts the samples of a block where they belong; `None` when it has too few.
    fn place(&mut self, block: &UncompressedBlock, header: &Header, layer: &Layer) -> Option<()> {
        let (wide, high) = (self.window.size.0 as i64, self.window.size.1 as i64);
        let list = &header.channels.list;
        let width = block.index.pixel_size.0;
        let mut start = 0;
        for row in 0..block.index.pixel_size.1 {
            let y = self.offset.1 + (block.index.pixel_position.1 + row) as i64;
            for (index, channel) in list.iter().enumerate() {
                let bytes = channel.sample_type.bytes_per_sample();
                let line = block.data.get(start..start + width * bytes)?;
                start += width * bytes;
                let Some(place) = layer.channels.iter().position(|&wanted| wanted == index) else {
                    continue;
                };
                if !(0..high).contains(&y) {
                    continue;
                }
                let left = self.offset.0 + block.index.pixel_position.0 as i64;
                for (column, code) in line.chunks_exact(bytes).enumerate() {
                    let x = left + column as i64;
                    if (0..wide).contains(&x) {
                        let pixel = (y * wide + x) as usize;
                        self.values[pixel * self.channels + place] =
                            value(code, channel.sample_type);
                    }
                }
            }
        }
        Some(())
    }
}

/// A sample in the machine's byte order, as the library unpacks it.
fn value(code: &[u8], kind: SampleType) -> f32 {
    match (kind, code) {
        (SampleType::F16, &[a, b]) => exr::prelude::f16::from_ne_bytes([a, b]).to_f32(),
        (SampleType::F32, &[a, b, c, d]) => f32::from_ne_bytes([a, b, c, d]),
        (SampleType::U32, &[a, b, c, d]) => u32::from_ne_bytes([a, b, c, d]) as f32,
        _ => 0.0,
    }
}
