//! Meshes as binary glTF: an arbitrary document and binary chunk, their lengths right.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{check_mesh, two_parts};

fuzz_target!(|data: &[u8]| {
    let Some((json, binary)) = two_parts(data) else {
        return;
    };
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((12 + 8 + json.len() as u32 + 8 + binary.len() as u32).to_le_bytes());
    for (kind, content) in [(b"JSON", json), (b"BIN\0", binary)] {
        file.extend((content.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(content);
    }
    check_mesh("a.glb", &file);
    check_mesh("a.glb", data);
});
