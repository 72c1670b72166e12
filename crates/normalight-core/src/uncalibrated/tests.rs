use super::*;
use crate::robust::tests::{SIDE, ball, photographs, spiral};
use crate::{Samples, intensity_error, mean_light_error, normal_error};

/// The left half twice as bright as the right one.
fn two_albedos(stack: ImageStack) -> ImageStack {
    let mut images = stack.into_images();
    for image in &mut images {
        let Samples::F32(samples) = &mut image.samples else {
            unreachable!("made of floats")
        };
        for (pixel, sample) in samples.iter_mut().enumerate() {
            *sample *= if pixel % SIDE < SIDE / 2 { 1.0 } else { 0.5 };
        }
    }
    ImageStack::new(images).unwrap()
}

#[test]
fn a_matte_ball_comes_back_without_its_lights() {
    let (truth, mask) = ball();
    let lights = spiral(96, 0.8);
    let plain = photographs(&truth, &lights, 0.0);
    let painted = two_albedos(plain.clone());
    let shiny = photographs(&truth, &lights, 0.3);
    for (stack, normals, others) in [(plain, 1.0, 1.0), (painted, 1.0, 1.0), (shiny, 3.0, 3.0)] {
        let found = uncalibrated_factorisation(&stack, &mask).unwrap();
        let error = normal_error(&found.normals, &truth, &mask).unwrap();
        let light = mean_light_error(&found.lights, &lights).unwrap();
        let intensity = intensity_error(&found.lights, &lights).unwrap();
        assert!(error.mean.to_degrees() < normals, "{error:?}");
        assert!(light.to_degrees() < others, "{}", light.to_degrees());
        assert!(intensity < 0.03, "{intensity}");
        let mean = found.lights.iter().map(Light::mean_intensity).sum::<f32>() / 96.0;
        assert!((mean - 1.0).abs() < 1e-4);
    }
}

#[test]
fn albedo_comes_out() {
    let (truth, mask) = ball();
    let stack = two_albedos(photographs(&truth, &spiral(24, 0.8), 0.0));
    let found = uncalibrated_factorisation(&stack, &mask).unwrap();
    let row = SIDE / 2 * SIDE;
    let ratio = found.albedo[row + SIDE / 4] / found.albedo[row + 3 * SIDE / 4];
    assert!((ratio - 2.0).abs() < 0.05, "{ratio}");
    assert_eq!(found.albedo[0], 0.0);
}

#[test]
fn what_leaves_the_answer_open_is_said() {
    let (truth, mask) = ball();
    let of = |stack: &ImageStack, mask: &Mask| uncalibrated_factorisation(stack, mask).err();
    let low = |images| Some(CoreError::RankTooLow { images });
    let line: Vec<Light> = (0..9)
        .map(|k| Light::new(Vec3::new(0.15 * (k as f32 - 4.0), 0.0, 1.0), 1.0))
        .collect();
    assert_eq!(of(&photographs(&truth, &line, 0.0), &mask), low(9));
    // The same photograph again and again; a plane.
    let same = photographs(&truth, &[Light::new(Vec3::Z, 1.0); 5], 0.0);
    assert_eq!(of(&same, &mask), low(5));
    let flat = NormalMap::new(SIDE, SIDE, vec![Vec3::Z; SIDE * SIDE]);
    let lights = spiral(12, 0.8);
    let whole = Mask::whole(SIDE, SIDE);
    assert_eq!(of(&photographs(&flat, &lights, 0.0), &whole), low(12));
    let three = photographs(&truth, &lights[..3], 0.0);
    let few = CoreError::TooFewImages {
        found: 3,
        expected: 4,
    };
    assert_eq!(of(&three, &mask), Some(few));
    let middle = SIDE / 2 * SIDE + SIDE / 2;
    let dot = (0..SIDE * SIDE).map(|pixel| pixel == middle).collect();
    let stack = photographs(&truth, &lights, 0.0);
    assert!(matches!(
        of(&stack, &Mask::new(SIDE, SIDE, dot)),
        Some(CoreError::TooFewPixels { found: 0, .. })
    ));
    // Black images among the others, noise instead of photographs: an error or an answer, no panic.
    let mut images = stack.into_images();
    images[3].samples = Samples::F32(vec![0.0; SIDE * SIDE]);
    if let Ok(found) = uncalibrated_factorisation(&ImageStack::new(images).unwrap(), &mask) {
        assert!(found.lights.iter().all(|light| light.direction.is_finite()));
    }
}
