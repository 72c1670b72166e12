//! EXR without plain R, G and B: luminance only, or named layers.
use crate::color::{Curves, Encoding, Primaries, Statement, to_srgb};
use crate::limits::{MAX_DECODE_BYTES, MAX_PIXELS};
use exr::prelude::{ReadChannels, ReadLayers, read};
use image::{DynamicImage, ImageBuffer};
use std::io::Cursor;

/// The first layer that has R, G and B, or else Y, under whatever layer name.
pub(super) fn decode(bytes: &[u8]) -> Result<DynamicImage, String> {
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false)
        .map_err(|error| error.to_string())?;
    for header in &meta.headers {
        let size = header.layer_size;
        let pixels = size.0 as u64 * size.1 as u64;
        let needed = pixels.saturating_mul(4 * header.channels.list.len() as u64);
        if pixels > MAX_PIXELS || needed > MAX_DECODE_BYTES {
            return Err(format!("{}x{} pixels are too many", size.0, size.1));
        }
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| error.to_string())?;
    let mut found = Vec::new();
    for layer in &image.layer_data {
        let list = &layer.channel_data.list;
        let (width, height) = (layer.size.0, layer.size.1);
        let channel = |wanted: &str| {
            list.iter().find(|channel| {
                let name = channel.name.to_string();
                let last = name.rsplit('.').next().unwrap_or_default();
                last.eq_ignore_ascii_case(wanted) && channel.sampling == exr::math::Vec2(1, 1)
            })
        };
        let rgb = ["R", "G", "B"].map(channel);
        let planes = match (rgb, channel("Y")) {
            ([Some(r), Some(g), Some(b)], _) => [r, g, b],
            (_, Some(y)) => [y, y, y],
            _ => {
                found.extend(list.iter().map(|channel| channel.name.to_string()));
                continue;
            }
        };
        let planes = planes.map(|channel| channel.sample_data.values_as_f32().collect::<Vec<_>>());
        let pixels = (0..width * height).flat_map(|k| [planes[0][k], planes[1][k], planes[2][k]]);
        return ImageBuffer::from_raw(width as u32, height as u32, pixels.collect())
            .map(DynamicImage::ImageRgb32F)
            .ok_or_else(|| "its samples do not fill it".to_owned());
    }
    found.truncate(12);
    Err(format!(
        "no layer has the channels R, G and B, or Y; found {}",
        found.join(", ")
    ))
}

/// Linear, in the primaries that the file states.
pub(super) fn statement(bytes: &[u8]) -> Statement {
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false);
    let stated = meta.ok().and_then(|meta| {
        let mut headers = meta.headers.iter();
        headers.find_map(|header| header.shared_attributes.chromaticities)
    });
    let Some(stated) = stated else {
        return Statement::Linear;
    };
    let points = [stated.red, stated.green, stated.blue, stated.white];
    let primaries: Primaries = points.map(|point| [point.0, point.1]);
    let name = "linear in its own primaries".to_owned();
    to_srgb(primaries)
        .and_then(|matrix| Encoding::statement(name, Curves::Linear, Some(matrix)))
        .unwrap_or_else(|reason| Statement::unknown(reason, Statement::Linear))
}
