use super::{PublishedEntry, light_list, read_small};
use crate::assemble::assemble;
use crate::color::ColorMode;
use crate::decode::decode_image;
use crate::limits::MAX_FILE_BYTES;
use crate::native::files::{display, read_file};
use crate::plan::StackPlan;
use crate::{IoError, MaskChoice, ReadOptions};
use normalight_core::{ImageStack, Light, Mask, NormalMap, Samples, StackImage, Vec3};
use std::path::Path;

/// One object of a published set: a shape in a material under its lights.
#[derive(Debug, Clone)]
pub struct PublishedObject {
    /// Which object it is.
    pub entry: PublishedEntry,
    /// The images, linear.
    pub stack: ImageStack,
    /// Pixels with a normal.
    pub mask: Mask,
    /// The true normals, zero outside the mask.
    pub normals: NormalMap,
    /// The true light of each image; published sets have intensity 1.
    pub lights: Vec<Light>,
}

pub(super) fn read(images: &Path, entry: &PublishedEntry) -> Result<PublishedObject, IoError> {
    let shape_folder = entry.shape_folder(images);
    let folder = shape_folder.join(entry.material());
    let list = folder.join(entry.lights_name());
    let listed = light_list::parse(&display(&list), &read_small(&list)?)?;
    let names: Vec<String> = listed
        .iter()
        .map(|(image, _)| display(&folder.join(image)))
        .collect();
    let plan = StackPlan {
        images: (0..names.len()).collect(),
        benchmark: true,
        ..StackPlan::default()
    };
    let options = ReadOptions {
        color: ColorMode::Linear,
        mask: MaskChoice::WholeFrame,
        ..ReadOptions::default()
    };
    let stack = assemble(&display(&list), &names, plan, &options, |index| {
        read_file(&folder.join(&listed[index].0), MAX_FILE_BYTES)
    })?
    .stack;
    let truth = shape_folder.join(entry.normals_name());
    let (mask, normals) = read_normals(&truth)?;
    if (normals.width(), normals.height()) != (stack.width(), stack.height()) {
        return Err(IoError::SetFormat {
            name: display(&truth),
            found: format!("{}x{} pixels", normals.width(), normals.height()),
            expected: format!("{}x{} as the images", stack.width(), stack.height()),
        });
    }
    stack.check_mask(&mask, &display(&truth))?;
    Ok(PublishedObject {
        entry: entry.clone(),
        stack,
        mask,
        normals,
        lights: listed.into_iter().map(|(_, light)| light).collect(),
    })
}

/// Normals from their picture; the mask is where they are no shorter than the coding explains.
pub(super) fn read_normals(path: &Path) -> Result<(Mask, NormalMap), IoError> {
    let name = display(path);
    let bytes = read_file(path, MAX_FILE_BYTES)?;
    let StackImage {
        width,
        height,
        channels,
        samples,
        ..
    } = decode_image(&name, &bytes, ColorMode::Linear)?.image;
    let values: Vec<f32> = match samples {
        Samples::U8(codes) if channels == 3 => codes.iter().map(|&c| decode(c, 255.0)).collect(),
        Samples::U16(codes) if channels == 3 => {
            codes.iter().map(|&c| decode(c, 65_535.0)).collect()
        }
        _ => {
            return Err(IoError::SetFormat {
                name,
                found: format!("{channels} channel(s) or floating point"),
                expected: "RGB of 8 or 16 bits".to_owned(),
            });
        }
    };
    let vectors = values.as_chunks::<3>().0.iter().map(|&v| Vec3::from(v));
    let vectors = vectors.map(|vector| match vector.length_squared() > 0.5 {
        true => vector,
        false => Vec3::ZERO,
    });
    let normals = NormalMap::new(width, height, vectors.collect());
    let inside = normals.normals().iter().map(|&normal| normal != Vec3::ZERO);
    let mask = Mask::new(width, height, inside.collect());
    Ok((mask, normals))
}

fn decode(code: impl Into<f32>, full: f32) -> f32 {
    code.into() / full * 2.0 - 1.0
}
