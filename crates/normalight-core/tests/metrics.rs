//! The metrics against an independent program in numpy; skipped where there is no python3 with numpy.
use normalight_core::{
    Light, Mask, NormalMap, Vec3, intensity_error, mean_light_error, normal_error,
};
use serde_json::{Value, json};
use std::io::Write;
use std::process::{Command, Stdio};

const SIDE: usize = 30;

/// What the program answers; `None`, with a word on standard output, where it cannot run.
#[allow(clippy::unwrap_used)]
fn by_numpy(given: &Value) -> Option<Value> {
    let numpy = Command::new("python3")
        .args(["-c", "import numpy"])
        .stderr(Stdio::null())
        .status();
    if !numpy.is_ok_and(|status| status.success()) {
        println!("skipped: no python3 with numpy");
        return None;
    }
    let mut program = Command::new("python3")
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/metrics.py"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = program.stdin.take().unwrap();
    input.write_all(given.to_string().as_bytes()).unwrap();
    drop(input);
    let output = program.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", output.status);
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

/// Numbers from -1 to 1, always the same.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        // Knuth's linear congruential generator: any will do.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }

    /// Lights, and others near them.
    fn lights(&mut self) -> [Vec<Light>; 2] {
        let pairs: Vec<[Light; 2]> = (0..17)
            .map(|_| {
                let direction = self.vector() + 1.5 * Vec3::Z;
                let near = direction + 0.3 * self.vector();
                [direction, near].map(|direction| Light {
                    intensity: [0; 3].map(|_| 1.0 + 0.8 * self.next()),
                    ..Light::new(direction, 1.0)
                })
            })
            .collect();
        [0, 1].map(|which| pairs.iter().map(|pair| pair[which]).collect())
    }
}

#[test]
fn numpy_finds_the_same_errors() {
    for seed in 0..3 {
        let random = &mut Random(seed);
        let truth: Vec<Vec3> = (0..SIDE * SIDE)
            .map(|_| random.vector() + Vec3::Z)
            .collect();
        let mut truth = NormalMap::new(SIDE, SIDE, truth).normals().to_vec();
        let mut estimate: Vec<Vec3> = truth.iter().map(|n| n + 0.6 * random.vector()).collect();
        // Pixels of which the truth is unknown, and of which the estimate says nothing.
        truth[5] = Vec3::ZERO;
        estimate[70] = Vec3::ZERO;
        let inside: Vec<bool> = (0..SIDE * SIDE).map(|_| random.next() < 0.4).collect();
        let [found, lights] = random.lights();
        let truth = NormalMap::new(SIDE, SIDE, truth);
        let estimate = NormalMap::new(SIDE, SIDE, estimate);
        let mask = Mask::new(SIDE, SIDE, inside);
        let numbers = |map: &NormalMap| -> Vec<[f32; 3]> {
            map.normals().iter().map(|n| n.to_array()).collect()
        };
        let directions = |lights: &[Light]| -> Vec<[f32; 3]> {
            lights.iter().map(|l| l.direction.to_array()).collect()
        };
        let intensities =
            |lights: &[Light]| -> Vec<[f32; 3]> { lights.iter().map(|l| l.intensity).collect() };
        let given = json!({
            "estimate": numbers(&estimate),
            "truth": numbers(&truth),
            "inside": mask.inside(),
            "found_directions": directions(&found),
            "directions": directions(&lights),
            "found_intensities": intensities(&found),
            "intensities": intensities(&lights),
        });
        let Some(expected) = by_numpy(&given) else {
            return;
        };
        let error = normal_error(&estimate, &truth, &mask).unwrap();
        let close = |found: f32, expected: &Value| {
            let expected = expected.as_f64().unwrap();
            assert!(
                (f64::from(found) - expected).abs() < 1e-4,
                "{found} {expected}"
            );
        };
        // Single precision of vectors alone is 1e-5 degrees; angles in radians.
        close(
            error.mean,
            &json!(expected["mean"].as_f64().unwrap().to_radians()),
        );
        close(
            error.median,
            &json!(expected["median"].as_f64().unwrap().to_radians()),
        );
        for (share, expected) in error
            .shares
            .iter()
            .zip(expected["shares"].as_array().unwrap())
        {
            close(*share, expected);
        }
        assert_eq!(json!(error.pixels), expected["pixels"]);
        let light = mean_light_error(&found, &lights).unwrap();
        close(
            light,
            &json!(expected["light"].as_f64().unwrap().to_radians()),
        );
        close(
            intensity_error(&found, &lights).unwrap(),
            &expected["intensity"],
        );
    }
}
