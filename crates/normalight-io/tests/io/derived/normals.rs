//! Normals for painting and from elsewhere.
use crate::derived::{SIDE, ball, decoded};
use normalight_core::{Mask, NormalMap, Vec3};
use normalight_io::{
    IoError, MapSettings, NormalFormat, Outside, albedo_map_png, normal_map_png, normals_exr,
    normals_npy, normals_png, occlusion_png, read_normals,
};

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
