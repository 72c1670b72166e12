//! True normals beside photographs, to compare the estimated ones with.
use crate::format::base_name;
use crate::matlab::find_array;
use crate::names::{folded, stem};
use crate::{IoError, NormalFormat, read_normals};
use normalight_core::{Estimate, Mask, NormalError, NormalMap, Vec3, angle_to_truth, normal_error};
use serde::{Deserialize, Serialize};

/// True normals as read.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// The file, without folders.
    pub file: String,
    /// Zero where unknown; of the size of the photographs.
    pub normals: NormalMap,
}

/// How far normals are from true ones, over the pixels of the object where these are known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct TruthErrors {
    /// The file of the true normals.
    pub file: String,
    /// Mean angle in degrees.
    pub mean: f32,
    /// Median angle in degrees.
    pub median: f32,
    /// Share (0..1) of pixels under 11.25, 22.5 and 30 degrees.
    pub shares: [f32; 3],
    /// Number of pixels compared.
    pub pixels: usize,
}

impl Truth {
    /// The figures of an estimate; `None` where no pixel of the mask can be compared.
    pub fn errors(&self, estimate: &Estimate, mask: &Mask) -> Option<TruthErrors> {
        let NormalError {
            mean,
            median,
            shares,
            pixels,
        } = normal_error(&estimate.normals, &self.normals, mask).ok()?;
        (pixels > 0).then(|| TruthErrors {
            file: self.file.clone(),
            mean: mean.to_degrees(),
            median: median.to_degrees(),
            shares,
            pixels,
        })
    }

    /// The angle at each pixel in degrees; not a number where nothing is to be compared.
    pub fn map(&self, normals: &NormalMap, mask: &Mask) -> Vec<f32> {
        let pairs = normals.normals().iter().zip(self.normals.normals());
        pairs
            .zip(mask.inside())
            .map(|((&normal, &truth), &inside)| {
                let angle = angle_to_truth(normal, truth).filter(|_| inside);
                angle.map_or(f32::NAN, f32::to_degrees)
            })
            .collect()
    }
}

/// The file of true normals among some: `Normal_gt.mat`, or an image or array whose name has both `normal` and `gt`, `truth`
/// or `true` in it. Numbers come before pictures.
pub(crate) fn truth_among<S: AsRef<str>>(names: &[S]) -> Option<usize> {
    let rank = |name: &str| -> Option<usize> {
        let stem = folded(stem(base_name(name)));
        let mut words = stem.split(|c: char| !c.is_alphabetic());
        let says_true = words.any(|word| ["gt", "truth", "true", "groundtruth"].contains(&word));
        let extension = name.rsplit_once('.')?.1.to_ascii_lowercase();
        let kinds = ["mat", "npy", "exr", "tif", "tiff", "png"];
        let kind = kinds.iter().position(|&kind| kind == extension)?;
        (stem.contains("normal") && says_true).then_some(kind)
    };
    let ranked = names.iter().enumerate();
    let ranked = ranked.filter_map(|(index, name)| Some((rank(name.as_ref())?, index)));
    ranked.min().map(|(_, index)| index)
}

/// Reads true normals for images of a size: a MATLAB file with the variable `Normal_gt`, `[height, width, 3]`, or what
/// [`read_normals`] reads, green up.
///
/// # Errors
/// [`IoError::TruthFormat`]; those of [`read_normals`].
pub(crate) fn read_truth(
    name: &str,
    bytes: &[u8],
    (width, height): (usize, usize),
) -> Result<NormalMap, IoError> {
    if name.to_ascii_lowercase().ends_with(".mat") {
        return parse_matlab(name, bytes, width, height);
    }
    let (normals, _) = read_normals(name, bytes, NormalFormat::OpenGl)?;
    let found = (normals.width(), normals.height());
    if found != (width, height) {
        return Err(IoError::TruthFormat {
            name: name.to_owned(),
            found: format!("{}x{} pixels", found.0, found.1),
            expected: format!("{width}x{height}, as the photographs have"),
        });
    }
    Ok(normals)
}

fn parse_matlab(
    name: &str,
    bytes: &[u8],
    width: usize,
    height: usize,
) -> Result<NormalMap, IoError> {
    let wrong = |found: String| IoError::TruthFormat {
        name: name.to_owned(),
        found,
        expected: format!("a variable Normal_gt of {height} x {width} x 3 real numbers"),
    };
    let area = width * height;
    // Three doubles for each pixel, and the array's head.
    let limit = 24 * area as u64 + 4096;
    let array = find_array(bytes, "Normal_gt", limit)
        .ok_or_else(|| wrong("no such array in MATLAB 5 format, or a damaged one".to_owned()))?;
    let values = array.values;
    let size: Vec<usize> = array.size.iter().map(|&side| side as usize).collect();
    if size != [height, width, 3] || values.len() != 3 * area {
        return Err(wrong(format!("{} numbers, size {size:?}", values.len())));
    }
    // MATLAB stores columns first.
    let normals = (0..area)
        .map(|pixel| {
            let index = pixel / width + height * (pixel % width);
            let component = |plane: usize| values[plane * area + index] as f32;
            Vec3::new(component(0), component(1), component(2))
        })
        .collect();
    Ok(NormalMap::new(width, height, normals))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_before_pictures_and_maps_are_no_truth() {
        let among = |names: &[&'static str]| truth_among(names).map(|index| names[index]);
        let both = ["a/001.png", "a/Normal_gt.png", "a/Normal_gt.mat"];
        assert_eq!(among(&both), Some("a/Normal_gt.mat"));
        assert_eq!(
            among(&["normals.png", "normal_true.exr"]),
            Some("normal_true.exr")
        );
        assert_eq!(
            among(&["normals.png", "normal_map.tif", "gt.png", "Normal_gt.txt"]),
            None
        );
    }
}
