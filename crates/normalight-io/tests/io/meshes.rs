//! Meshes in three formats.
use crate::common::meshes::{
    CUBE_OBJ, PlyKind, cube_binary, cube_glb, cube_json, cube_ply, glb, positions, triangles,
};
use normalight_core::{CoreError, TriangleMesh, Vec3};
use normalight_io::{IoError, read_mesh};

fn fault(name: &str, bytes: &[u8]) -> IoError {
    let error = read_mesh(name, bytes).unwrap_err();
    assert!(error.to_string().starts_with(name), "{error}");
    error
}

fn core_fault(name: &str, bytes: &[u8]) -> CoreError {
    match fault(name, bytes) {
        IoError::Mesh { reason, .. } => reason,
        other => panic!("{other}"),
    }
}

fn format_fault(name: &str, bytes: &[u8]) -> String {
    let error = fault(name, bytes);
    assert!(matches!(error, IoError::MeshFormat { .. }), "{error}");
    error.to_string()
}

/// Smooth normal and place of every corner of every triangle.
fn corners(mesh: &TriangleMesh) -> Vec<(Vec3, Vec3)> {
    let found = mesh.corner_normals(std::f32::consts::PI);
    let normals = found.corners.as_flattened().iter();
    let places = mesh.triangles().as_flattened().iter();
    normals
        .zip(places)
        .map(|(&normal, &place)| {
            let place = mesh.positions()[place as usize];
            (found.normals[normal as usize], place)
        })
        .collect()
}

#[test]
fn one_cube_in_every_format() {
    let expected = TriangleMesh::new(positions(), triangles()).unwrap();
    assert_eq!(
        read_mesh("cube.OBJ", CUBE_OBJ.as_bytes()).unwrap(),
        expected
    );
    assert_eq!(read_mesh("a/cube.glb", &cube_glb()).unwrap(), expected);
    for kind in [PlyKind::Ascii, PlyKind::Little, PlyKind::Big] {
        for number in ["float", "double", "float32"] {
            for list in ["vertex_indices", "vertex_index"] {
                let mesh = read_mesh("cube.ply", &cube_ply(kind, number, list)).unwrap();
                assert_eq!(mesh, expected, "{kind:?} {number} {list}");
            }
        }
    }
    assert_eq!(expected.bounds(), (Vec3::NEG_ONE, Vec3::ONE));
    for (normal, position) in corners(&expected) {
        assert!(normal.dot(position.normalize()) > 0.99, "{position}");
    }
}

#[test]
fn nodes_are_placed() {
    let read = |nodes: &str| read_mesh("a.glb", &glb(&cube_json(nodes), &cube_binary())).unwrap();
    let half_turn = 0.5f32.sqrt();
    let mesh = read(&format!(
        r#"[{{"children":[1,2],"translation":[10,0,0]}},
            {{"mesh":0,"scale":[1,2,3],"rotation":[0,0,{half_turn},{half_turn}]}},
            {{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}}]"#
    ));
    assert_eq!(mesh.triangles().len(), 24);
    let (low, high) = mesh.bounds();
    assert!((low - Vec3::new(8.0, -1.0, -3.0)).length() < 1e-5, "{low}");
    assert!((high - Vec3::new(12.0, 1.0, 6.0)).length() < 1e-5, "{high}");
    // The mirrored cube must not be inside out.
    for (index, (normal, place)) in corners(&mesh).into_iter().enumerate() {
        let centre = Vec3::new(10.0, 0.0, if index < 36 { 0.0 } else { 5.0 });
        assert!(normal.dot(place - centre) > 0.0, "{index}");
    }
}

#[test]
fn strips_and_fans() {
    let expected = TriangleMesh::new(
        vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)],
        vec![[0, 1, 2], [2, 1, 3]],
    )
    .unwrap();
    let square: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let binary: Vec<u8> = square
        .iter()
        .flatten()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let json = |mode: u32| {
        format!(
            r#"{{"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{mode}}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}}],
            "bufferViews":[{{"buffer":0,"byteLength":48}}],"buffers":[{{"byteLength":48}}]}}"#
        )
    };
    let read = |mode| read_mesh("a.glb", &glb(&json(mode), &binary));
    assert_eq!(read(5).unwrap(), expected);
    assert_eq!(read(6).unwrap().triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(read(4).unwrap().triangles(), [[0, 1, 2]]);
    assert!(matches!(
        read(1),
        Err(IoError::Mesh {
            reason: CoreError::NoTriangles,
            ..
        })
    ));
    assert!(matches!(read(9), Err(IoError::MeshFormat { .. })));
}

