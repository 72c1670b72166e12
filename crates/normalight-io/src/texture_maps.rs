//! Normals and albedo as images for engines and painting programs.
use crate::maps::png;
use crate::previews::displayed_albedo;
use crate::{IoError, NormalFormat};
use image::{DynamicImage, ImageBuffer};
use normalight_core::{CoreError, Mask, NormalMap, Vec3};
use serde::{Deserialize, Serialize};

/// What is painted outside the object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum Outside {
    /// A surface that faces the camera; black for albedo.
    #[default]
    Flat,
    /// What the nearest pixel of the object has, so that smaller copies keep its edge clean.
    Dilated,
}

/// How maps are painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(default)]
pub struct MapSettings {
    /// Which way green points.
    pub normal_format: NormalFormat,
    /// What is painted outside the object.
    pub outside: Outside,
    /// Add the mask as transparency.
    pub alpha: bool,
    /// Eight bits a channel for normals instead of sixteen.
    pub eight_bits: bool,
}

/// A normal map as RGB or RGBA PNG: `(n + 1) / 2` of the largest value, so that (128, 128, 255) faces the camera.
///
/// # Errors
/// [`CoreError::MapSize`] when the mask has another size; [`IoError::Encode`].
pub fn normal_map_png(map: &NormalMap, mask: &Mask, how: MapSettings) -> Result<Vec<u8>, IoError> {
    check(mask, map.width(), map.height())?;
    let painted = painted(map.normals(), mask, how.outside, Vec3::Z);
    let components = painted.into_iter().map(|normal| {
        let normal = if normal == Vec3::ZERO {
            Vec3::Z
        } else {
            normal
        };
        how.normal_format.exported(normal)
    });
    let size = (map.width() as u32, map.height() as u32);
    let code = |value: f32, most: f32| ((value + 1.0) / 2.0 * most).round();
    let image = match how.eight_bits {
        true => {
            let codes = components.map(|n| n.map(|value| code(value, 255.0) as u8));
            with_alpha(codes, mask, how.alpha, u8::MAX).into_image_8(size, how.alpha)
        }
        false => {
            let codes = components.map(|n| n.map(|value| code(value, 65_535.0) as u16));
            with_alpha(codes, mask, how.alpha, u16::MAX).into_image_16(size, how.alpha)
        }
    };
    png("normal map", image)
}

/// An albedo map as 8-bit sRGB PNG, as bright as [`albedo_png`](crate::albedo_png).
///
/// # Shapes
/// `planes`: `[3, height, width]`, linear.
///
/// # Errors
/// [`CoreError::SampleCount`] when `planes` has another size than the mask; [`IoError::Encode`].
pub fn albedo_map_png(planes: &[f32], mask: &Mask, how: MapSettings) -> Result<Vec<u8>, IoError> {
    let pixels = albedo_pixels(planes, mask, how.outside)?;
    let size = (mask.width() as u32, mask.height() as u32);
    let codes = with_alpha(pixels.into_iter(), mask, how.alpha, u8::MAX);
    png("albedo map", codes.into_image_8(size, how.alpha))
}

/// The colours of [`albedo_map_png`].
pub(crate) fn albedo_pixels(
    planes: &[f32],
    mask: &Mask,
    outside: Outside,
) -> Result<Vec<[u8; 3]>, IoError> {
    let shown = displayed_albedo(planes, mask.width(), mask.height())?;
    Ok(painted(&shown, mask, outside, [0; 3]))
}

/// A map whose pixels outside the mask are as asked.
pub(crate) fn painted<T: Copy>(map: &[T], mask: &Mask, outside: Outside, flat: T) -> Vec<T> {
    let nearest = match outside {
        Outside::Dilated => mask.nearest_inside(),
        Outside::Flat => None,
    };
    let pixel = |(pixel, &inside): (usize, &bool)| match (&nearest, inside) {
        (_, true) => map[pixel],
        (Some(nearest), false) => map[nearest[pixel] as usize],
        (None, false) => flat,
    };
    mask.inside().iter().enumerate().map(pixel).collect()
}

pub(crate) fn check(mask: &Mask, width: usize, height: usize) -> Result<(), IoError> {
    if (mask.width(), mask.height()) == (width, height) {
        return Ok(());
    }
    Err(IoError::Core(CoreError::MapSize {
        found_width: mask.width(),
        found_height: mask.height(),
        expected_width: width,
        expected_height: height,
    }))
}

/// Samples of three or four channels.
struct Codes<T>(Vec<T>);

fn with_alpha<T: Copy + Default>(
    colors: impl Iterator<Item = [T; 3]>,
    mask: &Mask,
    alpha: bool,
    opaque: T,
) -> Codes<T> {
    let mut samples = Vec::with_capacity(4 * mask.inside().len());
    for (color, &inside) in colors.zip(mask.inside()) {
        samples.extend(color);
        if alpha {
            samples.push(if inside { opaque } else { T::default() });
        }
    }
    Codes(samples)
}

impl Codes<u8> {
    fn into_image_8(self, (width, height): (u32, u32), alpha: bool) -> Option<DynamicImage> {
        match alpha {
            true => ImageBuffer::from_raw(width, height, self.0).map(DynamicImage::ImageRgba8),
            false => ImageBuffer::from_raw(width, height, self.0).map(DynamicImage::ImageRgb8),
        }
    }
}

impl Codes<u16> {
    fn into_image_16(self, (width, height): (u32, u32), alpha: bool) -> Option<DynamicImage> {
        match alpha {
            true => ImageBuffer::from_raw(width, height, self.0).map(DynamicImage::ImageRgba16),
            false => ImageBuffer::from_raw(width, height, self.0).map(DynamicImage::ImageRgb16),
        }
    }
}
