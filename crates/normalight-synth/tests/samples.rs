//! Samples as a user of the crate sees them, against physics written out here.
#![allow(clippy::unwrap_used, reason = "what fails here fails a test")]

use normalight_core::{Samples, angle_between, least_squares_normals, normal_error};
use normalight_synth::{
    BitDepth, CameraRecipe, Framing, LightRecipe, MaterialRecipe, Renderer, Sample, SceneRecipe,
    ShapeRecipe, TransportRecipe,
};

fn render_sample(
    recipe: &SceneRecipe,
    number: u64,
    images: usize,
    size: usize,
    framing: Framing,
) -> Sample {
    let renderer = Renderer::new(recipe.clone()).unwrap();
    renderer.sample(number, images, size, framing)
}

/// White matte spheres, an exact camera, direct light only.
fn plain_recipe() -> SceneRecipe {
    SceneRecipe {
        shapes: ShapeRecipe {
            sphere: 1.0,
            ellipsoid: 0.0,
            blob: 0.0,
            lathe: 0.0,
            statue: 0.0,
            plate: 0.0,
            relief_share: 0.0,
            perspective_share: 0.0,
            ..ShapeRecipe::default()
        },
        materials: MaterialRecipe {
            metal_share: 0.0,
            matte_share: 1.0,
            rough_diffuse_share: 0.0,
            sheen_share: 0.0,
            mixed_share: 0.0,
            textured_share: 0.0,
            ..MaterialRecipe::default()
        },
        lights: LightRecipe {
            near_share: 0.0,
            colour_share: 0.0,
            ..LightRecipe::default()
        },
        transport: TransportRecipe {
            cast_shadow_share: 0.0,
            bounce_share: 0.0,
            ambient_share: 0.0,
            ambient: 0.0,
        },
        camera: CameraRecipe {
            clip_share: 0.0,
            noise: [0.0, 0.0],
            linear_8_bit_share: 0.0,
            srgb_8_bit_share: 0.0,
            mean: [0.05, 0.2],
            jpeg_share: 0.0,
            shift_share: 0.0,
            blur_share: 0.0,
            ..CameraRecipe::default()
        },
        ..SceneRecipe::default()
    }
}

fn bits(sample: &Sample) -> Vec<u32> {
    let normals = sample.normals.iter().flat_map(|normal| normal.to_array());
    let lights = sample.lights.iter().flat_map(|light| {
        light
            .direction
            .to_array()
            .into_iter()
            .chain(light.intensity)
    });
    sample
        .images
        .iter()
        .copied()
        .chain(normals)
        .chain(lights)
        .map(f32::to_bits)
        .collect()
}

#[test]
fn sphere_normals_match_their_place_in_the_outline() {
    for seed in 0..10 {
        let sample = render_sample(&plain_recipe(), seed, 3, 64, Framing::WholeObject);
        let size = sample.size;
        let inside: Vec<usize> = (0..size * size)
            .filter(|&pixel| sample.mask[pixel])
            .collect();
        // Centre and radius from the outline alone.
        let columns: Vec<usize> = inside.iter().map(|pixel| pixel % size).collect();
        let rows: Vec<usize> = inside.iter().map(|pixel| pixel / size).collect();
        let middle = |places: &[usize]| places.iter().sum::<usize>() as f32 / places.len() as f32;
        let (column, row) = (middle(&columns), middle(&rows));
        let radius = (inside.len() as f32 / std::f32::consts::PI).sqrt();
        for &pixel in &inside {
            let x = ((pixel % size) as f32 - column) / radius;
            let y = (row - (pixel / size) as f32) / radius;
            if x * x + y * y < 0.8 {
                let expected = glam::Vec3::new(x, y, (1.0 - x * x - y * y).sqrt());
                let degrees = angle_between(sample.normals[pixel], expected).to_degrees();
                assert!(
                    degrees < 2.5,
                    "seed {seed}, pixel {pixel}: {degrees} degrees"
                );
            }
        }
    }
}

#[test]
fn matte_images_are_albedo_times_cosine_times_intensity() {
    for seed in 0..20 {
        let sample = render_sample(&plain_recipe(), seed, 6, 32, Framing::Crop);
        let area = 32 * 32;
        // One factor per channel (albedo and exposure) explains all pixels of all images.
        let mut factor = [None; 3];
        for (image, light) in sample.lights.iter().enumerate() {
            for pixel in (0..area).filter(|&pixel| sample.mask[pixel]) {
                let cosine = sample.normals[pixel].dot(light.direction).max(0.0);
                let expected = cosine * light.intensity[0];
                for (channel, factor) in factor.iter_mut().enumerate() {
                    let value = sample.images[(image * 3 + channel) * area + pixel];
                    if expected > 0.1 {
                        let factor = *factor.get_or_insert(value / expected);
                        assert!(
                            (value - factor * expected).abs() < 2e-3 * value + 3e-5,
                            "seed {seed}: {value} against {}",
                            factor * expected
                        );
                    } else if expected == 0.0 {
                        assert_eq!(value, 0.0);
                    }
                }
            }
        }
    }
}

