//! Networks against closed forms and against an independent backend.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use burn::module::Module;
use burn::tensor::{Device, Distribution, Tensor};
use normalight_core::{
    Decoding, ImageStack, Mask, Samples, StackImage, Transfer, Vec3, mean_light_error, normal_error,
};
use normalight_model::{
    CellLight, CellNormal, EstimateInput, EstimateSettings, Estimator, LightArchitecture,
    LightBody, LightNetwork, ModelError, NoopObserver, NormalArchitecture, NormalBody,
    NormalNetwork, PlainNormal, Upsampling, Weights, light_cost, normal_cost, paper_genotypes,
};
use std::collections::BTreeMap;

fn paper_light() -> LightArchitecture {
    LightArchitecture {
        body: LightBody::Cells(CellLight {
            width: 4,
            stem_strides: [1, 2],
            reductions: 2,
            hidden: 32,
            genotype: paper_genotypes().light.into(),
        }),
        ..LightArchitecture::plain()
    }
}

fn paper_normal(upsampling: Upsampling, stem_strides: [usize; 2]) -> NormalArchitecture {
    NormalArchitecture {
        mask_channel: stem_strides[1] == 1,
        body: NormalBody::Cells(CellNormal {
            width: 4,
            stem_strides,
            reductions: 2,
            upsampling,
            fused_convolutions: stem_strides[1],
            genotype: paper_genotypes().normal.into(),
        }),
    }
}

#[test]
fn layers_have_the_parameters_of_the_closed_form() {
    let device = Device::flex();
    for architecture in [LightArchitecture::plain(), paper_light()] {
        let network = LightNetwork::new(&architecture, false, &device).unwrap();
        let expected = light_cost(&architecture).parameters + running_statistics(&network);
        assert_eq!(network.num_params(), expected);
    }
    for architecture in [
        NormalArchitecture::plain(),
        paper_normal(Upsampling::Nearest, [1, 2]),
        paper_normal(Upsampling::Transposed, [1, 1]),
    ] {
        let network = NormalNetwork::new(&architecture, false, &device).unwrap();
        let expected = normal_cost(&architecture, 0).parameters + running_statistics(&network);
        assert_eq!(network.num_params(), expected);
    }
}

/// Values that batch normalisation keeps beside its parameters: Burn counts them too.
fn running_statistics<M: Module>(network: &M) -> usize {
    struct Counter {
        path: Vec<String>,
        count: usize,
    }
    impl burn::module::ModuleVisitor for Counter {
        fn enter_module(&mut self, name: &str, _container: &str) {
            self.path.push(name.to_owned());
        }
        fn exit_module(&mut self, _name: &str, _container: &str) {
            self.path.pop();
        }
        fn visit_float<const D: usize>(&mut self, param: &burn::module::Param<Tensor<D>>) {
            if self
                .path
                .last()
                .is_some_and(|name| name.starts_with("running"))
            {
                self.count += param.shape().num_elements();
            }
        }
    }
    let mut counter = Counter {
        path: Vec::new(),
        count: 0,
    };
    network.visit(&mut counter);
    counter.count
}

#[test]
fn folding_keeps_the_function() {
    let device = Device::flex();
    let architecture = paper_normal(Upsampling::Nearest, [1, 2]);
    let network = NormalNetwork::new(&architecture, false, &device).unwrap();
    let input = Tensor::<4>::random([2, 16, 24, 6], Distribution::Default, &device);
    let run = |network: &NormalNetwork| network.regress(network.fuse(input.clone(), 1));
    let difference = (run(&network) - run(&network.folded())).abs().max();
    assert!(difference.into_scalar::<f32>() < 1e-4);
}

/// A stack may come in parts and in any order, as the pipeline and the trainer bring it, on every backend.
#[test]
#[expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]
fn branch_and_residuals_are_counted_and_take_images_in_parts() {
    let architecture = NormalArchitecture {
        mask_channel: false,
        body: NormalBody::Plain(PlainNormal {
            widths: [16, 32, 64],
            head: 32,
            residuals: 2,
            pixel_branch: 32,
        }),
    };
    let device = Device::flex();
    let network = NormalNetwork::new(&architecture, false, &device).unwrap();
    assert_eq!(
        network.num_params(),
        normal_cost(&architecture, 1024).parameters
    );
    // By hand: two layers of 64 to 64, two of single pixels, the joining one, and a wider output.
    let more = 2 * (9 * 64 * 64 + 64) + (7 * 32 + 33 * 32) + (9 * 96 * 32 + 32) + 9 * 64 * 3;
    assert_eq!(network.num_params(), 126_515 + more);
    let input = Tensor::<4>::random([5, 16, 24, 6], Distribution::Default, &device);
    let part = |from: usize, to: usize| input.clone().narrow(0, from, to - from);
    let whole = network.regress(network.fuse(input.clone(), 1));
    let parts = network.fuse(part(2, 5), 1).and(network.fuse(part(0, 2), 1));
    let apart = |other: Tensor<4>| {
        let difference = (whole.clone() - other).abs().max();
        difference.into_scalar::<f32>()
    };
    assert!(apart(network.regress(parts)) < 1e-4);
    // Two stacks at once are each by itself.
    let both = Tensor::cat(vec![input.clone(), input.clone() * 0.5], 0);
    let both = network.regress(network.fuse(both, 2));
    assert!(apart(both.clone().narrow(0, 0, 1)) < 1e-4);
    assert!(apart(both.narrow(0, 1, 1)) > 1e-3);
    let bytes = Weights::normal_bytes(&architecture, &network, &BTreeMap::new()).unwrap();
    let weights = Weights::from_bytes("normal.safetensors", &bytes).unwrap();
    let reference = Device::ndarray();
    let [ours, theirs] = [&device, &reference].map(|device| {
        let loaded = weights.normal_network(device).unwrap();
        assert_eq!(loaded.architecture, architecture);
        let network = loaded.network;
        let input = Tensor::<4>::from_data(input.to_data(), device);
        let normals = network.regress(network.fuse(input, 1));
        normals.into_data().try_to_vec::<f32>().unwrap()
    });
    let worst = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs());
    assert!(worst.fold(0.0, f32::max) < 1e-3);
}

