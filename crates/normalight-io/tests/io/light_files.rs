//! Light files as people and their programs write them.
use normalight_core::{Light, Vec3, angle_between};
use normalight_io::{IoError, NameMatch, lights_csv, lights_lp, read_lights};

/// Twelve directions that all differ.
fn directions() -> Vec<Vec3> {
    let turn = |k: f32| Vec3::new((0.5 * k).cos() * 0.4, (0.5 * k).sin() * 0.5, 0.8).normalize();
    (0..12).map(|k| turn(k as f32)).collect()
}

fn names(pattern: impl Fn(usize) -> String) -> Vec<String> {
    (1..=12).map(pattern).collect()
}

/// Reads a file and checks that each photograph has its own light.
fn reads(name: &str, text: &str, photographs: &[String]) {
    reads_bytes(name, text.as_bytes(), photographs);
}

fn reads_bytes(name: &str, bytes: &[u8], photographs: &[String]) {
    let lights = read_lights(name, bytes, photographs).unwrap();
    for (light, direction) in lights.iter().zip(directions()) {
        assert!(angle_between(light.direction, direction) < 1e-4, "{name}");
    }
    assert_eq!(lights.len(), 12);
}

fn lines(order: &[usize], line: impl Fn(usize, Vec3) -> String) -> String {
    order
        .iter()
        .map(|&k| line(k + 1, directions()[k]) + "\r\n")
        .collect()
}

const IN_ORDER: [usize; 12] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11];
/// 1, 10, 11, 12, 2, ...
const DICTIONARY: [usize; 12] = [0, 9, 10, 11, 1, 2, 3, 4, 5, 6, 7, 8];

fn spaced(Vec3 { x, y, z }: Vec3) -> String {
    format!("{x} {y} {z}")
}

fn comma(value: impl ToString) -> String {
    value.to_string().replace('.', ",")
}

#[test]
fn names_decide_however_they_are_written() {
    let photographs = names(|k| format!("IMG_{k}.png"));
    let windows = lines(&DICTIONARY, |k, d| {
        format!("M:\\Stelae 16 bit\\Stela 9\\IMG_{k}.jpg\t{}", spaced(d))
    });
    reads("a.lp", &format!("\u{feff}12\r\n{windows}"), &photographs);
    let quoted = lines(&DICTIONARY, |k, d| {
        format!("\"shots/img_{k}.PNG\"  {}", spaced(d))
    });
    reads("a.lp", &quoted, &photographs);
    let bare = lines(&DICTIONARY, |k, d| format!("IMG_{k} {}", spaced(d)));
    reads("a.lp", &bare, &photographs);
    // Another name for the same shot: the number tells.
    let renamed = lines(&DICTIONARY, |k, d| format!("DSC_{k:04}.NEF {}", spaced(d)));
    reads("a.lp", &renamed, &photographs);
    let composed = lines(&DICTIONARY, |k, d| {
        format!("B\u{fc}ste {k}.png {}", spaced(d))
    });
    let apart = names(|k| format!("Bu\u{308}ste {k}.png"));
    reads("a.lp", &composed, &apart);
    let latin: Vec<u8> = composed.chars().map(|c| c as u8).collect();
    reads_bytes("a.lp", &latin, &apart);
}

#[test]
fn numbers_as_programs_write_them() {
    let photographs = names(|k| format!("IMG_{k}.png"));
    let commas = |d: Vec3| d.to_array().map(comma).join(" ");
    reads(
        "a.lp",
        &lines(&DICTIONARY, |k, d| format!("IMG_{k}.jpg {}", commas(d))),
        &photographs,
    );
    let semicolons = |d: Vec3| d.to_array().map(comma).join(";");
    reads(
        "a.txt",
        &lines(&DICTIONARY, |k, d| format!("IMG_{k};{}", semicolons(d))),
        &photographs,
    );
    reads(
        "a.txt",
        &lines(&IN_ORDER, |_, d| {
            d.to_array().map(|v| v.to_string()).join(",")
        }),
        &photographs,
    );
    // A running number says which row it is, whatever the order.
    let numbered = lines(&DICTIONARY, |k, d| format!("{k} {}", spaced(d)));
    reads("a.txt", &numbered, &photographs);
    reads(
        "a.txt",
        &format!("12\n{numbered}"),
        &names(|k| format!("DSC{}.png", 4710 + k)),
    );
}

