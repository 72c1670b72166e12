//! Whatever is wrong with the input: one line that names it, nothing written, earlier results kept.
use crate::common::*;
use image::{DynamicImage, Rgb32FImage, RgbImage};
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// A stack to spoil, and a folder with an earlier result.
struct Bench {
    place: TempDir,
    photographs: PathBuf,
    out: PathBuf,
}

impl Bench {
    fn new() -> Self {
        let place = tempfile::tempdir().unwrap();
        let (photographs, out) = (place.path().join("vase"), place.path().join("out"));
        write_stack(&photographs, &sample());
        std::fs::create_dir(&out).unwrap();
        std::fs::write(out.join("normals.png"), "earlier").unwrap();
        Self {
            place,
            photographs,
            out,
        }
    }

    fn image(&self, number: usize) -> PathBuf {
        self.photographs.join(format!("{number:03}.png"))
    }

    /// A file beside the stack.
    fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.place.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }

    /// Checks that estimating fails with all the parts in its message, and leaves nothing.
    fn fails(&self, more: &[&str], parts: &[&str]) {
        fails(estimate(&self.photographs, &self.out, more), parts);
        assert_eq!(files(&self.out), ["normals.png"]);
        let earlier = std::fs::read_to_string(self.out.join("normals.png")).unwrap();
        assert_eq!(earlier, "earlier");
        // A folder that was only made for the results goes again.
        let fresh = self.place.path().join("fresh/deep");
        fails(estimate(&self.photographs, &fresh, more), parts);
        assert!(!self.place.path().join("fresh").exists());
    }
}

#[test]
fn files_that_are_no_complete_images() {
    let bench = Bench::new();
    let whole = std::fs::read(bench.image(3)).unwrap();
    std::fs::write(bench.image(3), "hello").unwrap();
    bench.fails(&[], &["003.png", "expected an image"]);
    std::fs::write(bench.image(3), &whole[..whole.len() / 2]).unwrap();
    bench.fails(&[], &["003.png", "complete PNG"]);
    std::fs::write(bench.image(3), "").unwrap();
    bench.fails(&[], &["003.png", "empty"]);
    std::fs::write(bench.image(3), b"\0\0\0\x18ftypheic\0\0\0\0mif1heic").unwrap();
    bench.fails(&[], &["003.png", "HEIC", "export"]);
}

#[test]
fn images_that_do_not_fit() {
    let bench = Bench::new();
    // One alone is left out; of halves nobody can tell which are meant.
    for number in 5..=IMAGES {
        RgbImage::new(48, 47).save(bench.image(number)).unwrap();
    }
    bench.fails(&[], &["005.png", "48x47", "48x48"]);
    for number in 1..=IMAGES {
        RgbImage::new(48, 48).save(bench.image(number)).unwrap();
    }
    bench.fails(&[], &["vase", "black"]);
    for number in 1..=IMAGES {
        RgbImage::new(1, 1).save(bench.image(number)).unwrap();
    }
    bench.fails(&[], &["001.png", "1x1"]);
}

#[test]
fn too_few_images() {
    let bench = Bench::new();
    bench.fails(&["--images", "2"], &["vase", "2 image(s)", "at least 3"]);
    for number in 3..=IMAGES {
        std::fs::remove_file(bench.image(number)).unwrap();
    }
    bench.fails(&[], &["vase", "2 image(s)", "at least 3"]);
    std::fs::remove_dir_all(&bench.photographs).unwrap();
    bench.fails(&[], &["vase", "cannot be read"]);
}

/// A header that promises 20000 x 20000 pixels: refused before memory is taken.
#[test]
fn an_image_beyond_the_limit() {
    let bench = Bench::new();
    let mut bitmap = b"BM".to_vec();
    for word in [
        54u32 + 1_200_000_000,
        0,
        54,
        40,
        20_000,
        20_000,
        1 | 24 << 16,
    ] {
        bitmap.extend(word.to_le_bytes());
    }
    bitmap.resize(54, 0);
    std::fs::write(bench.photographs.join("000.bmp"), bitmap).unwrap();
    bench.fails(&[], &["000.bmp", "20000x20000", "at most"]);
}