#[test]
fn weights_come_back_and_wrong_files_are_refused() {
    let device = Device::flex();
    let architecture = LightArchitecture::plain();
    let network = LightNetwork::new(&architecture, false, &device).unwrap();
    let bytes = Weights::light_bytes(&architecture, &network, &BTreeMap::new()).unwrap();
    let weights = Weights::from_bytes("light.safetensors", &bytes).unwrap();
    let loaded = weights.light_network(&device).unwrap();
    assert_eq!(loaded.architecture, architecture);
    let input = Tensor::<4>::random([3, 64, 64, 4], Distribution::Default, &device);
    let run = |network: &LightNetwork| {
        let own = network.features(input.clone());
        let fused = own.clone().max_dim(0).expand(own.dims());
        network.classify(own, fused)
    };
    // Half precision keeps three digits.
    let difference = (run(&network) - run(&loaded.network))
        .abs()
        .max()
        .into_scalar::<f32>();
    assert!(difference < 1e-2, "{difference}");
    let error = weights.normal_network(&device).unwrap_err().to_string();
    assert!(
        error.contains("holds a light network, a normal network"),
        "{error}"
    );
    for broken in [&bytes[..bytes.len() / 2], b"not a file", &[]] {
        let error = Weights::from_bytes("w.safetensors", broken).unwrap_err();
        assert!(
            matches!(error, ModelError::CorruptWeights { .. }),
            "{error}"
        );
    }
}

/// A Lambertian hemisphere under eight lights.
fn stack() -> (ImageStack, Mask) {
    let side = 40;
    let normal = |index: usize| {
        let x = (index % side) as f32 / 20.0 - 0.975;
        let y = 0.975 - (index / side) as f32 / 20.0;
        let square = 1.0 - x * x - y * y;
        (square > 0.0).then(|| Vec3::new(x, y, square.sqrt()))
    };
    let images = (0..8)
        .map(|k| {
            let turn = k as f32 * 0.8;
            let light = Vec3::new(0.5 * turn.cos(), 0.5 * turn.sin(), 0.8).normalize();
            let shade = |index| normal(index).map_or(0.0, |n| n.dot(light).max(0.0));
            StackImage {
                name: format!("{k}.png"),
                width: side,
                height: side,
                channels: 1,
                samples: Samples::F32((0..side * side).map(shade).collect()),
                transfer: Transfer::Linear,
            }
        })
        .collect();
    let inside = (0..side * side)
        .map(|index| normal(index).is_some())
        .collect();
    (
        ImageStack::new(images).unwrap(),
        Mask::new(side, side, inside),
    )
}

#[test]
fn both_backends_give_one_answer() {
    let device = Device::flex();
    let (light, normal) = (LightArchitecture::plain(), NormalArchitecture::plain());
    let notes = BTreeMap::new();
    let network = LightNetwork::new(&light, false, &device).unwrap();
    let light = Weights::light_bytes(&light, &network, &notes).unwrap();
    let network = NormalNetwork::new(&normal, false, &device).unwrap();
    let normal = Weights::normal_bytes(&normal, &network, &notes).unwrap();
    let light = Weights::from_bytes("light", &light).unwrap();
    let normal = Weights::from_bytes("normal", &normal).unwrap();
    let (stack, mask) = stack();
    let settings = EstimateSettings {
        decoding: Decoding::SoftArgmax,
        ..EstimateSettings::default()
    };
    let run = |device: Device| {
        let estimator = Estimator::new(&light, &normal, device).unwrap();
        let mut observer = NoopObserver;
        let estimate = estimator.estimate(
            EstimateInput {
                stack: &stack,
                mask: &mask,
                lights: None,
            },
            settings,
            &mut observer,
        );
        pollster::block_on(estimate).unwrap()
    };
    #[expect(
        deprecated,
        reason = "the last Burn with this independent reference is pinned"
    )]
    let reference = run(Device::ndarray());
    let fast = run(Device::flex());
    let lights = mean_light_error(&fast.lights, &reference.lights).unwrap();
    assert!(lights.to_degrees() < 0.1, "{lights}");
    let normals = normal_error(&fast.normals, &reference.normals, &mask).unwrap();
    assert!(normals.mean.to_degrees() < 0.1, "{}", normals.mean);
    assert_eq!(normals.pixels, mask.count());
}
