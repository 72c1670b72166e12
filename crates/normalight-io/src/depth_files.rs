//! Heights, curvature and ambient occlusion as files.
use crate::IoError;
use crate::maps::png;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec,
    WritableImage,
};
use image::{DynamicImage, ImageBuffer, Luma};
use normalight_core::{DepthMap, Mask, NormalMap};
use std::io::Cursor;
use tiff::encoder::{TiffEncoder, colortype::Gray32Float};

/// Heights as 16-bit grey PNG, and how many pixels of height one step of grey is: black is the lowest height,
/// white the highest; black outside the mask.
///
/// # Errors
/// [`IoError::Encode`].
pub fn height_png(depth: &DepthMap) -> Result<(Vec<u8>, f32), IoError> {
    let (low, high) = depth.range();
    let step = (high - low).max(f32::MIN_POSITIVE) / 65_535.0;
    let heights = depth.heights().iter().zip(depth.mask().inside());
    let codes = heights.map(|(&height, &inside)| match inside {
        true => ((height - low) / step).round() as u16,
        false => 0,
    });
    Ok((grey_16("height map", depth.mask(), codes.collect())?, step))
}

/// Heights in pixels as TIFF of 32-bit floating-point numbers; NaN outside the mask.
///
/// # Errors
/// [`IoError::Encode`].
pub fn height_tiff(depth: &DepthMap) -> Result<Vec<u8>, IoError> {
    let mut bytes = Cursor::new(Vec::new());
    let (width, height) = (depth.width() as u32, depth.height() as u32);
    TiffEncoder::new(&mut bytes)
        .and_then(|mut encoder| {
            encoder.write_image::<Gray32Float>(width, height, &heights_or_nan(depth))
        })
        .map_err(|error| failed("height map", error))?;
    Ok(bytes.into_inner())
}

/// Heights in pixels as OpenEXR with the one channel `Y` of 32-bit floating-point numbers; NaN outside the
/// mask.
///
/// # Errors
/// [`IoError::Encode`].
pub fn height_exr(depth: &DepthMap) -> Result<Vec<u8>, IoError> {
    let size = (depth.width(), depth.height());
    exr_of("height map", size, [("Y", heights_or_nan(depth))])
}

/// Normals as OpenEXR, each component -1..1 as 32-bit floating-point number in `R`, `G` and `B`, y up; zero
/// outside the object.
///
/// # Errors
/// [`IoError::Encode`].
pub fn normals_exr(map: &NormalMap) -> Result<Vec<u8>, IoError> {
    let plane = |axis: usize| map.normals().iter().map(|n| n.to_array()[axis]).collect();
    let planes = [("R", plane(0)), ("G", plane(1)), ("B", plane(2))];
    exr_of("normal map", (map.width(), map.height()), planes)
}

/// Mean curvature as 16-bit grey PNG, and the curvature (1 / pixels) that is white: its 99th percentile. Middle
/// grey is flat, brighter bulges towards the camera.
///
/// # Errors
/// [`IoError::Encode`].
pub fn curvature_png(curvature: &[f32], mask: &Mask) -> Result<(Vec<u8>, f32), IoError> {
    let mut sizes: Vec<f32> = mask
        .pixels()
        .iter()
        .map(|&pixel| curvature[pixel].abs())
        .collect();
    let rank = sizes.len() * 99 / 100;
    let white = match sizes.is_empty() {
        true => 1.0,
        false => *sizes.select_nth_unstable_by(rank, f32::total_cmp).1,
    };
    let white = white.max(1e-6);
    let code = |value: &f32| (((value / white).clamp(-1.0, 1.0) + 1.0) / 2.0 * 65_535.0).round();
    let codes = curvature.iter().map(|value| code(value) as u16).collect();
    Ok((grey_16("curvature map", mask, codes)?, white))
}

/// Ambient occlusion as 8-bit grey PNG: white where the whole sky is seen.
///
/// # Errors
/// [`IoError::Encode`].
pub fn occlusion_png(light: &[f32], mask: &Mask) -> Result<Vec<u8>, IoError> {
    let codes = light
        .iter()
        .map(|light| (light.clamp(0.0, 1.0) * 255.0).round() as u8);
    let (width, height) = (mask.width() as u32, mask.height() as u32);
    let image = ImageBuffer::<Luma<u8>, _>::from_raw(width, height, codes.collect());
    png("ambient occlusion", image.map(DynamicImage::ImageLuma8))
}

/// One channel of 16 bits.
pub(crate) fn grey_16(
    name: &'static str,
    mask: &Mask,
    codes: Vec<u16>,
) -> Result<Vec<u8>, IoError> {
    let (width, height) = (mask.width() as u32, mask.height() as u32);
    let image = ImageBuffer::<Luma<u16>, _>::from_raw(width, height, codes);
    png(name, image.map(DynamicImage::ImageLuma16))
}

fn heights_or_nan(depth: &DepthMap) -> Vec<f32> {
    let heights = depth.heights().iter().zip(depth.mask().inside());
    let value = |(&height, &inside): (&f32, &bool)| if inside { height } else { f32::NAN };
    heights.map(value).collect()
}

fn exr_of<const N: usize>(
    name: &'static str,
    size: (usize, usize),
    planes: [(&str, Vec<f32>); N],
) -> Result<Vec<u8>, IoError> {
    let channels = planes.map(|(name, values)| AnyChannel::new(name, FlatSamples::F32(values)));
    let channels = AnyChannels::sort(SmallVec::from_vec(channels.into()));
    let layer = Layer::new(
        size,
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        channels,
    );
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(|error| failed(name, error))?;
    Ok(bytes.into_inner())
}

fn failed(name: &'static str, error: impl std::fmt::Display) -> IoError {
    IoError::Encode {
        name,
        reason: error.to_string(),
    }
}