#[test]
fn content_that_is_no_surface() {
    assert_eq!(core_fault("a.obj", b"v 1 2 3\n"), CoreError::NoTriangles);
    assert_eq!(core_fault("a.obj", b""), CoreError::NoTriangles);
    let flat = b"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n";
    assert_eq!(
        core_fault("a.obj", flat),
        CoreError::FlatMesh { triangles: 1 }
    );
    let error = format_fault("a.obj", b"v 0 0 0\nv nan 1 1\nv 2 2 2\nf 1 2 3\n");
    assert!(
        error.contains("line 2") && error.contains("finite"),
        "{error}"
    );
    let error = format_fault("a.obj", b"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 4\n");
    assert!(
        error.contains("line 4") && error.contains("3 vertices"),
        "{error}"
    );
    let error = format_fault("a.obj", b"v 0 0 0\nf -1 -1 -2\nv 1 1 1\n");
    assert!(error.contains("line 2"), "{error}");
    let error = format_fault("a.obj", b"\n\nv 0 0\n");
    assert!(error.contains("line 3"), "{error}");

    let swap = |from: &str, to: &str| {
        let text = String::from_utf8(cube_ply(PlyKind::Ascii, "float", "vertex_index")).unwrap();
        assert!(text.contains(from));
        text.replace(from, to).into_bytes()
    };
    assert_eq!(
        core_fault("a.ply", &swap("1 4 4 5 6 7", "1 4 4 5 6 8")),
        CoreError::MeshIndex {
            triangle: 3,
            index: 8,
            vertices: 8
        }
    );
    format_fault("a.ply", &swap("1 4 4 5 6 7", "1 4 4 5 6 -1"));
    format_fault("a.ply", &swap("element face 6", "element face 7"));
    format_fault("a.ply", &swap("property float z", "property float w"));
    assert_eq!(
        core_fault("a.ply", &swap("1 4 ", "1 0 ")),
        CoreError::NoTriangles
    );
    let mut nan = cube_ply(PlyKind::Little, "float", "vertex_index");
    let start = nan.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    nan[start + 13..start + 17].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(matches!(
        core_fault("a.ply", &nan),
        CoreError::MeshPosition { vertex: 1, .. }
    ));

    let mut binary = cube_binary();
    binary[4..8].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let nodes = r#"[{"mesh":0}]"#;
    let error = core_fault("a.glb", &glb(&cube_json(nodes), &binary));
    assert!(matches!(error, CoreError::MeshPosition { vertex: 0, .. }));
    let mut binary = cube_binary();
    binary[96] = 8;
    let error = format_fault("a.glb", &glb(&cube_json(nodes), &binary));
    assert!(error.contains("vertex 8"), "{error}");
    let nothing = r#"[{"scale":[0,0,0],"mesh":0}]"#;
    let error = core_fault("a.glb", &glb(&cube_json(nothing), &cube_binary()));
    assert_eq!(error, CoreError::FlatMesh { triangles: 12 });
    let error = core_fault("a.glb", &glb(&cube_json("[{}]"), &[]));
    assert_eq!(error, CoreError::NoTriangles);
}

#[test]
fn variants_that_are_not_read() {
    assert!(matches!(fault("a.stl", b"solid"), IoError::NotAMesh { .. }));
    assert!(matches!(fault("obj", b""), IoError::NotAMesh { .. }));
    let json = cube_json(r#"[{"mesh":0}]"#);
    let swap = |from: &str, to: &str| {
        assert!(json.contains(from), "{from}");
        glb(&json.replace(from, to), &cube_binary())
    };
    let external = swap(r#""buffers":[{"#, r#""buffers":[{"uri":"cube.bin","#);
    let error = fault("a.glb", &external);
    assert!(matches!(&error, IoError::ExternalBuffer { uri, .. } if uri == "cube.bin"));
    let draco = swap(
        r#""scene":0"#,
        r#""extensionsRequired":["KHR_draco_mesh_compression"]"#,
    );
    assert!(format_fault("a.glb", &draco).contains("draco"));
    for (from, to) in [
        (r#""bufferView":0,"#, ""),
        (
            r#""bufferView":0,"#,
            r#""sparse":{"count":1},"bufferView":0,"#,
        ),
        (r#""bufferView":0,"#, r#""bufferView":7,"#),
        (
            r#""bufferView":0,"#,
            r#""byteOffset":18446744073709551615,"bufferView":0,"#,
        ),
        ("5126", "5122"),
        ("5123", "5126"),
        ("VEC3", "VEC2"),
        (r#""scene":0"#, r#""scene":1"#),
        (r#""count":8"#, r#""count":9"#),
        (r#""count":8"#, r#""count":1000000000000"#),
        (r#""byteLength":96"#, r#""byteLength":96,"byteStride":0"#),
        (
            r#""byteLength":96"#,
            r#""byteLength":96,"byteStride":18446744073709551615"#,
        ),
        (r#""mesh":0"#, r#""mesh":1"#),
        (r#""mesh":0"#, r#""mesh":0,"children":[0]"#),
        (r#""mesh":0"#, r#""mesh":0,"children":[3]"#),
    ] {
        format_fault("a.glb", &swap(from, to));
    }
    let whole = cube_glb();
    for length in 0..whole.len() {
        format_fault("a.glb", &whole[..length]);
    }
}

/// What a header claims must not be believed.
#[test]
fn claims_are_checked_before_memory_is_taken() {
    let claim = |count: &str, encoding: &str| {
        format!(
            "ply\nformat {encoding} 1.0\nelement nothing {count}\nelement vertex {count}\n\
             property float x\nproperty float y\nproperty float z\nelement face 1\n\
             property list uint uint vertex_indices\nend_header\n"
        )
    };
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for count in [
            "1000000000000",
            "18446744073709551615",
            "99999999999999999999",
        ] {
            format_fault("a.ply", claim(count, encoding).as_bytes());
        }
    }
    let mut long_list = claim("0", "binary_little_endian").into_bytes();
    long_list.extend([0xFF; 12]);
    format_fault("a.ply", &long_list);
    let many = "f 1\n".repeat(4_000_001);
    assert!(matches!(
        core_fault("a.obj", many.as_bytes()),
        CoreError::TooManyTriangles { .. }
    ));
    let huge = vec![b' '; (normalight_io::MAX_MESH_BYTES + 1) as usize];
    assert!(matches!(
        fault("a.obj", &huge),
        IoError::FileTooLarge { .. }
    ));
}
