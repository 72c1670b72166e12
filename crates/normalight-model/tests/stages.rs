//! Networks of stages against closed forms, the plain networks and an independent backend.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use burn::module::{Module, ModuleMapper, ModuleVisitor, Param};
use burn::tensor::{Device, Distribution, Tensor, TensorData};
use normalight_model::{
    FusedFeatures, LayerKind, LightArchitecture, LightBody, LightNetwork, Meeting,
    NormalArchitecture, NormalBody, NormalNetwork, PixelStage, Stage, StagedLight, StagedNormal,
    Weights, light_cost, normal_cost,
};
use std::collections::{BTreeMap, VecDeque};

/// The plain normal network of the default widths.
fn plain() -> StagedNormal {
    StagedNormal {
        down: vec![
            Stage::plain(16, 1),
            Stage::plain(32, 2),
            Stage::plain(64, 2),
        ],
        up: vec![Stage::plain(32, 2)],
        meeting: Meeting::Max,
        exchanges: 0,
        fused: vec![Stage::plain(32, 2), Stage::plain(32, 1)],
        pixels: None,
    }
}

fn plain_light() -> LightArchitecture {
    LightArchitecture {
        body: LightBody::Staged(StagedLight {
            features: vec![
                Stage::plain(16, 1),
                Stage::plain(32, 2),
                Stage::plain(64, 2),
            ],
            classifier: vec![Stage::plain(64, 1); 3],
            hidden: 128,
        }),
        ..LightArchitecture::plain()
    }
}

/// Every setting at another than its usual value somewhere.
fn rich() -> StagedNormal {
    let stage = |width, layers, kind, residual, normalised| Stage {
        width,
        layers,
        kind,
        residual,
        normalised,
    };
    StagedNormal {
        down: vec![
            stage(8, 2, LayerKind::Separable3, false, false),
            stage(12, 2, LayerKind::Separable5, true, true),
            stage(20, 3, LayerKind::Convolution3, true, true),
        ],
        up: vec![stage(16, 2, LayerKind::Transposed4, true, false)],
        meeting: Meeting::MaxMean,
        exchanges: 2,
        fused: vec![
            stage(12, 2, LayerKind::Pointwise, false, true),
            stage(8, 1, LayerKind::Separable5, false, false),
        ],
        pixels: Some(PixelStage {
            width: 8,
            layers: 3,
        }),
    }
}

fn normal(staged: StagedNormal) -> NormalArchitecture {
    NormalArchitecture {
        mask_channel: false,
        body: NormalBody::Staged(staged),
    }
}

fn build(staged: StagedNormal, device: &Device) -> NormalNetwork {
    NormalNetwork::new(&normal(staged), false, device).unwrap()
}

/// The numbers of a network in the order of its layers.
#[derive(Default)]
struct Numbers(VecDeque<TensorData>);

impl ModuleVisitor for Numbers {
    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        self.0.push_back(param.val().into_data());
    }
}

impl ModuleMapper for Numbers {
    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let data = self.0.pop_front().unwrap();
        param.map(|old| {
            assert_eq!(old.dims().to_vec(), data.shape().to_vec());
            Tensor::from_data(data, &old.device())
        })
    }
}

fn copied<M: Module>(from: &impl Module, to: M) -> M {
    let mut numbers = Numbers::default();
    from.visit(&mut numbers);
    let to = to.map(&mut numbers);
    assert!(numbers.0.is_empty());
    to
}

fn apart<const D: usize>(one: Tensor<D>, other: Tensor<D>) -> f32 {
    (one - other).abs().max().into_scalar::<f32>()
}

#[test]
fn the_plain_networks_are_points_of_the_space() {
    let device = Device::flex();
    let ours = NormalNetwork::new(&NormalArchitecture::plain(), false, &device).unwrap();
    let staged = copied(&ours, build(plain(), &device));
    let input = Tensor::<4>::random([3, 24, 32, 6], Distribution::Default, &device);
    let run = |network: &NormalNetwork| network.regress(network.fuse(input.clone(), 1));
    assert_eq!(apart(run(&ours), run(&staged)), 0.0);
    let (plain_cost, staged_cost) = (
        normal_cost(&NormalArchitecture::plain(), 1024),
        normal_cost(&normal(plain()), 1024),
    );
    assert_eq!(plain_cost, staged_cost);
    let ours = LightNetwork::new(&LightArchitecture::plain(), false, &device).unwrap();
    let staged = LightNetwork::new(&plain_light(), false, &device).unwrap();
    let staged = copied(&ours, staged);
    let input = Tensor::<4>::random([3, 64, 64, 4], Distribution::Default, &device);
    let run = |network: &LightNetwork| {
        let own = network.features(input.clone());
        let fused = own.clone().max_dim(0).expand(own.dims());
        network.classify(own, fused)
    };
    assert_eq!(apart(run(&ours), run(&staged)), 0.0);
    assert_eq!(
        light_cost(&LightArchitecture::plain()),
        light_cost(&plain_light())
    );
}

