//! Large meshes, and folders and lists of them.
use crate::common::meshes::CUBE_OBJ;
use normalight_core::Vec3;
use normalight_io::{IoError, mesh_files, read_mesh, read_mesh_file, write_files};
use std::fmt::Write;
use std::time::Instant;

/// A wavy sheet of a million triangles.
fn sheet() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (columns, rows) = (1001, 501);
    let positions = (0..columns * rows).map(|index| {
        let (x, y) = ((index % columns) as f32, (index / columns) as f32);
        Vec3::new(x, y, (x * 0.05).sin() * 8.0)
    });
    let cells = (0..(columns - 1) * (rows - 1)).flat_map(|index| {
        let corner = index / (columns - 1) * columns + index % (columns - 1);
        let above = corner + columns;
        [[corner, corner + 1, above + 1], [corner, above + 1, above]]
    });
    (positions.collect(), cells.collect())
}

#[test]
fn a_million_triangles() {
    let (positions, triangles) = sheet();
    let mut obj = String::new();
    let mut ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        positions.len(),
        triangles.len()
    );
    for Vec3 { x, y, z } in &positions {
        writeln!(obj, "v {x} {y} {z}").unwrap();
        writeln!(ply, "{x} {y} {z}").unwrap();
    }
    for [a, b, c] in &triangles {
        writeln!(obj, "f {}//1 {}//1 {}//1", a + 1, b + 1, c + 1).unwrap();
        writeln!(ply, "3 {a} {b} {c}").unwrap();
    }
    for (name, text) in [("a.obj", obj), ("a.ply", ply)] {
        let start = Instant::now();
        let mesh = read_mesh(name, text.as_bytes()).unwrap();
        let read = start.elapsed();
        let normals = mesh.clone().oriented().corner_normals(0.7).normals;
        println!(
            "{name}: read in {read:?}, normals after {:?}",
            start.elapsed()
        );
        assert_eq!(mesh.triangles().len(), 1_000_000);
        assert!(normals.iter().all(|normal| normal.z > 0.5));
        // Generous: a slow machine under load must pass, an algorithm of the second order not.
        assert!(start.elapsed().as_secs() < 60);
    }
}

#[test]
fn folders_of_meshes() {
    let place = tempfile::tempdir().unwrap();
    let empty = mesh_files(place.path()).unwrap_err();
    assert!(matches!(empty, IoError::NotAMesh { .. }), "{empty}");
    let files = ["b10.obj", "b2.obj", "A.ply", "notes.txt", "c.glb"];
    let files = files.map(|name| (name, CUBE_OBJ.as_bytes()));
    write_files(place.path(), &files).unwrap();
    std::fs::create_dir(place.path().join("d.obj")).unwrap();
    let deeper = place.path().join("b9");
    write_files(&deeper, &[("z.obj", CUBE_OBJ)]).unwrap();
    let names = |path: &std::path::Path| -> Vec<String> {
        let found = mesh_files(path).unwrap();
        let name = |file: &std::path::PathBuf| {
            let file = file.strip_prefix(place.path()).unwrap();
            file.to_str().unwrap().replace('\\', "/")
        };
        found.iter().map(name).collect()
    };
    let expected = ["A.ply", "b2.obj", "b9/z.obj", "b10.obj", "c.glb"];
    assert_eq!(names(place.path()), expected);

    // A list keeps its order, and does not ask whether its meshes are there.
    let list = deeper.join("list.txt");
    std::fs::write(&list, "# chosen\n z.obj \r\n\ngone/y.ply\n").unwrap();
    assert_eq!(names(&list), ["b9/z.obj", "b9/gone/y.ply"]);
    for (text, expected) in [
        ("z.obj\nnotes.md\n", "\"notes.md\""),
        ("# none\n", "a list without any"),
        ("\u{1}\u{2}\n", "a list with"),
    ] {
        std::fs::write(&list, text).unwrap();
        let error = mesh_files(&list).unwrap_err().to_string();
        assert!(error.contains("list.txt: found"), "{error}");
        assert!(error.contains(expected), "{error}");
    }

    let found = mesh_files(place.path()).unwrap();
    assert_eq!(read_mesh_file(&found[1]).unwrap().triangles().len(), 12);
    let error = read_mesh_file(&found[0]).unwrap_err();
    assert!(error.to_string().contains("A.ply"), "{error}");
    let gone = place.path().join("gone");
    assert!(matches!(mesh_files(&gone), Err(IoError::Read { .. })));
    assert!(matches!(
        read_mesh_file(&gone.join("a.obj")),
        Err(IoError::Read { .. })
    ));
}
