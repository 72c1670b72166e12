//! How often the evidence is right, on rendered stacks: the table at [`Evidence`] comes from here.
//!
//!     normalight render --recipe FILE --count 90 --images 40 --size 112 --bits 16 --out FOLDER/NAME
//!     NORMALIGHT_RENDERED=FOLDER cargo test --release -p normalight-io --lib measured -- --ignored --nocapture
//!
//! The recipes store 16 linear bits, so that the same pictures can be taken both ways.
use super::{Evidence, of_stack};
use crate::{ColorMode, decode_image, decode_mask};
use normalight_core::{ImageStack, Mask, Samples, StackImage, Transfer, evenly_spaced_indices};
use std::fs;
use std::path::{Path, PathBuf};

/// Photographs of the stacks, in turn.
const IMAGES: [usize; 7] = [6, 8, 10, 12, 16, 24, 40];
/// Distances of the logarithm from 0 at which answers are counted.
const DISTANCES: [f32; 8] = [0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 10.0];

fn folders(path: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(path).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.is_dir());
    paths.sort();
    paths
}

fn scene(folder: &Path, count: usize) -> Option<(Vec<StackImage>, Mask)> {
    let name = folder.file_name()?.to_str()?;
    let mask = fs::read(folder.join(format!("{name}_mask.png"))).ok()?;
    let mask = decode_mask("mask.png", &mask).ok()?;
    let images = evenly_spaced_indices(40, count).into_iter().map(|k| {
        let file = fs::read(folder.join(format!("rendered/{:03}.png", k + 1))).ok()?;
        Some(decode_image("a.png", &file, ColorMode::Linear).ok()?.image)
    });
    Some((images.collect::<Option<_>>()?, mask))
}

/// The pictures in 8 bits with a curve.
fn stored(images: &[StackImage], curve: Transfer) -> ImageStack {
    let images = images.iter().map(|image| {
        let Samples::U16(codes) = &image.samples else {
            panic!("16 bits expected");
        };
        let code = |&code: &u16| (curve.encode(f32::from(code) / 65_535.0) * 255.0).round() as u8;
        StackImage {
            samples: Samples::U8(codes.iter().map(code).collect()),
            ..image.clone()
        }
    });
    ImageStack::new(images.collect()).unwrap()
}

#[test]
#[ignore = "needs rendered stacks"]
fn shares_of_right_answers() {
    let Some(root) = std::env::var_os("NORMALIGHT_RENDERED") else {
        println!("skipped: NORMALIGHT_RENDERED is not set");
        return;
    };
    let mut all = Vec::new();
    for set in folders(Path::new(&root)) {
        let mut found = Vec::new();
        for (number, folder) in folders(&set.join("Images")).iter().enumerate() {
            let Some((images, mask)) = scene(folder, IMAGES[number % IMAGES.len()]) else {
                continue;
            };
            let deep = ImageStack::new(images.clone()).unwrap();
            let linear = match number % 2 {
                0 => deep,
                _ => stored(&images, Transfer::Linear),
            };
            let encoded = stored(&images, Transfer::Srgb);
            for (stack, sign) in [(linear, -1.0), (encoded, 1.0)] {
                let answer = of_stack(&stack, &mask);
                let log = answer.map_or(0.0, |Evidence { factor, .. }| factor.ln());
                let agreed = answer.is_some_and(|answer| answer.agreed);
                // Positive where right.
                found.push((agreed, sign, sign * log));
            }
        }
        print(&set.file_name().unwrap().to_string_lossy(), &found);
        all.extend(found);
    }
    print("all", &all);
    assert!(!all.is_empty());
}

fn print(name: &str, found: &[(bool, f32, f32)]) {
    println!("{name}: {} stacks", found.len());
    for (word, agreed) in [("agreed", true), ("not agreed", false)] {
        for (kind, sign) in [("linear", -1.0), ("encoded", 1.0)] {
            let all = found.iter().filter(|(_, of, _)| *of == sign);
            let count = all.clone().count().max(1) as f32;
            let share = |within: &dyn Fn(f32) -> bool| {
                let inside = all
                    .clone()
                    .filter(|(a, _, log)| *a == agreed && within(*log));
                100.0 * inside.count() as f32 / count
            };
            for pair in DISTANCES.windows(2) {
                let [low, high] = [pair[0], pair[1]];
                println!(
                    "  {word}, {kind}: {low:.1} to {high:.1}: right {:.1} %, wrong {:.1} %",
                    share(&|log| log > low && log <= high),
                    share(&|log| log < -low && log >= -high),
                );
            }
        }
    }
}
