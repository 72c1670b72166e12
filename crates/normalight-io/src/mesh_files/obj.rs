use normalight_core::DepthMesh;
use std::fmt::Write;

/// Names of the files that `mesh.obj` refers to.
pub(super) const MATERIAL_FILE: &str = "mesh.mtl";
pub(super) const TEXTURE_FILE: &str = "mesh.png";

/// Text; `v`, `vt` (upwards from the lower left) and `vn` have the same numbers.
pub(super) fn write(mesh: &DepthMesh, textured: bool) -> Vec<u8> {
    let mut text = String::with_capacity(90 * mesh.positions.len() + 60 * mesh.triangles.len());
    if textured {
        text += &format!("mtllib {MATERIAL_FILE}\n");
    }
    for (vertex, (place, normal)) in mesh.positions.iter().zip(&mesh.normals).enumerate() {
        let [right, down] = mesh.texture_place(vertex);
        // Writing into memory cannot fail.
        let _ = writeln!(text, "v {} {} {}", place.x, place.y, place.z);
        let _ = writeln!(text, "vt {right} {}", 1.0 - down);
        let _ = writeln!(text, "vn {} {} {}", normal.x, normal.y, normal.z);
    }
    if textured {
        text += "usemtl surface\n";
    }
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| corner + 1);
        let _ = writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}");
    }
    text.into_bytes()
}

/// A matte material with the texture as its colour.
pub(super) fn material() -> Vec<u8> {
    format!("newmtl surface\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {TEXTURE_FILE}\n")
        .into_bytes()
}
