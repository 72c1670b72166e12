//! Lights of photographs with arbitrary names, written and read again.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_core::{Light, Vec3};
use normalight_fuzz::check_writing;

type Row = (String, [i16; 3], u16, u8);

fuzz_target!(|rows: Vec<Row>| {
    let mut names = Vec::new();
    let mut lights = Vec::new();
    for (place, (name, direction, intensity, confidence)) in rows.into_iter().enumerate() {
        // No two names mean the same file, whatever comes before the number.
        names.push(format!("{name} {place}.png"));
        let [x, y, z] = direction.map(f32::from);
        lights.push(Light {
            direction: Vec3::new(x, y, z.abs() + 1.0).normalize(),
            intensity: [(1.0 + f32::from(intensity)) / 1000.0; 3],
            confidence: f32::from(confidence) / 255.0,
        });
    }
    check_writing(&names, &lights);
});
