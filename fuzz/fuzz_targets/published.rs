//! The list of an object's images in the published layout.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{check_lights, said};

fuzz_target!(|text: &str| {
    let read = normalight_io::fuzzing::published_lights("a_b.txt", text);
    if let Some(images) = said("a_b.txt", read) {
        let lights: Vec<_> = images.iter().map(|(_, light)| *light).collect();
        check_lights(&lights, images.len());
        // No name leads out of the folder.
        assert!(
            images
                .iter()
                .all(|(name, _)| !name.contains(['/', '\\']) && name != "..")
        );
    }
});
