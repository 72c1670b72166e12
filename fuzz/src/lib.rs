//! What the fuzz targets share: what must hold of every result, and files built around arbitrary parts.
mod genotype_files;
mod png;
mod tiff;

pub use genotype_files::{ModelError, genotype, sorted_safetensors};
pub use png::{Chunk, Png};
pub use tiff::Tiff;

use normalight_core::{Light, Mask, Samples, StackImage};
use normalight_io::{
    ColorMode, IoError, MAX_PIXELS, decode_image, lights_csv, lights_lp, read_lights, read_mesh,
};

/// Decodes and checks: the size is within the limit, every pixel has its samples, the transparency
/// fits, infinite values were brought down. An error names the file and is no longer than people read.
pub fn check_decoding(name: &str, bytes: &[u8]) -> Option<StackImage> {
    let decoded = said(name, decode_image(name, bytes, ColorMode::Auto))?;
    let image = decoded.image;
    check_image(&image);
    if let Some(alpha) = &decoded.alpha {
        check_mask(alpha, image.width, image.height);
    }
    Some(image)
}

fn check_image(image: &StackImage) {
    let pixels = image.width * image.height;
    assert!(pixels > 0 && pixels as u64 <= MAX_PIXELS, "{pixels} pixels");
    assert!(
        matches!(image.channels, 1 | 3),
        "{} channels",
        image.channels
    );
    let samples = match &image.samples {
        Samples::U8(codes) => codes.len(),
        Samples::U16(codes) => codes.len(),
        Samples::F32(values) => {
            // Without any light there is nothing that infinite light could be brought down to.
            let lit = values.iter().any(|value| value.is_finite() && *value > 0.0);
            let infinite = values.iter().any(|value| value.is_infinite());
            assert!(!(lit && infinite), "infinite samples");
            values.len()
        }
    };
    assert_eq!(samples, pixels * image.channels);
}

/// A mask has the size of its image.
pub fn check_mask(mask: &Mask, width: usize, height: usize) {
    assert_eq!((mask.width(), mask.height()), (width, height));
    assert_eq!(mask.inside().len(), width * height);
}

/// The result, if there is one; an error must name the file and be of a length that people read.
pub fn said<T>(name: &str, result: Result<T, IoError>) -> Option<T> {
    match result {
        Ok(value) => Some(value),
        Err(error) => {
            let text = error.to_string();
            assert!(text.contains(name), "no name in {text:?}");
            assert!(
                text.len() < name.len() + 1000,
                "{} bytes: {text:?}",
                text.len()
            );
            None
        }
    }
}

/// Lights are unit vectors of finite, positive intensity, as many as there are photographs.
pub fn check_lights(lights: &[Light], photographs: usize) {
    assert_eq!(lights.len(), photographs);
    for light in lights {
        assert!((light.direction.length() - 1.0).abs() < 1e-4, "{light:?}");
        let positive = |value: f32| value.is_finite() && value > 0.0;
        assert!(light.intensity.into_iter().all(positive), "{light:?}");
        assert!((0.0..=1.0).contains(&light.confidence), "{light:?}");
    }
}

/// Reads and checks: every corner has its position, every position is finite.
pub fn check_mesh(name: &str, bytes: &[u8]) {
    if let Some(mesh) = said(name, read_mesh(name, bytes)) {
        let vertices = mesh.positions().len();
        assert!(mesh.positions().iter().all(|position| position.is_finite()));
        let corners = mesh.triangles().iter().flatten();
        assert!(corners.clone().count() > 0);
        assert!(corners.clone().all(|&corner| (corner as usize) < vertices));
    }
}

/// What is written of lights is read again.
pub fn check_writing(names: &[String], lights: &[Light]) {
    let csv = lights_csv(names, lights).expect("as many names as lights");
    let read = read_lights("lights.csv", &csv, names);
    let read = read.unwrap_or_else(|error| panic!("{error}\n{}", String::from_utf8_lossy(&csv)));
    for (read, written) in read.iter().zip(lights) {
        assert!(read.direction.distance(written.direction) < 1e-4);
        let (one, other) = (read.mean_intensity(), written.mean_intensity());
        assert!((one - other).abs() <= 1e-4 * other, "{one} and {other}");
        assert_eq!(read.confidence, written.confidence);
    }
    let lp = lights_lp(names, lights).expect("as many names as lights");
    let read = read_lights("lights.lp", &lp, names);
    let read = read.unwrap_or_else(|error| panic!("{error}\n{}", String::from_utf8_lossy(&lp)));
    for (read, written) in read.iter().zip(lights) {
        assert!(read.direction.distance(written.direction) < 1e-4);
    }
}

/// Two parts of an input, the length of the first in two bytes before it: files made of a header and
/// its data, which a mutation of the header would tear apart.
pub fn two_parts(data: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = data.split_first_chunk::<2>()?;
    let length = usize::from(u16::from_le_bytes(*length));
    Some(rest.split_at(length.min(rest.len())))
}
