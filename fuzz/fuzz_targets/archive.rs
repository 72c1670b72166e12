//! Archives, and the pages of a TIFF, and all that is in them.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::said;
use normalight_io::{NamedBytes, UnpackedFiles};

const NAMES: [&str; 4] = ["a.zip", "a.tar", "a.tar.gz", "a.tif"];

fuzz_target!(|content: &[u8]| {
    // The first byte chooses the name.
    let Some((kind, bytes)) = content.split_first() else {
        return;
    };
    let name = NAMES[usize::from(*kind) % NAMES.len()];
    let file = NamedBytes {
        name: name.to_owned(),
        bytes: bytes.to_vec(),
    };
    let Some(Some(mut unpacked)) = said(name, UnpackedFiles::open(file)) else {
        return;
    };
    let names = unpacked.names().to_vec();
    for (index, path) in names.iter().enumerate() {
        // Nothing leads out of the archive.
        assert!(!path.starts_with('/') && path.split('/').all(|part| part != ".."), "{path}");
        if let Some(file) = said(name, unpacked.take(index)) {
            assert_eq!(&file.name, path);
        }
    }
});
