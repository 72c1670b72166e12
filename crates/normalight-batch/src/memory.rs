//! How much memory a job will take.
use crate::inputs::Listing;
use crate::{Capture, CaptureKind};
use image::{ImageDecoder, ImageReader};
use std::path::Path;
use sysinfo::{MemoryRefreshKind, RefreshKind, System};

/// Program, weights, and the tiles of the networks.
const BASE: u64 = 400 << 20;

/// Bytes for each pixel of a photograph besides the stack: brightest values, mask, normals, albedo and results in the making.
const EACH_PIXEL: u64 = 120;

/// Bytes of samples for each byte of a packed photograph, where no header can be read: good JPEG files and more.
const PACKED: u64 = 12;

/// What the header of a photograph says.
struct Header {
    pixels: u64,
    /// Bytes of one pixel, with its channels.
    depth: u64,
}

/// Bytes that the estimate of a capture is expected to take:
///
/// `400 MiB + photographs * pixels * channels * bytes of a sample + 120 * pixels`
///
/// with pixels, channels (no more than 3) and bytes of a sample (1, 2, or 4 of floats) from the header of the largest file
/// that has one. A stack keeps samples as they are decoded, so the second term is its size. Where no
/// header can be read, as in archives, twelve times the size of all files stands for the last two terms.
pub(crate) fn needed(capture: &Capture, files: &Listing) -> u64 {
    let header = match capture.kind {
        CaptureKind::Archive => None,
        _ => files.largest_first().find_map(|path| header(&path)),
    };
    let work = match (header, capture.photographs) {
        (Some(Header { pixels, depth }), Some(photographs)) => {
            let stack = pixels.saturating_mul(depth);
            stack
                .saturating_mul(photographs as u64)
                .saturating_add(pixels.saturating_mul(EACH_PIXEL))
        }
        _ => files.bytes().saturating_mul(PACKED),
    };
    work.saturating_add(BASE)
}

/// Size and depth of an image without its samples; `None` for what is none.
fn header(path: &Path) -> Option<Header> {
    let reader = ImageReader::open(path).ok()?.with_guessed_format().ok()?;
    let decoder = reader.into_decoder().ok()?;
    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    let channels = u64::from(color.channel_count());
    Some(Header {
        pixels: u64::from(width) * u64::from(height),
        // Transparency is no sample of the stack; two channels are grey and transparency.
        depth: u64::from(color.bytes_per_pixel()) / channels.max(1)
            * [1, 1, 1, 3, 3][channels.min(4) as usize],
    })
}

/// Bytes of memory that nobody uses now, within the limit that a container sets; `None` where the system does not say.
pub fn available_memory() -> Option<u64> {
    let what = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let system = System::new_with_specifics(what);
    let free = match system.available_memory() {
        // Some systems say only what is not used at all.
        0 => system.free_memory(),
        free => free,
    };
    let limit = system
        .cgroup_limits()
        .map_or(u64::MAX, |limits| limits.free_memory);
    Some(free.min(limit)).filter(|&bytes| bytes > 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::find_captures;
    use image::{DynamicImage, ImageFormat};

    /// What is needed for three photographs of 100 x 50 pixels like this one.
    fn of(image: DynamicImage, format: ImageFormat, extension: &str) -> u64 {
        let place = tempfile::tempdir().unwrap();
        for index in 0..3 {
            let path = place.path().join(format!("{index}.{extension}"));
            image.save_with_format(path, format).unwrap();
        }
        // Neither notes nor small pictures count.
        std::fs::write(place.path().join("about.txt"), "no header").unwrap();
        let preview = DynamicImage::new_luma8(2, 2);
        preview.save(place.path().join("0-preview.png")).unwrap();
        let found = find_captures(place.path()).unwrap();
        let capture = &found.captures[0];
        needed(capture, &Listing::of(place.path(), capture.kind).unwrap())
    }

    #[test]
    fn samples_count_as_a_stack_keeps_them() {
        let without = BASE + 5000 * EACH_PIXEL;
        let png = |image| of(image, ImageFormat::Png, "png") - without;
        assert_eq!(png(DynamicImage::new_luma8(100, 50)), 3 * 5000);
        assert_eq!(png(DynamicImage::new_luma_a8(100, 50)), 3 * 5000);
        assert_eq!(png(DynamicImage::new_rgba8(100, 50)), 3 * 5000 * 3);
        assert_eq!(png(DynamicImage::new_rgb16(100, 50)), 3 * 5000 * 6);
        let exr = of(
            DynamicImage::new_rgb32f(100, 50),
            ImageFormat::OpenExr,
            "exr",
        );
        assert_eq!(exr - without, 3 * 5000 * 12);
        let tga = of(DynamicImage::new_rgb8(100, 50), ImageFormat::Tga, "tga");
        assert_eq!(tga - without, 3 * 5000 * 3);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn there_is_not_more_memory_than_the_machine_has() {
        let text = std::fs::read_to_string("/proc/meminfo").unwrap();
        let total = text.lines().find(|line| line.starts_with("MemTotal:"));
        let total: u64 = total
            .unwrap()
            .split_whitespace()
            .nth(1)
            .unwrap()
            .parse()
            .unwrap();
        let available = available_memory().unwrap();
        assert!((1 << 20..=total << 10).contains(&available), "{available}");
    }

    #[test]
    fn without_a_header_the_size_of_the_files_counts() {
        let place = tempfile::tempdir().unwrap();
        std::fs::write(place.path().join("a.zip"), [b'x'; 1000]).unwrap();
        let found = find_captures(place.path()).unwrap();
        let path = place.path().join("a.zip");
        let files = Listing::of(&path, CaptureKind::Archive).unwrap();
        assert_eq!(needed(&found.captures[0], &files), BASE + 12 * 1000);
    }
}
