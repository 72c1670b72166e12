//! Averages over views, against turned photographs and against the bare network.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

mod helpers;
mod scene;

use burn::tensor::{Device, Tensor, TensorData};
use normalight_core::{RefitSettings, Symmetry, Vec3};
use normalight_model::{
    EstimateInput, EstimateSettings, Estimator, LightArchitecture, LightNetwork, ModelError,
    NoopObserver, NormalArchitecture, NormalNetwork, Observer, Progress, Quality, Weights,
};
use scene::{IMAGES, Scene, Untrained, furthest, turned_back};
use std::collections::BTreeMap;
use std::ops::ControlFlow;

#[test]
fn all_views_are_the_mean_over_turned_photographs() {
    let untrained = Untrained::new();
    // Odd sides; and an object of two whole tiles, which divide it alike however it is turned.
    let odd = Scene::new(37, 22, |x, y| x < 3 || y > 18 || (x + y) % 11 == 0);
    let tiles = Scene::new(1024, 20, |x, y| (x * y) % 13 == 7);
    for scene in [odd, tiles] {
        let mut sum = vec![vec![Vec3::ZERO; scene.inside[0].len()]; scene.inside.len()];
        for symmetry in Symmetry::ALL {
            let view = untrained
                .normals(
                    &scene.turned(symmetry),
                    &[Symmetry::NONE],
                    &mut NoopObserver,
                )
                .unwrap();
            let back = turned_back(symmetry, view);
            for (sum, normal) in sum.iter_mut().flatten().zip(back.concat()) {
                *sum += symmetry.inverse().vector(normal);
            }
        }
        for normal in sum.iter_mut().flatten() {
            *normal = normal.normalize_or_zero();
        }
        let views = Quality::Best.views();
        let mean = untrained.normals(&scene, views, &mut NoopObserver).unwrap();
        assert!(furthest(&mean, &sum) < 1e-4, "{}", furthest(&mean, &sum));
        let one = untrained
            .normals(&scene, Quality::Fast.views(), &mut NoopObserver)
            .unwrap();
        assert!(furthest(&mean, &one) > 0.01, "the views are all alike");
        // So turned photographs give turned normals.
        let turn = Symmetry::ALL[5];
        let there = untrained
            .normals(&scene.turned(turn), views, &mut NoopObserver)
            .unwrap();
        let mut back = turned_back(turn, there);
        for normal in back.iter_mut().flatten() {
            *normal = turn.inverse().vector(*normal);
        }
        assert!(furthest(&mean, &back) < 1e-4);
    }
}

#[test]
fn one_view_is_the_bare_network() {
    let scene = Scene::new(24, 16, |x, y| x + y < 5);
    let untrained = Untrained::new();
    let mut values = Vec::new();
    for (image, light) in scene.images.iter().zip(&scene.lights) {
        for (y, row) in image.iter().enumerate() {
            for (x, pixel) in row.iter().enumerate() {
                let inside = scene.inside[y][x];
                for (channel, value) in pixel.iter().enumerate() {
                    let relit = |image: usize| {
                        let factor = 1.0 / scene.lights[image].intensity[channel];
                        (scene.images[image][y][x][channel] * factor).powi(2)
                    };
                    let square = (0..IMAGES).map(relit).fold(0.0, |sum, value| sum + value);
                    let scale = 1.0 / (square / IMAGES as f32).sqrt();
                    let factor = 1.0 / light.intensity[channel];
                    let scale = if inside { scale } else { 0.0 };
                    values.push(value * factor * scale);
                }
                values.extend(light.direction.to_array());
                values.push(f32::from(u8::from(inside)));
            }
        }
    }
    let input = TensorData::new(values, [IMAGES, 16, 24, 7]);
    let network = &untrained.loaded.network;
    let fused = network.fuse(Tensor::from_data(input, &untrained.loaded.device), 1);
    let output = network.regress(fused).into_data();
    let output = output.try_to_vec::<f32>().unwrap();
    let found = untrained
        .normals(&scene, Quality::Fast.views(), &mut NoopObserver)
        .unwrap();
    let places = found.iter().flatten().zip(output.chunks_exact(3));
    for ((found, expected), inside) in places.zip(scene.inside.concat()) {
        let expected = if inside { expected } else { &[0.0; 3] };
        assert!(found.distance(Vec3::from_slice(expected)) < 1e-4);
    }
}

