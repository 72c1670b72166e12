//! Lights as an array of numpy: the head is arbitrary text, its length is right.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{check_lights, said, two_parts};
use normalight_io::read_lights;

fuzz_target!(|data: &[u8]| {
    let Some((head, numbers)) = two_parts(data) else {
        return;
    };
    let mut file = b"\x93NUMPY\x01\0".to_vec();
    file.extend((head.len() as u16).to_le_bytes());
    file.extend(head);
    file.extend(numbers);
    let names: Vec<String> = (0..4).map(|place| format!("{place}.png")).collect();
    if let Some(lights) = said("l.npy", read_lights("l.npy", &file, &names)) {
        check_lights(&lights, names.len());
    }
    // Another version, whose length has four bytes, and a head that is cut.
    let _ = read_lights("l.npy", &[b"\x93NUMPY\x02\0", data].concat(), &names);
});