#[test]
fn numbers_that_are_none() {
    let bench = Bench::new();
    let lights = bench.place.path().join("lights.txt");
    std::fs::write(&lights, "nan 0 1\n".repeat(IMAGES)).unwrap();
    bench.fails(
        &["--lights", path(&lights)],
        &["lights.txt", "line 1", "finite"],
    );
    // In photographs there is nothing where they have none.
    let mut picture = Rgb32FImage::from_pixel(48, 48, image::Rgb([0.3; 3]));
    picture.get_pixel_mut(20, 20)[1] = f32::NAN;
    let file = bench.photographs.join("000.exr");
    DynamicImage::ImageRgb32F(picture).save(file).unwrap();
    let command = normalight(&["estimate", path(&bench.photographs), "--dry-run"]);
    assert!(said(command).contains("000.exr: 1 samples are no numbers (NaN)"));
}

#[test]
fn masks_that_do_not_fit() {
    let bench = Bench::new();
    let mask = bench.photographs.join("mask.png");
    write_mask(&mask, 48, |_, _| false);
    bench.fails(&[], &["mask.png", "empty"]);
    // Another shape of the frame; the same shape of another size is scaled.
    let oblong = |path: &Path, height| {
        let white = image::GrayImage::from_pixel(40, height, image::Luma([255]));
        white.save(path).unwrap();
    };
    oblong(&mask, 30);
    bench.fails(&[], &["mask.png", "40x30", "48x48"]);
    let other = bench.place.path().join("other.png");
    oblong(&other, 47);
    bench.fails(&["--mask", path(&other)], &["other.png", "40x47"]);
    bench.fails(&["--mask", "gone.png"], &["gone.png", "cannot be read"]);
    let text = bench.file("text.png", "no mask");
    bench.fails(&["--mask", path(&text)], &["text.png", "expected an image"]);
}

#[test]
fn lights_that_do_not_fit() {
    let bench = Bench::new();
    let lights = bench.file("lights.txt", "0 0 1\n".repeat(7));
    bench.fails(&["--lights", path(&lights)], &["lights.txt", "7", "8"]);
    let lights = bench.file("lights.txt", "0 0 zero\n");
    bench.fails(
        &["--lights", path(&lights)],
        &["lights.txt, line 1", "0 0 zero"],
    );
    bench.fails(&["--lights", "gone.lp"], &["gone.lp", "cannot be read"]);
}

#[test]
fn weights_that_are_none() {
    let bench = Bench::new();
    for option in ["--light-weights", "--normal-weights"] {
        bench.fails(
            &[option, "gone.safetensors"],
            &["gone.safetensors", "cannot be read"],
        );
        let corrupt = bench.file("corrupt.safetensors", [7; 100]);
        bench.fails(
            &[option, path(&corrupt)],
            &["corrupt.safetensors", "weights"],
        );
    }
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/default");
    let light = models.join("light.safetensors");
    bench.fails(
        &["--normal-weights", path(&light)],
        &["light.safetensors", "normal network"],
    );
    let mut bytes = std::fs::read(&light).unwrap();
    bytes.truncate(bytes.len() - 1);
    let cut = bench.file("cut.safetensors", bytes);
    bench.fails(
        &["--light-weights", path(&cut)],
        &["cut.safetensors", "weights"],
    );
}

#[test]
fn places_that_cannot_be_written_to() {
    let bench = Bench::new();
    let file = bench.file("file", "mine");
    for out in [file.clone(), file.join("below")] {
        fails(
            estimate(&bench.photographs, &out, &[]),
            &[path(&out), "cannot be written"],
        );
    }
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    // Among the photographs, results would replace the user's own files.
    let before = files(&bench.photographs);
    let spelled_otherwise = bench.photographs.join("../vase");
    fails(
        estimate(&bench.photographs, &spelled_otherwise, &[]),
        &["vase", "another folder"],
    );
    assert_eq!(files(&bench.photographs), before);
}

#[test]
fn wrong_usage() {
    let usage = |arguments: &[&str]| {
        let output = ended(normalight(arguments), 2);
        String::from_utf8(output.stderr).unwrap()
    };
    assert!(usage(&["estimate", "vase"]).contains("--out"));
    assert!(usage(&["estimate", "--out", "x"]).contains("INPUT"));
    assert!(usage(&["estimate", "vase", "--out", "x", "--color", "green"]).contains("linear"));
}

#[test]
fn help_has_an_example_and_hides_what_is_for_tests() {
    for (arguments, part) in [
        (&["--help"][..], "normalight estimate vase"),
        (&["estimate", "--help"], "--normal-format directx"),
        (&["train", "--help"], "--resume"),
        (&["evaluate", "--help"], "--images 96,16,8"),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_normalight"));
        command.args(arguments);
        let said = said(command);
        assert!(said.contains(part), "{said}");
        assert!(!said.contains("software-gpu"), "{said}");
    }
}
