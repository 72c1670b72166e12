//! Maps as they are shown on screen.
use crate::{IoError, NormalFormat};
use normalight_core::{CoreError, NormalMap, Transfer, Vec3};

/// A normal map as 8-bit RGBA, transparent outside the object.
///
/// # Shapes
/// `[height, width, 4]`, rows from the top.
pub fn normals_rgba(map: &NormalMap, format: NormalFormat) -> Vec<u8> {
    let code = |value: f32| ((value + 1.0) / 2.0 * 255.0).round() as u8;
    let pixel = |&normal: &Vec3| match normal {
        Vec3::ZERO => [0; 4],
        normal => {
            let [x, y, z] = format.exported(normal).map(code);
            [x, y, z, 255]
        }
    };
    map.normals().iter().flat_map(pixel).collect()
}

/// An albedo map as 8-bit RGBA, as bright as [`albedo_png`](crate::albedo_png), transparent where
/// all channels are zero.
///
/// # Shapes
/// `planes`: `[3, height, width]`; the result is `[height, width, 4]`, rows from the top.
///
/// # Errors
/// [`CoreError::SampleCount`] when `planes` has another size.
pub fn albedo_rgba(planes: &[f32], width: usize, height: usize) -> Result<Vec<u8>, IoError> {
    let shown = displayed_albedo(planes, width, height)?;
    let pixel = |(index, [r, g, b]): (usize, [u8; 3])| {
        let inside = pixel_of(planes, index) != [0.0; 3];
        [r, g, b, if inside { 255 } else { 0 }]
    };
    Ok(shown.into_iter().enumerate().flat_map(pixel).collect())
}

/// 8-bit sRGB pixels of an albedo map, its 99th percentile white.
pub(crate) fn displayed_albedo(
    planes: &[f32],
    width: usize,
    height: usize,
) -> Result<Vec<[u8; 3]>, IoError> {
    let area = width * height;
    if planes.len() != 3 * area {
        return Err(IoError::Core(CoreError::SampleCount {
            name: "albedo map".to_owned(),
            found: planes.len(),
            expected: 3 * area,
        }));
    }
    let mut brightest: Vec<f32> = (0..area)
        .map(|index| pixel_of(planes, index).into_iter().fold(0.0, f32::max))
        .filter(|&value| value > 0.0 && value.is_finite())
        .collect();
    let rank = brightest.len() * 99 / 100;
    let white = if brightest.is_empty() {
        1.0
    } else {
        *brightest.select_nth_unstable_by(rank, f32::total_cmp).1
    };
    let code = |value: f32| {
        let encoded = Transfer::Srgb.encode((value / white).clamp(0.0, 1.0));
        (encoded * 255.0).round() as u8
    };
    Ok((0..area)
        .map(|index| pixel_of(planes, index).map(code))
        .collect())
}

fn pixel_of(planes: &[f32], index: usize) -> [f32; 3] {
    let area = planes.len() / 3;
    std::array::from_fn(|channel| planes[channel * area + index])
}
