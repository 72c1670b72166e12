//! Normal and albedo maps as files.
use crate::IoError;
use crate::previews::displayed_albedo;
use image::{DynamicImage, ImageBuffer, ImageFormat, Luma, Rgb};
use normalight_core::{Mask, NormalMap, Vec3};
use npyz::WriterBuilder;
use serde::{Deserialize, Serialize};
use std::io::Cursor;

/// Which way green points in an exported normal map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum NormalFormat {
    /// Green is up, as everywhere in this program.
    #[default]
    OpenGl,
    /// Green is down.
    DirectX,
}

impl NormalFormat {
    /// Components in this format, each in -1..1.
    pub(crate) fn exported(self, normal: Vec3) -> [f32; 3] {
        match self {
            NormalFormat::OpenGl => [normal.x, normal.y, normal.z],
            NormalFormat::DirectX => [normal.x, -normal.y, normal.z],
        }
    }
}

/// A normal map as 16-bit RGB PNG: `(n + 1) / 2 * 65535`. Outside the object it faces the camera: black would be a
/// direction into the surface, which smaller copies of the map mix with the object's edge.
///
/// # Errors
/// [`IoError::Encode`] for a map that PNG cannot hold (no pixels).
pub fn normals_png(map: &NormalMap, format: NormalFormat) -> Result<Vec<u8>, IoError> {
    let code = |value: f32| ((value + 1.0) / 2.0 * 65_535.0).round() as u16;
    let samples: Vec<u16> = map
        .normals()
        .iter()
        .flat_map(|&normal| match normal {
            Vec3::ZERO => format.exported(Vec3::Z).map(code),
            normal => format.exported(normal).map(code),
        })
        .collect();
    let image =
        ImageBuffer::<Rgb<u16>, _>::from_raw(map.width() as u32, map.height() as u32, samples);
    png("normal map", image.map(DynamicImage::ImageRgb16))
}

/// Errors of normals as 8-bit grey PNG: four steps of grey a degree, black outside the object and where nothing is known.
///
/// # Shapes
/// `errors`: `[height, width]`, degrees; not a number where nothing is known.
///
/// # Errors
/// [`IoError::Encode`] for errors of another size than the mask.
pub fn normal_errors_png(errors: &[f32], mask: &Mask) -> Result<Vec<u8>, IoError> {
    let codes = errors.iter().zip(mask.inside());
    let code = |(&error, &inside): (&f32, &bool)| match inside {
        true if error.is_nan() => 0,
        true => (4.0 * error).round().clamp(1.0, 255.0) as u8,
        false => 0,
    };
    let (width, height) = (mask.width() as u32, mask.height() as u32);
    let image = ImageBuffer::<Luma<u8>, _>::from_raw(width, height, codes.map(code).collect());
    png("map of errors", image.map(DynamicImage::ImageLuma8))
}

/// A normal map as NumPy array: float32 `[height, width, 3]`, y up, zero outside the object.
///
/// # Errors
/// None that memory can cause; [`IoError::Encode`] keeps the signature honest.
pub fn normals_npy(map: &NormalMap) -> Result<Vec<u8>, IoError> {
    let shape = [map.height() as u64, map.width() as u64, 3];
    let values = map.normals().iter().flat_map(|normal| normal.to_array());
    npy("normal map", &shape, values)
}

/// Numbers as NumPy array of float32; `name` is what an error calls them.
///
/// # Errors
/// [`IoError::Encode`], also for more or fewer numbers than the shape has.
pub fn npy(
    name: &'static str,
    shape: &[u64],
    values: impl Iterator<Item = f32>,
) -> Result<Vec<u8>, IoError> {
    let failed = |error: std::io::Error| IoError::Encode {
        name,
        reason: error.to_string(),
    };
    let count: u64 = shape.iter().product();
    let mut bytes = Vec::with_capacity(4 * count as usize + 128);
    let mut writer = npyz::WriteOptions::<f32>::new()
        .default_dtype()
        .shape(shape)
        .writer(&mut bytes)
        .begin_nd()
        .map_err(failed)?;
    writer.extend(values).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// An albedo map as 8-bit sRGB PNG, so that it looks right in every viewer.
///
/// Albedo has no absolute scale: its 99th percentile (of the brightest channel, over pixels above
/// zero) becomes white.
///
/// # Shapes
/// `planes`: `[3, height, width]`, linear, not negative; zero outside the object.
///
/// # Errors
/// [`CoreError::SampleCount`](normalight_core::CoreError::SampleCount) when `planes` has another
/// size; [`IoError::Encode`].
pub fn albedo_png(planes: &[f32], width: usize, height: usize) -> Result<Vec<u8>, IoError> {
    let samples = displayed_albedo(planes, width, height)?.concat();
    let image = ImageBuffer::<Rgb<u8>, _>::from_raw(width as u32, height as u32, samples);
    png("albedo map", image.map(DynamicImage::ImageRgb8))
}

/// A mask as 8-bit grey PNG: 255 inside, 0 outside.
///
/// # Errors
/// [`IoError::Encode`] for a mask that PNG cannot hold (no pixels).
pub fn mask_png(mask: &Mask) -> Result<Vec<u8>, IoError> {
    let samples = mask
        .inside()
        .iter()
        .map(|&inside| if inside { 255 } else { 0 });
    let image = ImageBuffer::<Luma<u8>, _>::from_raw(
        mask.width() as u32,
        mask.height() as u32,
        samples.collect(),
    );
    png("mask", image.map(DynamicImage::ImageLuma8))
}

pub(crate) fn png(name: &'static str, image: Option<DynamicImage>) -> Result<Vec<u8>, IoError> {
    let failed = |reason: String| IoError::Encode { name, reason };
    let image = image.ok_or_else(|| failed("its size and its samples disagree".to_owned()))?;
    let mut bytes = Cursor::new(Vec::new());
    image
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|error| failed(error.to_string()))?;
    Ok(bytes.into_inner())
}
