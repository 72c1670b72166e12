//! Stored scenes: safetensors with an arbitrary header, its length right.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{sorted_safetensors, two_parts};
use normalight_synth::{Preset, Scene};

fuzz_target!(|data: &[u8]| {
    let Some((header, numbers)) = two_parts(data) else {
        return;
    };
    let mut file = (header.len() as u64).to_le_bytes().to_vec();
    file.extend(header);
    file.extend(numbers);
    let recipe = Preset::World.recipe();
    for crop in [None, Some(8)] {
        let _ = Scene::from_bytes(&recipe, "scene", &file, crop);
        let _ = Scene::from_bytes(&recipe, "scene", data, crop);
    }
    // Sorting a header twice changes nothing more.
    let once = sorted_safetensors(file);
    assert_eq!(sorted_safetensors(once.clone()), once);
});