#[test]
fn costs_of_a_rich_network_by_hand() {
    let device = Device::flex();
    let architecture = normal(rich());
    let cost = normal_cost(&architecture, 32 * 32);
    // Convolutions to a width, depthwise ones, normalisation; the first layer sees colours and lights whole.
    let down = (9 * 6 * 8 + 8)
        + (9 * 8 + 8 * 8 + 8)
        + (25 * 8 + 8 * 12 + 2 * 12)
        + (25 * 12 + 12 * 12 + 2 * 12)
        + (9 * 12 * 20 + 2 * 20)
        + 2 * (9 * 20 * 20 + 2 * 20);
    let up = (16 * 20 * 16 + 16) + (9 * 16 * 16 + 16);
    let exchanges = 2 * (9 * 48 * 16 + 16);
    let fused = (32 * 12 + 2 * 12) + (12 * 12 + 2 * 12) + (25 * 12 + 12 * 8 + 8);
    let pixels = (6 * 8 + 8) + 2 * (8 * 8 + 8) + (9 * 24 * 8 + 8);
    let output = 9 * 24 * 3 + 3;
    assert_eq!(
        cost.parameters,
        down + up + exchanges + fused + pixels + output
    );
    // Burn counts what normalisation keeps, too: twice its width.
    let kept = 2 * (12 + 12 + 3 * 20 + 2 * 12);
    let network = build(rich(), &device);
    assert_eq!(network.num_params(), cost.parameters + kept);
    let (full, half, quarter) = (1024, 256, 64);
    let down = (9 * 6 * 8 + 9 * 8 + 8 * 8) * full
        + (25 * 8 + 8 * 12 + 25 * 12 + 12 * 12) * half
        + (9 * 12 * 20 + 2 * 9 * 20 * 20) * quarter;
    // Of sixteen weights of a transposed convolution four meet a pixel.
    let up = (4 * 20 * 16 + 9 * 16 * 16) * half;
    let exchange = 9 * 48 * 16 * half;
    let pixels = (6 * 8 + 2 * 8 * 8) * full;
    // Features three times; one exchange in the second pass and two in the third.
    assert_eq!(cost.per_image, 3 * (down + up) + 3 * exchange + pixels);
    // The depthwise convolution comes before the size is doubled.
    let fused = (32 * 12 + 12 * 12) * half + 25 * 12 * half + 12 * 8 * full;
    assert_eq!(cost.per_stack, fused + (9 * 24 * 8 + 9 * 24 * 3) * full);
}

/// The hand-made networks of Chen et al. 2019 ("Self-calibrating deep photometric stereo networks") have 4.41 and 2.21 million
/// weights. Their three heads have a hidden layer each, of 64 units; ours is one for all.
#[test]
fn published_networks_are_points_of_the_space() {
    let stages = |all: &[[usize; 2]]| -> Vec<Stage> {
        all.iter()
            .map(|&[width, layers]| Stage::plain(width, layers))
            .collect()
    };
    let transposed = |stage: Stage| Stage {
        kind: LayerKind::Transposed4,
        ..stage
    };
    let nenet = StagedNormal {
        down: stages(&[[64, 1], [128, 2], [256, 2]]),
        up: vec![transposed(Stage::plain(128, 2))],
        meeting: Meeting::Max,
        exchanges: 0,
        fused: vec![Stage::plain(128, 2), transposed(Stage::plain(64, 1))],
        pixels: None,
    };
    // Whatever the pictures' size.
    for area in [0, 1024] {
        assert_eq!(
            normal_cost(&normal(nenet.clone()), area).parameters,
            2_210_243
        );
    }
    let mut lcnet = LightArchitecture {
        input_size: 128,
        body: LightBody::Staged(StagedLight {
            features: stages(&[[64, 1], [128, 2], [128, 2], [256, 2]]),
            classifier: stages(&[[256, 1]; 4]),
            hidden: 192,
        }),
        ..LightArchitecture::plain()
    };
    lcnet.bins.intensity.count = 20;
    assert!(lcnet.validate().is_ok());
    let classes = lcnet.bins.classes();
    let shared = 192 * classes - 64 * classes;
    assert_eq!(light_cost(&lcnet).parameters - shared, 4_409_692);
}

