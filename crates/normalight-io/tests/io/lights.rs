//! Light files: ours, `.lp`, DiLiGenT's and UW's.
use normalight_core::{Light, Vec3, angle_between};
use normalight_io::{IoError, lights_compared_svg, lights_csv, lights_lp, lights_svg, read_lights};

fn three() -> (Vec<String>, Vec<Light>) {
    let names = ["a,\"b\".png", "spaced name 1.png", "c.png"].map(str::to_owned);
    let lights = [
        (Vec3::new(0.3, -0.2, 0.9), 0.5),
        (Vec3::Z, 1.0),
        (Vec3::new(-0.5, 0.5, 0.7), 1.5),
    ];
    (
        names.to_vec(),
        lights
            .map(|(direction, intensity)| Light::new(direction, intensity))
            .to_vec(),
    )
}

#[test]
fn ours_round_trip() {
    let (names, mut lights) = three();
    lights[0].confidence = 0.25;
    let csv = lights_csv(&names, &lights).unwrap();
    let text = String::from_utf8(csv.clone()).unwrap();
    assert!(
        text.starts_with("file,x,y,z,intensity,confidence\n\"a,\"\"b\"\".png\",0."),
        "{text}"
    );
    let again = read_lights("lights.csv", &csv, &names).unwrap();
    let lp = read_lights("lights.lp", &lights_lp(&names, &lights).unwrap(), &names).unwrap();
    for (index, light) in lights.iter().enumerate() {
        assert_eq!(again[index].confidence, light.confidence);
        assert!((again[index].mean_intensity() - light.mean_intensity()).abs() < 1e-6);
        assert!(angle_between(again[index].direction, light.direction) < 1e-6);
        assert!(angle_between(lp[index].direction, light.direction) < 1e-5);
    }
    let reversed: Vec<String> = names.iter().rev().map(|name| format!("x/{name}")).collect();
    let by_name = read_lights("lights.csv", &csv, &reversed).unwrap();
    assert_eq!(by_name[0], again[2]);
    let by_order = read_lights(
        "lights.csv",
        &csv,
        &["p.png", "q.png", "r.png"].map(str::to_owned),
    )
    .unwrap();
    assert_eq!(by_order, again);
    let some = ["c.png", "new.png"].map(str::to_owned);
    let error = read_lights("lights.csv", &csv, &some).unwrap_err();
    assert!(
        matches!(&error, IoError::LightFormat { expected, .. } if expected.contains("new.png"))
    );
}

#[test]
fn lists_of_numbers() {
    let plain = b"0 0 2\n 0.6 0 0.8\r\n\n";
    let counted = b"2\n0 0 1\n0.6 0 0.8\n";
    for text in [&plain[..], &counted[..]] {
        let lights = read_lights("lights.txt", text, &ab()).unwrap();
        assert!((lights[0].direction - Vec3::Z).length() < 1e-6);
        assert!((lights[1].direction.x - 0.6).abs() < 1e-6);
    }
    let spaced = b"2\nx/a.png   0  0\t1\nb c.png  0.6 0   0.8\n";
    let names = ["b c.png", "a.png"].map(str::to_owned);
    let lights = read_lights("lights.lp", spaced, &names).unwrap();
    assert!((lights[0].direction.x - 0.6).abs() < 1e-6);
    // Tiny and huge vectors have a direction too.
    let extreme = b"0 0 1e-30\n0 1e30 0\n";
    let lights = read_lights("lights.txt", extreme, &ab()).unwrap();
    assert_eq!(
        [lights[0].direction, lights[1].direction],
        [Vec3::Z, Vec3::Y]
    );
}

