//! Arrays of MATLAB files, plain and compressed.
#![no_main]
use flate2::Compression;
use flate2::write::ZlibEncoder;
use libfuzzer_sys::fuzz_target;
use std::io::Write;

const LIMIT: u64 = 1 << 20;

fuzz_target!(|data: &[u8]| {
    let mut file = vec![b' '; 126];
    file.extend(b"IM");
    let plain = [&file[..], data].concat();
    check(&plain);
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(data).expect("memory takes all");
    let packed = encoder.finish().expect("memory takes all");
    file.extend(15u32.to_le_bytes());
    file.extend((packed.len() as u32).to_le_bytes());
    file.extend(packed);
    check(&file);
});

fn check(file: &[u8]) {
    if let Some((_, values)) = normalight_io::fuzzing::matlab_array(file, "Normal_gt", LIMIT) {
        assert!(4 * values.len() as u64 <= LIMIT);
    }
}
