//! The files of a shape.
use super::PublishedEntry;
use crate::IoError;
use crate::maps::{mask_png, normals_npy, npy, png};
use image::{DynamicImage, ImageBuffer, Rgb};
use normalight_core::{Mask, NormalMap, Vec3};

/// Names and contents of the files that all materials of a shape share.
pub(super) fn shape_files(
    entry: &PublishedEntry,
    normals: &NormalMap,
    mask: &Mask,
    depth: Option<&[f32]>,
) -> Result<Vec<(String, Vec<u8>)>, IoError> {
    let shape = entry.shape();
    let mut files = vec![
        (entry.normals_name(), normals_rgb8(normals)?),
        (format!("{shape}_normal.npy"), normals_npy(normals)?),
        (format!("{shape}_mask.png"), mask_png(mask)?),
    ];
    if let Some(depth) = depth {
        let inside = mask.inside().iter();
        let values = depth
            .iter()
            .zip(inside)
            .map(|(&depth, &inside)| match inside {
                true => depth,
                false => f32::NAN,
            });
        let shape_of_map = [mask.height() as u64, mask.width() as u64];
        let bytes = npy("depth map", &shape_of_map, values)?;
        files.push((format!("{shape}_depth.npy"), bytes));
    }
    Ok(files)
}

/// Normals as the published sets have them: 8 bits, and outside 127, as zero has no code.
fn normals_rgb8(normals: &NormalMap) -> Result<Vec<u8>, IoError> {
    let code = |value: f32| ((value + 1.0) / 2.0 * 255.0).round() as u8;
    let codes = normals.normals().iter().flat_map(|&normal| match normal {
        Vec3::ZERO => [127; 3],
        normal => normal.to_array().map(code),
    });
    let (width, height) = (normals.width() as u32, normals.height() as u32);
    let image = ImageBuffer::<Rgb<u8>, _>::from_raw(width, height, codes.collect());
    png("normal map", image.map(DynamicImage::ImageRgb8))
}