#[test]
fn numbered_lights_of_which_some_photographs_are_missing() {
    let x = |light: usize| 0.1 * light as f32;
    let rows = |first: usize| (0..6).map(move |k| (first + k, x(k)));
    let lines = |first: usize| -> String {
        let lines = rows(first).map(|(number, x)| format!("{number} {x} 0 1\n"));
        lines.collect()
    };
    let table = |first: usize| -> String {
        let lines = rows(first).map(|(number, x)| format!("{number},{x},0,1\n"));
        format!("index,x,y,z\n{}", lines.collect::<String>())
    };
    for first in [0, 1] {
        let kept = [1, 2, 4].map(|light| format!("IMG_{:04}.png", first + light));
        for (name, text) in [("lights.txt", lines(first)), ("lights.csv", table(first))] {
            let lights = read_lights(name, text.as_bytes(), &kept).unwrap();
            for (light, place) in lights.iter().zip([1, 2, 4]) {
                let found = light.direction.x / light.direction.z;
                assert!((found - x(place)).abs() < 1e-6, "{name} {first}: {found}");
            }
            // Numbers that are none of theirs are no match.
            let others = ["IMG_0100.png", "IMG_0101.png"].map(str::to_owned);
            let error = read_lights(name, text.as_bytes(), &others).unwrap_err();
            assert!(
                matches!(error, IoError::LightCount { found: 6, .. }),
                "{error}"
            );
        }
    }
}

/// Two names that no file of these tests holds.
fn ab() -> [String; 2] {
    ["P.png", "Q.png"].map(str::to_owned)
}

#[test]
fn bad_lights_are_named() {
    let read = |name: &str, text: &str| read_lights(name, text.as_bytes(), &ab()).unwrap_err();
    let count = |error: IoError, wanted: usize| matches!(error, IoError::LightCount { found, expected: 2, .. } if found == wanted);
    assert!(count(read("l.txt", "0 0 1\n0 0 1\n0 0 1"), 3));
    assert!(count(read("l.txt", "2\n0 0 1"), 1));
    assert!(count(read("l.lp", ""), 0));
    assert!(count(
        read("l.csv", "file,x,y,z,intensity,confidence\na,0,0,1,1,1\n"),
        1
    ));
    for bad in [
        "0 0 0", "1 0 0 1", "nan 0 1", "0 inf 1", "0 1", "x y z", "a b c d",
    ] {
        let error = read("l.txt", &format!("0 0 1\n{bad}"));
        assert!(
            matches!(&error, IoError::LightFormat { name, line: 2, found, .. }
            if name == "l.txt" && found == bad),
            "{error}"
        );
    }
    for bad in [
        "a,0,0,0,1,1",
        "a,0,0,1,0,1",
        "a,0,0,1,inf,1",
        "a,0,0,1,1,2",
        "a,0,0,1",
        "a,x,0,1,1,1",
    ] {
        let error = read(
            "l.csv",
            &format!("file,x,y,z,intensity,confidence\nb,0,0,1,1,1\n{bad}\n"),
        );
        assert!(
            matches!(&error, IoError::LightFormat { line: 3, .. }),
            "{error}"
        );
    }
    let error = read("l.csv", "x,y\n1,2\n");
    assert!(
        matches!(&error, IoError::LightFormat { expected, .. } if expected.contains("confidence"))
    );
}

#[test]
fn the_light_map_shows_every_light() {
    let (_, lights) = three();
    let svg = String::from_utf8(lights_svg(&lights)).unwrap();
    assert_eq!(svg.matches("<title>").count(), 3);
    assert!(!svg.contains("NaN"));
    // With the truth, as many lines to it, from where the lights stand: here both are the same.
    let compared = String::from_utf8(lights_compared_svg(&lights, &lights)).unwrap();
    let count = |text: &str, part: &str| text.matches(part).count();
    assert_eq!(count(&compared, "<circle"), count(&svg, "<circle") + 3);
    assert_eq!(count(&compared, "<line"), count(&svg, "<line") + 3);
    // No lights, or lights without intensity, still make a picture.
    let dark = [Light::new(Vec3::Z, 0.0)];
    for lights in [&[][..], &dark[..]] {
        let svg = String::from_utf8(lights_svg(lights)).unwrap();
        assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("inf\""));
    }
}
