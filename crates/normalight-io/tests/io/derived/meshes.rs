//! Meshes, read back.
use crate::derived::{SIDE, ball};
use normalight_core::Vec3;
use normalight_io::{MeshFileFormat, Texture, mesh_as_files, read_mesh};

#[test]
fn meshes_come_back_from_all_formats() {
    let (normals, _, depth) = ball();
    let mesh = depth.mesh(&normals, 1).unwrap();
    let pixels: Vec<[u8; 3]> = (0..SIDE * SIDE)
        .map(|k| [k as u8, (k / 256) as u8, 7])
        .collect();
    let texture = Texture {
        pixels: &pixels,
        png: b"stands for a picture",
    };
    for format in [
        MeshFileFormat::Glb,
        MeshFileFormat::Obj,
        MeshFileFormat::Ply,
    ] {
        for texture in [None, Some(texture)] {
            let files = mesh_as_files(&mesh, texture, format).unwrap();
            let (name, bytes) = &files[0];
            let read = read_mesh(name, bytes).unwrap();
            let scale = match format {
                MeshFileFormat::Glb => 1.0 / SIDE as f32,
                _ => 1.0,
            };
            assert_eq!(read.triangles(), mesh.triangles, "{format:?}");
            assert_eq!(read.positions().len(), mesh.positions.len());
            for (read, written) in read.positions().iter().zip(&mesh.positions) {
                assert!(
                    read.distance(*written * scale) < 1e-5 * scale.max(0.1),
                    "{format:?}"
                );
            }
            let expected = match (format, texture) {
                (MeshFileFormat::Obj, Some(_)) => 3,
                _ => 1,
            };
            assert_eq!(files.len(), expected);
        }
    }
    let few = Texture {
        pixels: &pixels[1..],
        png: b"",
    };
    assert!(mesh_as_files(&mesh, Some(few), MeshFileFormat::Ply).is_err());
}

/// What the project's own reader passes over.
#[test]
fn meshes_have_normals_colours_and_textures() {
    let (normals, _, depth) = ball();
    let mesh = depth.mesh(&normals, 2).unwrap();
    let pixels: Vec<[u8; 3]> = (0..SIDE * SIDE)
        .map(|k| [k as u8, (k / 256) as u8, 7])
        .collect();
    let texture = Some(Texture {
        pixels: &pixels,
        png: b"a picture",
    });
    let files = |format| mesh_as_files(&mesh, texture, format).unwrap();
    let ply = &files(MeshFileFormat::Ply)[0].1;
    let end = ply.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let header = String::from_utf8_lossy(&ply[..end]);
    assert!(header.contains("format binary_little_endian 1.0"));
    assert!(header.contains("property uchar red"));
    assert_eq!(
        ply.len(),
        end + 27 * mesh.positions.len() + 13 * mesh.triangles.len()
    );
    let color = &ply[end + 27 * 5 + 24..][..3];
    assert_eq!(color, pixels[mesh.pixels[5] as usize]);

    let obj = files(MeshFileFormat::Obj);
    assert_eq!(obj[1].0, "mesh.mtl");
    assert_eq!(obj[2], ("mesh.png", b"a picture".to_vec()));
    let mut text = &obj[0].1[..];
    let load = tobj::load_obj_buf(&mut text, &tobj::GPU_LOAD_OPTIONS, |path| {
        assert_eq!(path.to_str(), Some("mesh.mtl"));
        tobj::load_mtl_buf(&mut &obj[1].1[..])
    });
    let (models, materials) = load.unwrap();
    assert_eq!(
        materials.unwrap()[0].diffuse_texture.as_deref(),
        Some("mesh.png")
    );
    let read = &models[0].mesh;
    assert_eq!(read.normals.len(), 3 * mesh.normals.len());
    for (vertex, place) in read.texcoords.chunks(2).enumerate() {
        let [right, up] = [place[0], place[1]];
        let position = &read.positions[3 * vertex..];
        assert!(((right - 0.5) * SIDE as f32 - position[0]).abs() < 1e-3);
        assert!(((up - 0.5) * SIDE as f32 - position[1]).abs() < 1e-3);
    }

    let glb = &files(MeshFileFormat::Glb)[0].1;
    assert_eq!(glb.len() % 4, 0);
    assert_eq!(
        u32::from_le_bytes(glb[8..12].try_into().unwrap()) as usize,
        glb.len()
    );
    let json_length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let json: serde_json::Value = serde_json::from_slice(&glb[20..20 + json_length]).unwrap();
    let binary = &glb[20 + json_length + 8..];
    let view = &json["bufferViews"][json["images"][0]["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(&binary[start..start + 9], b"a picture");
    assert_eq!(
        json["buffers"][0]["byteLength"].as_u64().unwrap() as usize,
        binary.len()
    );
    let low = mesh
        .positions
        .iter()
        .fold(Vec3::MAX, |low, &place| low.min(place));
    assert_eq!(
        json["accessors"][0]["min"][2].as_f64().unwrap() as f32,
        low.z
    );
}
