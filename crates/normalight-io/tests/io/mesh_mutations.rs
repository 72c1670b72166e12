//! Damaged meshes must give an error or a mesh, never a panic.
use crate::common::meshes::{CUBE_OBJ, PlyKind, cube_glb, cube_ply};
use normalight_io::read_mesh;
use proptest::prelude::*;

fn samples() -> Vec<(&'static str, Vec<u8>)> {
    let mut files = vec![
        ("a.obj", CUBE_OBJ.as_bytes().to_vec()),
        ("a.glb", cube_glb()),
    ];
    for kind in [PlyKind::Ascii, PlyKind::Little, PlyKind::Big] {
        files.push(("a.ply", cube_ply(kind, "double", "vertex_indices")));
    }
    files
}

#[test]
fn single_bytes_and_every_length() {
    for (name, whole) in samples() {
        for at in 0..whole.len() {
            for value in [0, 0x7F, 0x80, 0xFF, b'9', b'-', b'\n', whole[at] ^ 1] {
                let mut bytes = whole.clone();
                bytes[at] = value;
                let _ = read_mesh(name, &bytes);
            }
            let _ = read_mesh(name, &whole[..at]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_damage(
        which in 0usize..1000,
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
        digits in any::<bool>(),
        keep in any::<prop::sample::Index>(),
        cut in any::<bool>(),
    ) {
        let files = samples();
        let (name, mut bytes) = files[which % files.len()].clone();
        for (at, value) in edits {
            // Digits keep texts readable, so that the damage gets further.
            let at = at.index(bytes.len());
            bytes[at] = if digits { b'0' + value % 10 } else { value };
        }
        if cut {
            bytes.truncate(keep.index(bytes.len()));
        }
        let _ = read_mesh(name, &bytes);
    }

    #[test]
    fn noise_as_anything(noise in proptest::collection::vec(any::<u8>(), 0..200)) {
        for (name, whole) in samples() {
            for head in [0, 12, 20, 60] {
                let mut bytes = whole[..head].to_vec();
                bytes.extend(&noise);
                let _ = read_mesh(name, &bytes);
            }
        }
    }

    #[test]
    fn strange_faces(corners in proptest::collection::vec(any::<i64>(), 0..6), slash in any::<bool>()) {
        let separator = if slash { "/7/-9 " } else { " " };
        let corners: String = corners.iter().map(|corner| format!("{corner}{separator}")).collect();
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf {corners}\n");
        let _ = read_mesh("a.obj", text.as_bytes());
    }
}