#[test]
fn copies_of_the_photographs_change_nothing() {
    let scene = Scene::new(24, 16, |x, y| x + y < 5);
    // Twice as many as meet in one maximum, so that there are two groups, in each of which every image is.
    let copies = Scene {
        images: vec![scene.images.clone(); 16].concat(),
        lights: vec![scene.lights.clone(); 16].concat(),
        ..scene.clone()
    };
    let untrained = Untrained::new();
    let [few, many] = [&scene, &copies].map(|scene| {
        let views = Quality::Default.views();
        untrained.normals(scene, views, &mut NoopObserver).unwrap()
    });
    assert!(furthest(&few, &many) < 1e-4, "{}", furthest(&few, &many));
}

/// Notes how far a run is, and stops it after some reports.
struct Patient {
    fractions: Vec<f32>,
    patience: usize,
}

impl Observer for Patient {
    async fn report(&mut self, progress: Progress) -> ControlFlow<()> {
        self.fractions.push(progress.fraction);
        if self.fractions.len() > self.patience {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

#[test]
fn views_make_progress_and_can_be_stopped() {
    let untrained = Untrained::new();
    let scene = Scene::new(16, 8, |_, _| false);
    let observed = |patience| {
        let mut observer = Patient {
            fractions: Vec::new(),
            patience,
        };
        let found = untrained.normals(&scene, Quality::Best.views(), &mut observer);
        (found, observer.fractions)
    };
    let (found, fractions) = observed(usize::MAX);
    assert!(found.is_ok());
    // One report for each view, as all images pass the network together; and the end.
    let expected: Vec<f32> = (0..=8).map(|view| view as f32 / 8.0).collect();
    assert_eq!(fractions, expected);
    let (found, fractions) = observed(5);
    assert!(matches!(found, Err(ModelError::Cancelled)));
    assert_eq!(fractions.len(), 6);
}

#[test]
fn mirrored_photographs_give_mirrored_lights() {
    let device = Device::flex();
    let notes = BTreeMap::new();
    let (light, normal) = (LightArchitecture::plain(), NormalArchitecture::plain());
    let network = LightNetwork::new(&light, false, &device).unwrap();
    let light = Weights::light_bytes(&light, &network, &notes).unwrap();
    let network = NormalNetwork::new(&normal, false, &device).unwrap();
    let normal = Weights::normal_bytes(&normal, &network, &notes).unwrap();
    let read = |bytes: &[u8]| Weights::from_bytes("untrained", bytes).unwrap();
    let estimator = Estimator::new(&read(&light), &read(&normal), device).unwrap();

    let scene = Scene::new(41, 30, |x, y| x < 9 || x + y > 60);
    let mirror = Symmetry::ALL[1];
    let difference = |quality, refit| {
        let settings = EstimateSettings {
            refit,
            quality,
            ..EstimateSettings::default()
        };
        let [one, two] = [scene.clone(), scene.turned(mirror)].map(|scene| {
            let (stack, mask, mut quiet) = (scene.stack(), scene.mask(), NoopObserver);
            let found = estimator.estimate(
                EstimateInput {
                    stack: &stack,
                    mask: &mask,
                    lights: None,
                },
                settings,
                &mut quiet,
            );
            pollster::block_on(found).unwrap().lights
        });
        let pairs = one.iter().zip(&two);
        let differences = pairs.map(|(one, two)| {
            let directions = one.direction.distance(mirror.vector(two.direction));
            let intensities = (one.intensity[0] - two.intensity[0]).abs();
            directions + intensities + (one.confidence - two.confidence).abs()
        });
        differences.fold(0.0, f32::max)
    };
    // How far the two are apart without averaging depends on the random weights.
    let apart = difference(Quality::Fast, None);
    for quality in [Quality::Default, Quality::Best] {
        let far = difference(quality, None);
        assert!(far < 0.1 * apart, "{quality:?}: {far} of {apart}");
    }
    let far = difference(Quality::Best, Some(RefitSettings::default()));
    assert!(far < 1e-3, "refitted: {far}");
}