/// A stack comes in parts, once for each pass, on every backend; what weights files hold is the same function.
#[test]
#[expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]
fn exchanges_take_images_in_parts() {
    let device = Device::flex();
    let network = build(rich(), &device);
    assert_eq!(network.passes(), 3);
    let input = Tensor::<4>::random([5, 16, 24, 6], Distribution::Default, &device);
    let part = |from: usize, to: usize| input.clone().narrow(0, from, to - from);
    let whole = network.regress(network.fuse(input.clone(), 1));
    let mut kept: Vec<FusedFeatures> = Vec::new();
    for _ in 0..network.passes() {
        let last = network.fuse_after(part(2, 5), 1, &kept);
        kept.push(last.and(network.fuse_after(part(0, 2), 1, &kept)));
    }
    assert!(apart(whole.clone(), network.regress(kept.pop().unwrap())) < 1e-4);
    // Two stacks at once are each by itself.
    let both = Tensor::cat(vec![input.clone(), input.clone() * 0.5], 0);
    let both = network.regress(network.fuse(both, 2));
    assert!(apart(whole.clone(), both.clone().narrow(0, 0, 1)) < 1e-4);
    assert!(apart(whole.clone(), both.narrow(0, 1, 1)) > 1e-3);
    let folded = network.folded();
    assert!(apart(whole.clone(), folded.regress(folded.fuse(input.clone(), 1))) < 1e-4);
    let architecture = normal(rich());
    let bytes = Weights::normal_bytes(&architecture, &network, &BTreeMap::new()).unwrap();
    let weights = Weights::from_bytes("normal.safetensors", &bytes).unwrap();
    let [ours, theirs] = [&device, &Device::ndarray()].map(|device| {
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

/// Normals change only within the reach of a pixel that changed, and do so nearly as far as it says. The reference adds
/// products one by one: fast convolutions change the last bits of the pixels beside.
#[test]
#[expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]
fn the_reach_is_what_normals_depend_on() {
    let device = Device::ndarray();
    for staged in [plain(), rich()] {
        let reach = staged.reach();
        let network = build(staged, &device).folded();
        let side = 8 * (reach / 4 + 3);
        let middle = side / 2;
        let input = Tensor::<4>::random([1, side, side, 6], Distribution::Default, &device);
        let ranges = [0..1, middle..middle + 1, middle..middle + 1, 0..6];
        let pixel = input.clone().slice(ranges.clone()) + 30.0;
        let other = input.clone().slice_assign(ranges, pixel);
        let run = |input: Tensor<4>| network.regress(network.fuse(input, 1));
        let change = (run(input) - run(other)).abs().sum_dim(3);
        let change = change.into_data().try_to_vec::<f32>().unwrap();
        let away = |place: usize| {
            let (x, y) = (place % side, place / side);
            x.abs_diff(middle).max(y.abs_diff(middle))
        };
        let farthest = (0..change.len())
            .filter(|&place| change[place] > 0.0)
            .map(away)
            .max();
        let farthest = farthest.unwrap();
        assert!(
            farthest <= reach && 3 * farthest > 2 * reach,
            "{farthest} {reach}"
        );
    }
}

#[test]
fn recipes_write_stages_in_short() {
    let staged: StagedNormal = serde_json::from_str(
        r#"{"down": [{"width": 16}, {"width": 32, "layers": 2}], "fused": [{"width": 32, "kind": "separable5"}, {"width": 8}]}"#,
    )
    .unwrap();
    assert_eq!(staged.down[1], Stage::plain(32, 2));
    assert_eq!(staged.fused[0].kind, LayerKind::Separable5);
    assert!(normal(staged).validate().is_ok());
    let wrong = r#"{"down": [], "fused": [], "depth": 3}"#;
    assert!(serde_json::from_str::<StagedNormal>(wrong).is_err());
}
