//! A small rendered stack in files, and the command under test.
#![allow(dead_code)]
pub mod benchmark;

use image::{DynamicImage, GrayImage, ImageBuffer, Luma, Rgb};
use normalight_core::Samples;
use normalight_synth::{BitDepth, Framing, Renderer, Sample, SceneRecipe};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// Images of the stack.
pub const IMAGES: usize = 8;

/// Side of the images in pixels.
pub const SIZE: usize = 48;

/// Every file that `estimate` leaves, with more than one view.
pub const OUTPUTS: [&str; 9] = [
    "normals.png",
    "normals.npy",
    "lights.csv",
    "lights.lp",
    "lights.svg",
    "albedo.png",
    "mask.png",
    "normals-error.png",
    "report.json",
];

/// The command, on the processor: a GPU may give other last digits.
pub fn normalight(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_normalight"));
    command.args(arguments).args(["--device", "cpu"]);
    command
}

/// `estimate` of a folder into another.
pub fn estimate(folder: &Path, out: &Path, more: &[&str]) -> Command {
    let mut command = normalight(&["estimate", path(folder), "--out", path(out)]);
    command.args(more);
    command
}

pub fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Runs a command that must end with this code.
pub fn ended(mut command: Command, code: i32) -> Output {
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{said}");
    output
}

/// What a command that must succeed says on the standard output.
pub fn said(command: Command) -> String {
    let output = ended(command, 0);
    String::from_utf8(output.stdout).unwrap()
}

/// Checks that a command fails with code 1 and one line that holds all the parts.
pub fn fails(command: Command, parts: &[&str]) {
    let output = ended(command, 1);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.starts_with("error: ") && said.trim_end().lines().count() == 1,
        "{said}"
    );
    for part in parts {
        assert!(said.contains(part), "{part:?} is missing in {said:?}");
    }
}

/// Names of the files in a folder, in order.
pub fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

pub fn sample() -> Sample {
    let renderer = Renderer::new(SceneRecipe::default()).unwrap();
    renderer.sample(7, IMAGES, SIZE, Framing::WholeObject)
}

/// A folder with the stack, and where results go.
pub fn prepared() -> (TempDir, PathBuf, PathBuf) {
    let place = tempfile::tempdir().unwrap();
    let (photographs, out) = (place.path().join("vase"), place.path().join("out/deep"));
    write_stack(&photographs, &sample());
    (place, photographs, out)
}

/// Writes the photographs as 16-bit PNG, and the mask.
pub fn write_stack(folder: &Path, sample: &Sample) {
    std::fs::create_dir_all(folder).unwrap();
    let side = sample.size as u32;
    for image in sample.to_stack_images(BitDepth::Sixteen) {
        let Samples::U16(samples) = image.samples else {
            panic!("16 bits were asked for");
        };
        let pixels = ImageBuffer::<Rgb<u16>, _>::from_raw(side, side, samples).unwrap();
        DynamicImage::ImageRgb16(pixels)
            .save(folder.join(image.name))
            .unwrap();
    }
    write_mask(&folder.join("mask.png"), side, |x, y| {
        sample.mask[(y * side + x) as usize]
    });
}

pub fn write_mask(path: &Path, side: u32, inside: impl Fn(u32, u32) -> bool) {
    GrayImage::from_fn(side, side, |x, y| Luma([255 * u8::from(inside(x, y))]))
        .save(path)
        .unwrap();
}

/// The vectors of a normals.npy of our size, after a look at its header.
pub fn read_npy(path: &Path) -> Vec<[f32; 3]> {
    let bytes = std::fs::read(path).unwrap();
    assert!(bytes.starts_with(b"\x93NUMPY\x01\x00"));
    let end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = std::str::from_utf8(&bytes[10..end]).unwrap();
    let shape = format!("({SIZE}, {SIZE}, 3");
    for part in ["'<f4'", "'fortran_order': False", &shape] {
        assert!(header.contains(part), "{part} is missing in {header}");
    }
    let values: Vec<f32> = bytes[end..]
        .chunks_exact(4)
        .map(|four| f32::from_le_bytes(four.try_into().unwrap()))
        .collect();
    assert_eq!(values.len(), 3 * SIZE * SIZE);
    values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect()
}

/// One line of a lights.csv.
pub struct CsvLight {
    pub file: String,
    pub direction: [f32; 3],
    pub intensity: f32,
    pub confidence: f32,
}

pub fn read_csv(path: &Path) -> Vec<CsvLight> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("file,x,y,z,intensity,confidence"));
    lines
        .map(|line| {
            let (file, numbers) = line.split_once(',').unwrap();
            let numbers: Vec<f32> = numbers.split(',').map(|n| n.parse().unwrap()).collect();
            let &[x, y, z, intensity, confidence] = numbers.as_slice() else {
                panic!("five numbers are expected: {line}");
            };
            CsvLight {
                file: file.to_owned(),
                direction: [x, y, z],
                intensity,
                confidence,
            }
        })
        .collect()
}

pub fn read_json(path: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}
