//! A folder in memory: photographs of one size, a mask, a list, lights.
#![no_main]
use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{Png, check_lights, check_mask};
use normalight_io::{AmbientChoice, ColorMode, LightAxes, MaskChoice, NamedBytes, ReadOptions, read_stack};

#[derive(Debug, Arbitrary)]
struct Folder {
    size: (u8, u8),
    photographs: Vec<(Option<String>, Png)>,
    mask: Option<Png>,
    other: Vec<(String, Vec<u8>)>,
    color: u8,
    whole_frame: bool,
    ambient: bool,
    align: bool,
    images: Option<u8>,
    lights: Vec<u8>,
}

fuzz_target!(|folder: Folder| {
    let mut files = Vec::new();
    let mut add = |name: String, mut png: Png| {
        (png.width, png.height) = folder.size;
        png.complete = true;
        files.push(NamedBytes {
            name,
            bytes: png.bytes(),
        });
    };
    for (place, (name, png)) in folder.photographs.into_iter().take(8).enumerate() {
        let name = name.map_or(format!("{place}.png"), |name| format!("{name}{place}.png"));
        add(name, png);
    }
    if let Some(mask) = folder.mask {
        add("mask.png".to_owned(), mask);
    }
    let others = folder.other.into_iter().take(4);
    files.extend(others.map(|(name, bytes)| NamedBytes { name, bytes }));
    let options = ReadOptions {
        color: [ColorMode::Auto, ColorMode::Linear, ColorMode::Srgb][usize::from(folder.color) % 3],
        mask: if folder.whole_frame {
            MaskChoice::WholeFrame
        } else {
            MaskChoice::Auto
        },
        images: folder.images.map(usize::from),
        ambient: match folder.ambient {
            true => AmbientChoice::Auto,
            false => AmbientChoice::LeaveOut,
        },
        align: folder.align,
        ..ReadOptions::default()
    };
    let Ok(input) = read_stack(files, &options) else {
        return;
    };
    let stack = &input.stack;
    check_mask(&input.mask, stack.width(), stack.height());
    assert!(input.mask.count() > 0);
    assert_eq!(input.picked.len(), stack.len());
    assert_eq!(input.plan.photographs, input.picked_names());
    // Said without a panic, shortly and at length.
    assert!(!format!("{}", input.plan).is_empty() && !format!("{:#}", input.plan).is_empty());
    if let Ok(given) = input.given_lights("l.lp", &folder.lights, LightAxes::default()) {
        check_lights(&given.lights, stack.len());
    }
});
