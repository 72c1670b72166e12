//! Against published data that lives outside the project; skipped where it is missing.
use normalight_core::{
    MaskSource, NormalMap, least_squares_normals, mean_light_error, normal_error, robust_normals,
    uncalibrated_factorisation,
};
use normalight_io::{
    ReadOptions, StackInput, list_diligent_objects, mesh_files, read_diligent_object,
    read_lights_path, read_mesh_file, read_paths,
};
use std::path::PathBuf;

/// A folder of the shared data: below `NORMALIGHT_SHARED`, or beside the workspace.
fn shared(folder: &str) -> Option<PathBuf> {
    let root = std::env::var_os("NORMALIGHT_SHARED").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")),
        PathBuf::from,
    );
    let path = root.join("data").join(folder);
    if path.is_dir() {
        return Some(path);
    }
    println!("skipped: {} is missing", path.display());
    None
}

fn read(folder: &str) -> Option<StackInput> {
    let path = shared(folder)?;
    Some(read_paths(&[path], &ReadOptions::default()).unwrap())
}

fn woodham_degrees(folder: &str) -> Option<f32> {
    let object = read_diligent_object(&shared(folder)?, None).unwrap();
    assert!(!object.name.ends_with("PNG"));
    let input = &object.input;
    assert_eq!(input.mask_source, MaskSource::File("mask.png".into()));
    let lights = object.lights.as_ref().unwrap();
    let (normals, _) = least_squares_normals(&input.stack, &input.mask, lights).unwrap();
    let error = normal_error(&normals, object.normals.as_ref().unwrap(), &input.mask).unwrap();
    println!("{}: {:.3} degrees", object.name, error.mean.to_degrees());
    Some(error.mean.to_degrees())
}

/// Known errors of calibrated least squares: right only when samples, masks, lights and truth are.
#[test]
fn woodham_reproduces_the_published_figures() {
    for (folder, expected) in [
        ("diligent-crop/ballPNG", 4.49),
        ("diligent-crop/catPNG", 8.76),
        ("diligent-crop/bearPNG", 8.53),
        ("diligent-crop/readingPNG", 20.68),
        ("diligent-crop/cowPNG", 26.67),
        ("diligent-original/ballPNG", 4.17),
    ] {
        if let Some(found) = woodham_degrees(folder) {
            assert!((found - expected).abs() <= 0.02, "{folder}: {found}");
        }
    }
}

/// Published: 4.10 by least squares, 4.77 without lights.
#[test]
fn classical_methods_reproduce_the_ball() {
    let Some(folder) = shared("diligent-crop/ballPNG") else {
        return;
    };
    let object = read_diligent_object(&folder, None).unwrap();
    let (stack, mask) = (&object.input.stack, &object.input.mask);
    let (lights, truth) = (object.lights.unwrap(), object.normals.unwrap());
    let degrees = |normals: &NormalMap| {
        let error = normal_error(normals, &truth, mask).unwrap();
        error.mean.to_degrees()
    };
    let robust = degrees(&robust_normals(stack, mask, &lights).unwrap().0);
    assert!(robust < 2.6, "{robust}");
    let found = uncalibrated_factorisation(stack, mask).unwrap();
    let normals = degrees(&found.normals);
    assert!(normals < 4.77, "{normals}");
    let lights = mean_light_error(&found.lights, &lights).unwrap();
    assert!(lights.to_degrees() < 3.0, "{}", lights.to_degrees());
}

#[test]
fn benchmark_folders_are_listed() {
    let Some(root) = shared("diligent-crop") else {
        return;
    };
    let objects = list_diligent_objects(&root).unwrap();
    assert_eq!(objects.len(), 5);
    assert!(objects[0].ends_with("ballPNG"));
    assert_eq!(
        list_diligent_objects(&objects[1]).unwrap(),
        [objects[1].clone()]
    );
    let few = read_diligent_object(&objects[0], Some(8)).unwrap();
    assert_eq!(few.input.picked, [0, 13, 26, 34, 47, 68, 81, 89]);
    assert_eq!((few.lights.unwrap().len(), few.input.stack.len()), (8, 8));
}

#[test]
fn folders_of_all_kinds_are_understood() {
    for (folder, images, first, last, mask) in [
        (
            "uw/buddha",
            12,
            "buddha.0.tga",
            "buddha.11.tga",
            "buddha.mask.tga",
        ),
        ("uw/gray", 12, "gray.0.tga", "gray.11.tga", "gray.mask.tga"),
        ("phone/mousePNG", 15, "0001.png", "0015.png", "mask.png"),
        ("toy/Bunny", 50, "l_000.png", "l_049.png", "mask.png"),
        (
            "diligent-crop/ballPNG",
            96,
            "001.png",
            "096.png",
            "mask.png",
        ),
    ] {
        let Some(input) = read(folder) else { continue };
        let names: Vec<&str> = input
            .stack
            .images()
            .iter()
            .map(|i| i.name.as_str())
            .collect();
        assert_eq!(names.len(), images, "{folder}");
        assert_eq!((names[0], names[images - 1]), (first, last));
        assert_eq!(input.mask_source, MaskSource::File(mask.into()));
        assert_eq!(
            names.iter().filter(|name| name.contains(".2.")).count(),
            usize::from(images == 12)
        );
    }
}

#[test]
fn counted_light_lists_are_read() {
    let Some(uw) = shared("uw") else { return };
    let names: Vec<String> = (0..12).map(|k| format!("{k}.tga")).collect();
    let lights = read_lights_path(&uw.join("lights.txt"), &names).unwrap();
    assert!((lights[0].direction.x - 0.403_259).abs() < 1e-4);
}

#[test]
fn scanned_meshes_are_read() {
    let Some(folder) = shared("meshes") else {
        return;
    };
    let files = mesh_files(&folder).unwrap();
    assert_eq!(files.len(), 14);
    for file in files {
        let mesh = read_mesh_file(&file).unwrap();
        let (low, high) = mesh.bounds();
        let (vertices, triangles) = (mesh.positions().len(), mesh.triangles().len());
        println!("{}: {vertices} {triangles} {low} {high}", file.display());
        assert!(triangles > 500 && (high - low).min_element() > 0.0);
        let unit = |normal: &normalight_core::Vec3| (normal.length() - 1.0).abs() < 1e-4;
        assert!(mesh.corner_normals(0.7).normals.iter().all(unit));
    }
}