#[test]
fn woodham_recovers_matte_normals_from_the_exported_stack() {
    let recipe = SceneRecipe {
        lights: LightRecipe {
            // All lights within 20 degrees of the axis: hardly any attached shadow.
            rectangle: 0.0,
            cap: 1.0,
            ring: 0.0,
            dome: 0.0,
            path: 0.0,
            cap_degrees: [20.0, 20.0],
            shift_share: 0.0,
            ..plain_recipe().lights
        },
        ..plain_recipe()
    };
    let sample = render_sample(&recipe, 4, 20, 64, Framing::WholeObject);
    let (stack, mask) = (sample.to_stack().unwrap(), sample.to_mask());
    let (normals, _) = least_squares_normals(&stack, &mask, &sample.lights).unwrap();
    let error = normal_error(&normals, &sample.to_normal_map(), &mask).unwrap();
    assert!(error.mean.to_degrees() < 2.0, "{error:?}");
}

#[test]
fn same_seed_same_bits_on_any_thread() {
    let recipe = SceneRecipe::default();
    let render = move |seed| {
        let recipe = recipe.clone();
        std::thread::spawn(move || {
            [Framing::WholeObject, Framing::Crop]
                .map(|framing| bits(&render_sample(&recipe, seed, 5, 32, framing)))
        })
    };
    let pairs: Vec<_> = (0..10).map(|seed| (render(seed), render(seed))).collect();
    let mut last = Vec::new();
    for (first, second) in pairs {
        let first = first.join().unwrap();
        assert!(first == second.join().unwrap());
        assert!(
            first[0] != last,
            "neighbouring seeds give different samples"
        );
        last = first[0].clone();
    }
}

#[test]
fn more_images_keep_the_shape() {
    let recipe = SceneRecipe::default();
    let few = render_sample(&recipe, 9, 4, 32, Framing::WholeObject);
    let many = render_sample(&recipe, 9, 12, 32, Framing::WholeObject);
    assert_eq!(few.normals, many.normals);
}

#[test]
fn hundreds_of_samples_are_sound() {
    let recipe = SceneRecipe::default();
    for seed in 0..300 {
        for (framing, size) in [(Framing::WholeObject, 48), (Framing::Crop, 32)] {
            let sample = render_sample(&recipe, seed, 4, size, framing);
            let area = size * size;
            assert_eq!(sample.images.len(), 4 * 3 * area);
            let covered = sample.mask.iter().filter(|&&inside| inside).count() as f32;
            let least = match framing {
                Framing::WholeObject => 0.04,
                Framing::Crop => 0.4,
            };
            assert!(
                covered >= least * area as f32,
                "seed {seed} {framing:?}: {covered} pixels"
            );
            for (index, &value) in sample.images.iter().enumerate() {
                assert!((0.0..=1.0).contains(&value), "seed {seed}: {value}");
                assert!(sample.mask[index % area] || value == 0.0);
            }
            for (normal, &inside) in sample.normals.iter().zip(&sample.mask) {
                if inside {
                    assert!((normal.length() - 1.0).abs() < 1e-4 && normal.z > 0.0);
                } else {
                    assert_eq!(*normal, glam::Vec3::ZERO);
                }
            }
        }
    }
}

#[test]
fn whole_objects_stay_off_the_border() {
    let recipe = SceneRecipe::default();
    for seed in 0..100 {
        let sample = render_sample(&recipe, seed, 1, 64, Framing::WholeObject);
        let on_border = |pixel: usize| {
            let (row, column) = (pixel / 64, pixel % 64);
            row == 0 || column == 0 || row == 63 || column == 63
        };
        assert!(
            (0..64 * 64).all(|pixel| !(sample.mask[pixel] && on_border(pixel))),
            "seed {seed}"
        );
    }
}

#[test]
fn exported_integers_round_the_values() {
    let sample = render_sample(&SceneRecipe::default(), 3, 3, 16, Framing::Crop);
    let images = sample.to_stack_images(BitDepth::Sixteen);
    assert_eq!(images[2].name, "003.png");
    let Samples::U16(samples) = &images[1].samples else {
        panic!("16 bits were asked for");
    };
    // Interleaved colours against planes.
    let pixel = 100;
    for channel in 0..3 {
        let value = sample.images[(3 + channel) * 256 + pixel];
        let code = f32::from(samples[3 * pixel + channel]);
        assert!((code / 65535.0 - value).abs() <= 0.5 / 65535.0 + 1e-6);
    }
}
