use super::*;
use crate::{Samples, StackImage, Transfer, least_squares_normals, normal_error};

pub(crate) const SIDE: usize = 64;

/// Normals of a ball that fills the frame.
pub(crate) fn ball() -> (NormalMap, Mask) {
    let half = SIDE as f32 / 2.0;
    let normals: Vec<Vec3> = (0..SIDE * SIDE)
        .map(|pixel| {
            let x = ((pixel % SIDE) as f32 + 0.5) / half - 1.0;
            let y = 1.0 - ((pixel / SIDE) as f32 + 0.5) / half;
            let square = 1.0 - x * x - y * y;
            if square > 0.0 {
                Vec3::new(x, y, square.sqrt())
            } else {
                Vec3::ZERO
            }
        })
        .collect();
    let inside = normals.iter().map(|normal| *normal != Vec3::ZERO).collect();
    (
        NormalMap::new(SIDE, SIDE, normals),
        Mask::new(SIDE, SIDE, inside),
    )
}

/// Lights on a spiral up to some angle from the viewing axis.
pub(crate) fn spiral(count: usize, most: f32) -> Vec<Light> {
    (0..count)
        .map(|k| {
            let tilt = most * ((k as f32 + 0.5) / count as f32).sqrt();
            let turn = 2.4 * k as f32;
            let direction = Vec3::new(turn.cos() * tilt.sin(), turn.sin() * tilt.sin(), tilt.cos());
            Light::new(direction, 0.5 + (k % 5) as f32 * 0.25)
        })
        .collect()
}

/// Lambert's law with attached shadows and Blinn's highlights of a strength.
pub(crate) fn photographs(normals: &NormalMap, lights: &[Light], highlight: f32) -> ImageStack {
    let image = |light: &Light| StackImage {
        name: String::new(),
        width: SIDE,
        height: SIDE,
        channels: 1,
        samples: Samples::F32(
            normals
                .normals()
                .iter()
                .map(|normal| {
                    let half = (light.direction + Vec3::Z).normalize();
                    let shine = highlight * normal.dot(half).max(0.0).powi(40);
                    let shading = normal.dot(light.direction).max(0.0);
                    light.mean_intensity() * (0.4 * shading + shine)
                })
                .collect(),
        ),
        transfer: Transfer::Linear,
    };
    ImageStack::new(lights.iter().map(image).collect()).unwrap()
}

#[test]
fn exact_on_lambert_with_shadows() {
    let (truth, mask) = ball();
    let lights = spiral(24, 0.9);
    let stack = photographs(&truth, &lights, 0.0);
    let (normals, albedo) = robust_normals(&stack, &mask, &lights).unwrap();
    let error = normal_error(&normals, &truth, &mask).unwrap();
    assert!(error.mean.to_degrees() < 0.02, "{error:?}");
    for (pixel, &inside) in mask.inside().iter().enumerate() {
        // The grey weights sum to 0.9999.
        let expected = if inside { 0.4 * 0.9999 } else { 0.0 };
        assert!((albedo[pixel] - expected).abs() < 2e-3, "{}", albedo[pixel]);
    }
    let (squares, _) = least_squares_normals(&stack, &mask, &lights).unwrap();
    assert!(normal_error(&squares, &truth, &mask).unwrap().mean > 10.0 * error.mean);
}

#[test]
fn highlights_mislead_little() {
    let (truth, mask) = ball();
    let lights = spiral(40, 0.8);
    let stack = photographs(&truth, &lights, 0.5);
    let error = |normals: &NormalMap| {
        let error = normal_error(normals, &truth, &mask).unwrap();
        error.mean.to_degrees()
    };
    let robust = error(&robust_normals(&stack, &mask, &lights).unwrap().0);
    let squares = error(&least_squares_normals(&stack, &mask, &lights).unwrap().0);
    assert!(robust < 2.5 && squares > 3.0 * robust, "{robust} {squares}");
}

/// The sum of absolute residuals is no larger anywhere around.
#[test]
fn least_absolute_residuals() {
    let lights: Vec<Vec3> = spiral(15, 1.0).iter().map(|l| l.direction).collect();
    let values: Vec<f32> = (0..15)
        .map(|k| lights[k].dot(Vec3::new(0.2, 0.1, 0.6)) + 0.05 * ((k * 7) % 5) as f32)
        .collect();
    let kept = Kept::of(&values);
    let sum = |g: Vec3| -> f32 {
        let pairs = lights.iter().zip(&values).filter(|(_, v)| kept.keeps(**v));
        pairs.map(|(l, v)| (v - l.dot(g)).abs()).sum()
    };
    let found = Fitter::default().fit(&lights, &values, kept);
    for step in [
        Vec3::X,
        Vec3::Y,
        Vec3::Z,
        Vec3::ONE,
        Vec3::NEG_X,
        Vec3::NEG_Y,
        Vec3::NEG_Z,
    ] {
        assert!(sum(found) < sum(found + 0.02 * step), "{step}");
    }
}

#[test]
fn what_cannot_be_fitted_is_said() {
    let (truth, mask) = ball();
    let lights = spiral(5, 0.8);
    let stack = photographs(&truth, &lights, 0.0);
    let of = |stack: &ImageStack, lights: &[Light]| robust_normals(stack, &mask, lights);
    assert!(matches!(
        of(&stack, &lights[..4]),
        Err(CoreError::LightCount {
            found: 4,
            expected: 5
        })
    ));
    let line: Vec<Light> = (0..5)
        .map(|k| Light::new(Vec3::new(0.2 * k as f32, 0.0, 1.0), 1.0))
        .collect();
    assert_eq!(
        of(&stack, &line),
        Err(CoreError::LightsInPlane { lights: 5 })
    );
    let three = photographs(&truth, &lights[..3], 0.0);
    assert!(matches!(
        of(&three, &lights[..3]),
        Err(CoreError::TooFewImages {
            found: 3,
            expected: 4
        })
    ));
    // Pixels that are black in all or nearly all images say nothing, and do no harm.
    let mut images = stack.into_images();
    for (k, image) in images.iter_mut().enumerate() {
        let Samples::F32(samples) = &mut image.samples else {
            unreachable!("made of floats")
        };
        samples[SIDE * SIDE / 2] = 0.0;
        samples[SIDE * SIDE / 2 + 1] = if k == 0 { 0.3 } else { 0.0 };
    }
    let (normals, albedo) = of(&ImageStack::new(images).unwrap(), &lights).unwrap();
    assert_eq!(normals.normals()[SIDE * SIDE / 2], Vec3::ZERO);
    assert!(albedo.iter().all(|value| value.is_finite()));
}
