//! Depth, meshes and maps as files, read back.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
use normalight_core::{DepthMap, DepthSettings, Mask, NormalMap, Vec3, integrate_normals};
use normalight_io::{
    ColorMode, DerivedReport, DerivedSettings, IoError, MapSettings, MeshFileFormat, NormalFormat,
    Outside, Texture, albedo_map_png, curvature_png, decode_image, derived_files, height_exr,
    height_png, height_tiff, mesh_as_files, normal_map_png, normals_exr, normals_npy, normals_png,
    occlusion_png, read_mesh, read_normals,
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
fn normal_maps_are_flat_or_dilated_outside() {
    let (normals, mask, _) = ball();
    let paint = |how| decoded("n.png", &normal_map_png(&normals, &mask, how).unwrap());
    let how = MapSettings {
        eight_bits: true,
        ..MapSettings::default()
    };
    let flat = paint(how);
    assert_eq!(flat.color(), image::ColorType::Rgb8);
    assert_eq!(flat.into_rgb8().get_pixel(0, 0).0, [128, 128, 255]);
    let flat = paint(MapSettings::default()).into_rgb16();
    assert_eq!(flat.get_pixel(60, 60).0, [32_768, 32_768, 65_535]);
    let dilated = MapSettings {
        outside: Outside::Dilated,
        alpha: true,
        normal_format: NormalFormat::DirectX,
        ..MapSettings::default()
    };
    let image = paint(dilated);
    assert_eq!(image.color(), image::ColorType::Rgba16);
    let image = image.into_rgba16();
    // Straight up of the middle the nearest pixel of the ball points up; green is down.
    let [red, green, _, alpha] = image.get_pixel(30, 0).0;
    assert!((i32::from(red) - 32_768).abs() < 3000 && green < 16_000 && alpha == 0);
    assert_eq!(image.get_pixel(30, 30).0, [32_768, 32_768, 65_535, 65_535]);
    let wrong = normal_map_png(&normals, &Mask::whole(3, 3), dilated);
    assert!(wrong.is_err());

    let planes = vec![0.5; 3 * SIDE * SIDE];
    let paint = |how| decoded("a.png", &albedo_map_png(&planes, &mask, how).unwrap()).into_rgba8();
    assert_eq!(
        paint(MapSettings::default()).get_pixel(0, 0).0,
        [0, 0, 0, 255]
    );
    assert_eq!(paint(dilated).get_pixel(0, 0).0, [255, 255, 255, 0]);
}

#[test]
fn normals_made_elsewhere_are_read() {
    let (normals, mask, _) = ball();
    let files = [
        (
            "n.png",
            normals_png(&normals, NormalFormat::DirectX).unwrap(),
            NormalFormat::DirectX,
            1e-3,
        ),
        (
            "n.npy",
            normals_npy(&normals).unwrap(),
            NormalFormat::OpenGl,
            1e-6,
        ),
        (
            "n.exr",
            normals_exr(&normals).unwrap(),
            NormalFormat::OpenGl,
            1e-6,
        ),
        (
            "n.png",
            normal_map_png(
                &normals,
                &mask,
                MapSettings {
                    alpha: true,
                    eight_bits: true,
                    outside: Outside::Dilated,
                    ..MapSettings::default()
                },
            )
            .unwrap(),
            NormalFormat::OpenGl,
            0.02,
        ),
    ];
    for (name, bytes, format, tolerance) in files {
        let (read, found) = read_normals(name, &bytes, format).unwrap();
        // A picture without transparency does not say where the object ends.
        let expected = match format {
            NormalFormat::DirectX => Mask::whole(SIDE, SIDE),
            NormalFormat::OpenGl => mask.clone(),
        };
        assert_eq!(found, expected, "{name}");
        for pixel in mask.pixels() {
            let (one, other) = (read.normals()[pixel], normals.normals()[pixel]);
            assert!(one.distance(other) < tolerance, "{name}: {one} {other}");
        }
        for cut in [9, 40, bytes.len() / 2] {
            assert!(read_normals(name, &bytes[..cut], format).is_err());
        }
    }
    let grey = occlusion_png(&vec![0.5; SIDE * SIDE], &mask).unwrap();
    let error = read_normals("grey.png", &grey, NormalFormat::OpenGl).unwrap_err();
    assert!(matches!(error, IoError::NormalFormat { .. }), "{error}");
    let none = NormalMap::new(4, 4, vec![Vec3::ZERO; 16]);
    let none = normals_npy(&none).unwrap();
    let error = read_normals("none.npy", &none, NormalFormat::OpenGl).unwrap_err();
    assert!(
        error.to_string().starts_with("none.npy: found no pixel"),
        "{error}"
    );
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
    let (files, _) = derive(none);
    assert_eq!(files.len(), 1);
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
    let (files, report) = derive(all);
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
