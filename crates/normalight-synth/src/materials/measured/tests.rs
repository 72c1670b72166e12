use super::*;
use crate::random::{Random, Stream};
use std::io::Write;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// The network as the file's authors describe it, in double precision and from angles.
fn direct(numbers: &[f32], half_polar: f64, difference_polar: f64, azimuth: f64) -> [f64; 3] {
    let (half_sin, half_cos) = half_polar.sin_cos();
    let (sin, cos) = difference_polar.sin_cos();
    let mut values = vec![
        half_sin,
        0.0,
        half_cos,
        sin * azimuth.cos(),
        sin * azimuth.sin(),
        cos,
    ];
    let mut rest = numbers;
    for (layer, outputs) in [21usize, 21, 3].into_iter().enumerate() {
        let (weights, after) = rest.split_at(values.len() * outputs);
        let (biases, after) = after.split_at(outputs);
        rest = after;
        values = (0..outputs)
            .map(|output| {
                let products = values.iter().enumerate();
                let sum: f64 = products
                    .map(|(input, value)| value * f64::from(weights[input * outputs + output]))
                    .sum();
                let sum = sum + f64::from(biases[output]);
                if layer < 2 {
                    sum.max(0.0)
                } else {
                    (sum.exp() - 1.0).max(0.0)
                }
            })
            .collect();
    }
    [values[0], values[1], values[2]]
}

/// Lamp and camera for given angles: the normal is z, the half vector lies in the plane x, z.
fn vectors(half_polar: f64, difference_polar: f64, azimuth: f64) -> (glam::DVec3, glam::DVec3) {
    use glam::{DQuat, DVec3};
    let half = DQuat::from_rotation_y(half_polar) * DVec3::Z;
    let (sin, cos) = difference_polar.sin_cos();
    let difference = DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos);
    let lamp = DQuat::from_rotation_y(half_polar) * difference;
    (lamp, 2.0 * lamp.dot(half) * half - lamp)
}

fn ours(material: &Measured, lamp: glam::DVec3, camera: glam::DVec3) -> [f64; 3] {
    let half = (lamp + camera).normalize();
    let all = |value: f64| [value as f32; LANES];
    let geometry = Geometry {
        to_lamp: all(lamp.z),
        to_half: all(half.z),
        lamp_to_half: all(lamp.dot(half)),
        side: all(lamp.dot(glam::DVec3::Z.cross(half))),
    };
    material
        .reflectance(&geometry)
        .map(|lanes| f64::from(lanes[7]))
}

pub(super) fn numbers(seed: u64) -> Vec<f32> {
    let mut random = Random::new(seed, Stream::Material);
    (0..NUMBERS).map(|_| random.signed(0.4)).collect()
}

fn agrees(numbers: &[f32]) {
    let material = Measured::new(numbers);
    for half_polar in [0.02, 0.3, 0.8, 1.2] {
        for difference_polar in [0.05, 0.5, 1.1] {
            for azimuth in [0.1, 1.0, 2.0, 3.0] {
                let (lamp, camera) = vectors(half_polar, difference_polar, azimuth);
                let expected = direct(numbers, half_polar, difference_polar, azimuth);
                let found = ours(&material, lamp, camera);
                for (found, expected) in found.iter().zip(expected) {
                    let off = (found - expected).abs();
                    assert!(off < 2e-3 * expected + 2e-4, "{found} against {expected}");
                }
                // Lamp and camera may change places.
                for (a, b) in found.iter().zip(ours(&material, camera, lamp)) {
                    assert!((a - b).abs() < 1e-3 * a + 1e-4);
                }
            }
        }
    }
}

#[test]
fn reflectance_is_that_of_the_network_at_the_same_angles() {
    for seed in 0..5 {
        agrees(&numbers(seed));
    }
}

#[test]
fn the_shared_materials_are_evaluated_as_their_networks_say() {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/brdf/merl_nbrdf.npz");
    if !file.exists() {
        eprintln!("skipped: {} is missing", file.display());
        return;
    }
    let materials = Measured::read(&file).unwrap();
    assert_eq!(materials.len(), 100);
    let mut archive = ZipArchive::new(File::open(&file).unwrap()).unwrap();
    let array = npyz::NpyFile::new(archive.by_name("W.npy").unwrap()).unwrap();
    let all: Vec<f32> = array.into_vec().unwrap();
    for numbers in all.chunks_exact(NUMBERS) {
        agrees(numbers);
    }
    for material in materials {
        assert!(material.scattered().min_element() >= 0.0);
    }
}

fn archive(name: &str, array: &[u8]) -> tempfile::NamedTempFile {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    let mut writer = ZipWriter::new(&mut file);
    writer
        .start_file(name, SimpleFileOptions::default())
        .unwrap();
    writer.write_all(array).unwrap();
    writer.finish().unwrap();
    file
}

fn array(rows: u64, columns: u64, value: f32) -> Vec<u8> {
    use npyz::WriterBuilder;
    let mut bytes = Vec::new();
    let options = npyz::WriteOptions::new()
        .default_dtype()
        .shape(&[rows, columns]);
    let mut writer = options.writer(&mut bytes).begin_nd().unwrap();
    writer.extend((0..rows * columns).map(|_| value)).unwrap();
    writer.finish().unwrap();
    bytes
}

#[test]
fn other_files_are_told_apart() {
    let message =
        |file: &tempfile::NamedTempFile| Measured::read(file.path()).unwrap_err().to_string();
    let mut text = tempfile::NamedTempFile::new().unwrap();
    text.write_all(b"no archive at all").unwrap();
    assert!(message(&text).contains("no archive"), "{}", message(&text));
    let other = archive("X.npy", &array(2, 675, 0.1));
    assert!(
        message(&other).contains("no readable W"),
        "{}",
        message(&other)
    );
    let narrow = archive("W.npy", &array(2, 600, 0.1));
    assert!(
        message(&narrow).contains("W of shape [2, 600]"),
        "{}",
        message(&narrow)
    );
    let broken = archive("W.npy", &array(1, 675, f32::NAN));
    assert!(
        message(&broken).contains("NaN in W"),
        "{}",
        message(&broken)
    );
    let mut turned = array(2, 675, 0.1);
    let place = turned
        .windows(5)
        .position(|bytes| bytes == b"False")
        .unwrap();
    turned.splice(place..place + 5, *b"True ");
    let turned = archive("W.npy", &turned);
    assert!(
        message(&turned).contains("order of Fortran"),
        "{}",
        message(&turned)
    );
    let cut = archive("W.npy", &array(3, 675, 0.1)[..4000]);
    assert!(Measured::read(cut.path()).is_err());
    let missing = Measured::read(Path::new("nowhere/merl.npz")).unwrap_err();
    assert!(missing.to_string().contains("nowhere/merl.npz"));
    assert_eq!(
        Measured::read(archive("W.npy", &array(3, 675, 0.1)).path())
            .unwrap()
            .len(),
        3
    );
}
