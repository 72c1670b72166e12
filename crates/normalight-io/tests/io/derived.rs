//! Depth, meshes and maps as files, read back.

mod meshes;
mod normals;

use normalight_core::{DepthMap, DepthSettings, Mask, NormalMap, Vec3, integrate_normals};
use normalight_io::{
    ColorMode, Derived, DerivedReport, DerivedSettings, MapSettings, MeshFileFormat, curvature_png,
    decode_image, derived_files, height_exr, height_png, height_tiff,
};

const SIDE: usize = 61;

/// A ball of radius 40, up to 25 pixels from its middle.
fn ball() -> (NormalMap, Mask, DepthMap) {
    let at = |pixel: usize| {
        let x = (pixel % SIDE) as f32 - 30.0;
        let y = 30.0 - (pixel / SIDE) as f32;
        let height = (1600.0 - x * x - y * y).sqrt();
        if x.hypot(y) < 25.0 {
            Vec3::new(x, y, height)
        } else {
            Vec3::ZERO
        }
    };
    let normals = NormalMap::new(SIDE, SIDE, (0..SIDE * SIDE).map(at).collect());
    let inside = normals.normals().iter().map(|&n| n != Vec3::ZERO).collect();
    let mask = Mask::new(SIDE, SIDE, inside);
    let depth = integrate_normals(&normals, &mask, DepthSettings::default()).unwrap();
    (normals, mask, depth)
}

fn decoded(name: &str, bytes: &[u8]) -> image::DynamicImage {
    assert!(name.ends_with(".png"));
    image::load_from_memory(bytes).unwrap()
}

#[test]
fn heights_come_back() {
    let (_, mask, depth) = ball();
    let (png, step) = height_png(&depth).unwrap();
    let image = decoded("height.png", &png);
    assert_eq!(image.color(), image::ColorType::L16);
    let image = image.into_luma16();
    let (low, high) = depth.range();
    assert!((step * 65_535.0 - (high - low)).abs() < 1e-3);
    for pixel in mask.pixels() {
        let code = image
            .get_pixel((pixel % SIDE) as u32, (pixel / SIDE) as u32)
            .0[0];
        let found = low + step * f32::from(code);
        assert!((found - depth.heights()[pixel]).abs() <= 0.51 * step);
    }
    assert_eq!(image.get_pixel(0, 0).0, [0]);
    // By the libraries alone: our reader takes photographs, which have no NaN.
    let tiff = height_tiff(&depth).unwrap();
    let mut decoder = tiff::decoder::Decoder::new(std::io::Cursor::new(&tiff)).unwrap();
    let tiff::decoder::DecodingResult::F32(values) = decoder.read_image().unwrap() else {
        panic!("no floating-point numbers");
    };
    let exr_bytes = height_exr(&depth).unwrap();
    let image = {
        use exr::prelude::{ReadChannels, ReadLayers, read};
        let reader = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels();
        let reader = reader.first_valid_layer().all_attributes().non_parallel();
        reader
            .from_buffered(std::io::Cursor::new(&exr_bytes))
            .unwrap()
    };
    let channel = &image.layer_data.channel_data.list[0];
    assert_eq!(channel.name.to_string(), "Y");
    let others: Vec<f32> = channel.sample_data.values_as_f32().collect();
    for (pixel, &inside) in mask.inside().iter().enumerate() {
        let truth = depth.heights()[pixel];
        for found in [values[pixel], others[pixel]] {
            assert!(if inside {
                found == truth
            } else {
                found.is_nan()
            });
        }
    }
}

#[test]
fn curvature_is_grey_when_flat() {
    let mask = Mask::whole(4, 1);
    let (png, white) = curvature_png(&[0.0, 0.25, -0.5, 0.5], &mask).unwrap();
    assert_eq!(white, 0.5);
    let image = decoded("c.png", &png).into_luma16();
    let codes: Vec<u16> = image.pixels().map(|pixel| pixel.0[0]).collect();
    assert_eq!(codes, [32_768, 49_151, 0, 65_535]);
}

#[test]
fn everything_that_is_asked_for_and_nothing_else() {
    let (normals, mask, _) = ball();
    let albedo = vec![0.5; 3 * SIDE * SIDE];
    let derive = |settings| derived_files(&normals, Some(&albedo), &mask, settings).unwrap();
    let none = DerivedSettings::default();
    assert!(!none.wanted());
    assert_eq!(derive(none).files.len(), 1);
    let all = DerivedSettings {
        heights: true,
        flatten: true,
        mesh: Some(MeshFileFormat::Obj),
        triangles: 500,
        maps: Some(MapSettings::default()),
        tileable: true,
        ..none
    };
    assert!(all.wanted());
    let Derived {
        files,
        report,
        depth,
    } = derive(all);
    let (low, high) = depth.range();
    assert_eq!([low, high], report.range);
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let expected = [
        "height.png",
        "height.tiff",
        "height.exr",
        "mesh.obj",
        "mesh.mtl",
        "mesh.png",
        "map-normals.png",
        "map-normals.exr",
        "map-height.png",
        "map-curvature.png",
        "map-occlusion.png",
        "map-albedo.png",
        "depth.json",
    ];
    assert_eq!(names, expected);
    let json: DerivedReport = serde_json::from_slice(&files[12].1).unwrap();
    assert_eq!(json, report);
    assert_eq!((report.parts, report.missing, report.steep), (1, 0, 0));
    assert!(report.mesh_step.unwrap() >= 2);
    // A ball without its bow is nearly flat.
    assert!(
        report.range[1] - report.range[0] < 3.0,
        "{:?}",
        report.range
    );
    for (name, bytes) in &files {
        if name.starts_with("map-") && name.ends_with(".png") {
            let image = decoded(name, bytes);
            // An eighth of each side is faded away.
            assert_eq!((image.width(), image.height()), (54, 54), "{name}");
        }
    }
    let read = decode_image("map-normals.exr", &files[7].1, ColorMode::Linear).unwrap();
    assert_eq!(read.image.width, 54);
    let error = derived_files(&normals, Some(&albedo[1..]), &mask, all);
    assert!(error.is_err());
}
