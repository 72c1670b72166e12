//! Images turned upright, as EXIF says.
use image::metadata::Orientation;
use normalight_core::{Samples, StackImage};

/// Whether width and height change places.
pub(crate) fn swaps_sides(orientation: Orientation) -> bool {
    matches!(
        orientation,
        Orientation::Rotate90
            | Orientation::Rotate270
            | Orientation::Rotate90FlipH
            | Orientation::Rotate270FlipH
    )
}

/// The image turned.
pub(crate) fn turned(image: StackImage, orientation: Orientation) -> StackImage {
    if orientation == Orientation::NoTransforms {
        return image;
    }
    let (width, height) = (image.width, image.height);
    let (new_width, new_height) = if swaps_sides(orientation) {
        (height, width)
    } else {
        (width, height)
    };
    // Where a pixel of the turned image comes from.
    let source = |place: usize| {
        let (x, y) = (place % new_width, place / new_width);
        let (x, y) = match orientation {
            Orientation::NoTransforms => (x, y),
            Orientation::FlipHorizontal => (width - 1 - x, y),
            Orientation::FlipVertical => (x, height - 1 - y),
            Orientation::Rotate180 => (width - 1 - x, height - 1 - y),
            Orientation::Rotate90 => (y, height - 1 - x),
            Orientation::Rotate270 => (width - 1 - y, x),
            Orientation::Rotate90FlipH => (y, x),
            Orientation::Rotate270FlipH => (width - 1 - y, height - 1 - x),
        };
        y * width + x
    };
    let sources: Vec<usize> = (0..width * height).map(source).collect();
    let channels = image.channels;
    let samples = match &image.samples {
        Samples::U8(codes) => Samples::U8(moved(codes, &sources, channels)),
        Samples::U16(codes) => Samples::U16(moved(codes, &sources, channels)),
        Samples::F32(values) => Samples::F32(moved(values, &sources, channels)),
    };
    StackImage {
        width: new_width,
        height: new_height,
        samples,
        ..image
    }
}

fn moved<T: Copy>(samples: &[T], sources: &[usize], channels: usize) -> Vec<T> {
    let pixels = sources
        .iter()
        .flat_map(|&pixel| &samples[pixel * channels..(pixel + 1) * channels]);
    pixels.copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{DynamicImage, RgbImage};
    use normalight_core::Transfer;

    /// Against the turns of an independent library.
    #[test]
    fn all_eight_orientations() {
        let picture = RgbImage::from_fn(4, 3, |x, y| image::Rgb([x as u8, y as u8, 7]));
        for exif in 1..=8 {
            let orientation = Orientation::from_exif(exif).unwrap();
            let mut expected = DynamicImage::ImageRgb8(picture.clone());
            expected.apply_orientation(orientation);
            let stored = StackImage {
                name: String::new(),
                width: 4,
                height: 3,
                channels: 3,
                samples: Samples::U8(picture.clone().into_raw()),
                transfer: Transfer::Linear,
            };
            let found = turned(stored, orientation);
            let size = (expected.width() as usize, expected.height() as usize);
            assert_eq!((found.width, found.height), size, "{exif}");
            assert_eq!(
                found.samples,
                Samples::U8(expected.into_rgb8().into_raw()),
                "{exif}"
            );
        }
    }
}
