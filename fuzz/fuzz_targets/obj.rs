//! Meshes as OBJ files.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::check_mesh;

fuzz_target!(|data: &[u8]| check_mesh("a.obj", data));