#[test]
fn tables_of_spreadsheets_and_domes() {
    let photographs = names(|k| format!("IMG_{k}.png"));
    let row =
        |k: usize, d: Vec3| format!("IMG_{k}.png;{};1,0;0,5", d.to_array().map(comma).join(";"));
    let csv = format!(
        "\u{feff}file;x;y;z;intensity;confidence\r\n{}",
        lines(&DICTIONARY, row)
    );
    reads("lights.csv", &csv, &photographs);
    assert_eq!(
        read_lights("lights.csv", csv.as_bytes(), &photographs).unwrap()[3].confidence,
        0.5
    );
    let wide: Vec<u8> = std::iter::once(0xFEFF)
        .chain(csv.replace(';', "\t").encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    reads_bytes("lights.txt", &wide, &photographs);
    let angles = |d: Vec3| (d.y.atan2(d.x), d.z.asin());
    let degrees = lines(&DICTIONARY, |k, d| {
        let (azimuth, elevation) = angles(d);
        format!(
            "IMG_{k},{},{}",
            azimuth.to_degrees(),
            elevation.to_degrees()
        )
    });
    reads(
        "dome.csv",
        &format!("Image,Azimuth (deg),Elevation (deg)\n{degrees}"),
        &photographs,
    );
    let radians = lines(&IN_ORDER, |_, d| {
        let (azimuth, elevation) = angles(d);
        format!("{}\t{azimuth}", std::f32::consts::FRAC_PI_2 - elevation)
    });
    reads("dome.txt", &format!("theta\tphi\n{radians}"), &photographs);
}

/// Arrays of numpy, written by hand as its format says.
#[test]
fn arrays() {
    let array = |kind: &str, fortran: &str, shape: &str, values: Vec<u8>| {
        let mut header =
            format!("{{'descr': '{kind}', 'fortran_order': {fortran}, 'shape': {shape}, }}");
        header.push_str(&" ".repeat(117 - header.len()));
        header.push('\n');
        let length = (header.len() as u16).to_le_bytes();
        [
            &b"\x93NUMPY\x01\x00"[..],
            &length,
            header.as_bytes(),
            &values,
        ]
        .concat()
    };
    let rows: Vec<f32> = directions().iter().flat_map(|d| d.to_array()).collect();
    let columns: Vec<f32> = (0..3)
        .flat_map(|axis| directions().into_iter().map(move |d| d[axis]))
        .collect();
    let single = |values: &[f32]| {
        values
            .iter()
            .flat_map(|v| v.to_le_bytes())
            .collect::<Vec<u8>>()
    };
    let double: Vec<u8> = rows
        .iter()
        .flat_map(|&v| f64::from(v).to_le_bytes())
        .collect();
    let photographs = names(|k| format!("{k}.png"));
    reads_bytes(
        "l.npy",
        &array("<f4", "False", "(12, 3)", single(&rows)),
        &photographs,
    );
    reads_bytes(
        "l.npy",
        &array("<f8", "False", "(12, 3)", double),
        &photographs,
    );
    reads_bytes(
        "l.npy",
        &array("<f4", "True", "(12, 3)", single(&columns)),
        &photographs,
    );
    reads_bytes(
        "l.npy",
        &array("<f4", "False", "(3, 12)", single(&columns)),
        &photographs,
    );
    for (kind, shape) in [
        ("<i4", "(12, 3)"),
        ("<f4", "(36,)"),
        ("<f4", "(1000000000, 3)"),
    ] {
        let bytes = array(kind, "False", shape, single(&rows));
        let error = read_lights("l.npy", &bytes, &photographs).unwrap_err();
        assert!(error.to_string().starts_with("l.npy: found"), "{error}");
    }
}

#[test]
fn what_contradicts_is_refused_with_all_names() {
    let photographs = names(|k| format!("IMG_{k}.png"));
    let read = |text: &str| {
        read_lights("a.lp", text.as_bytes(), &photographs)
            .unwrap_err()
            .to_string()
    };
    let fewer = lines(&IN_ORDER[..9], |k, d| format!("IMG_{k}.jpg {}", spaced(d)));
    let error = read(&fewer);
    assert!(
        ["IMG_10.png", "IMG_11.png", "IMG_12.png"]
            .iter()
            .all(|name| error.contains(name)),
        "{error}"
    );
    let all = lines(&IN_ORDER, |k, d| format!("IMG_{k}.jpg {}", spaced(d)));
    let error = read(&format!("{all}IMG_4.jpg 0 0 1\nIMG_7.tif 0 0 1\n"));
    assert!(error.contains("IMG_4.png, IMG_7.png"), "{error}");
    // The same light twice is none.
    reads(
        "a.lp",
        &format!("{all}{}", all.lines().next().unwrap()),
        &photographs,
    );
    // Numbers that are others, in dictionary order: by position every light would be wrong.
    let others = lines(&DICTIONARY, |k, d| {
        format!("DSC_{}.jpg {}", k + 100, spaced(d))
    });
    let error = read(&others);
    assert!(error.contains("another order"), "{error}");
    // One light for two photographs in different folders.
    let twice = vec!["a/1.png".to_owned(), "b/1.png".to_owned()];
    let error = read_lights("a.lp", b"1.png 0 0 1\n", &twice)
        .unwrap_err()
        .to_string();
    assert!(error.contains("b/1.png"), "{error}");
    let behind = lines(&IN_ORDER, |k, d| format!("IMG_{k}.jpg {}", spaced(-d)));
    let error = read_lights("a.lp", behind.as_bytes(), &photographs).unwrap_err();
    assert!(matches!(
        &error,
        IoError::LightsBehind {
            behind: 12,
            of: 12,
            ..
        }
    ));
    assert!(error.to_string().contains("x-right,y-down,z-in"), "{error}");
}

/// Whatever the photographs are called, our own files give back the same lights.
#[test]
fn ours_come_back_by_name() {
    let photographs: Vec<String> = [
        "a/1.png",
        "b/1.png",
        "new\nline 1.png",
        "1 2 3",
        "\"quoted\".png",
        "x, y.png",
        "B\u{fc}ste.png",
        "bu\u{308}ste 2.png",
        "0.5 0.5 0.5.png",
        "tab\there.png",
        "c\\d.png",
        "plain.png",
    ]
    .map(str::to_owned)
    .into();
    let lights: Vec<Light> = directions()
        .into_iter()
        .map(|d| Light::new(d, 1.0))
        .collect();
    let mut shuffled: Vec<usize> = (0..12).collect();
    shuffled.rotate_left(5);
    let names: Vec<String> = shuffled.iter().map(|&k| photographs[k].clone()).collect();
    let own: Vec<Light> = shuffled.iter().map(|&k| lights[k]).collect();
    for (file, bytes) in [
        ("lights.csv", lights_csv(&names, &own).unwrap()),
        ("lights.lp", lights_lp(&names, &own).unwrap()),
    ] {
        reads_bytes(file, &bytes, &photographs);
    }
    assert!(NameMatch::Full < NameMatch::Position);
}

/// Tables and lines as people write them, each with the lights that it means.
#[test]
fn lights_in_further_spellings() {
    let names = ["IMG_1.png", "IMG_2.png", "IMG_3.png"].map(str::to_owned);
    for text in [
        "idx,lx,ly,lz\n2,0,1,1\n0,1,0,1\n1,0,-1,1\n",
        "Nr;X;Y;Z\n3;0;1;1\n1;1;0;1\n2;0;-1;1\n",
        "sep=;\nimage;Direction X;Direction Y;Direction Z\nIMG_3;0;1;1\nIMG_1;1;0;1\nIMG_2;0;-1;1\n",
        "1 0 1\r0 -1 1\r0 1 1\r",
        "1 0 1 # lamp at the window\n0 -1 1 # door\n0 1 1\t# above\n",
        "1 0 1 1 1 1\n0 -1 1 1 1 1\n0 1 1 1 1 1\n",
        "IMG_3.png,0,1,1,1,0.9\nIMG_1.png,1,0,1,1,0.8\nIMG_2.png,0,-1,1,1,0.7\n",
        "IMG #2.png 0 -1 1\nIMG #1.png 1 0 1\nIMG #3.png 0 1 1\n",
    ] {
        let lights = read_lights("lights.csv", text.as_bytes(), &names).unwrap();
        for (light, expected) in lights.iter().zip([Vec3::X, Vec3::NEG_Y, Vec3::Y]) {
            let expected = (expected + Vec3::Z).normalize();
            assert!(
                light.direction.distance(expected) < 1e-5,
                "{text:?}: {light:?}"
            );
        }
    }
    let error = read_lights("lights.npz", b"PK\x03\x04\x14\0\0\0", &names).unwrap_err();
    assert!(error.to_string().contains("no text"), "{error}");
}
