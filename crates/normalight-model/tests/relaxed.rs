//! Relaxed networks against the networks that are derived from them.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use burn::module::{Module, ModuleMapper, Param};
use burn::tensor::{Device, Distribution, Tensor, TensorData};
use normalight_model::{
    Cell, CellNormal, Edge, NormalArchitecture, NormalBody, NormalGenotype, NormalNetwork,
    Operation, SearchSpace, Upsampling, normal_cell_sites, normal_cost, operation_cost,
};

fn architecture(reductions: usize, genotype: NormalGenotype) -> NormalArchitecture {
    NormalArchitecture {
        mask_channel: false,
        body: NormalBody::Cells(CellNormal {
            width: 4,
            stem_strides: [1, 2],
            reductions,
            upsampling: Upsampling::Nearest,
            fused_convolutions: 1,
            genotype: genotype.into(),
        }),
    }
}

/// One node that adds the same operation on both inputs.
fn genotype(operation: Operation) -> NormalGenotype {
    let edge = |from| Edge { operation, from };
    let cell = || Cell {
        nodes: vec![[edge(0), edge(1)]],
    };
    NormalGenotype::from_cells([cell(), cell(), cell()])
}

fn space(operations: &[Operation]) -> SearchSpace {
    SearchSpace {
        operations: operations.to_vec(),
        nodes: 1,
        channel_divisor: 1,
    }
}

/// Sets every row of the architecture's parameters, and every other weight to a number of its place in the network.
struct Setter<'a> {
    path: Vec<String>,
    row: &'a [f32],
}

impl ModuleMapper for Setter<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }
    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }
    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let tensor = param.val();
        let (shape, count) = (tensor.dims(), tensor.shape().num_elements());
        let values: Vec<f32> = if self.path.iter().any(|part| part == "relaxation") {
            self.row.iter().copied().cycle().take(count).collect()
        } else {
            let running = self.path.last().unwrap().starts_with("running");
            let norm = ["gamma", "beta"].contains(&self.path.last().unwrap().as_str());
            if running || norm {
                return param;
            }
            (0..count).map(|k| 0.3 * (1.3 * k as f32).sin()).collect()
        };
        let data = TensorData::new(values, shape);
        Param::initialized(param.id, Tensor::from_data(data, &tensor.device()))
    }
}

fn output(network: &NormalNetwork, device: &Device) -> Vec<f32> {
    let count = 2 * 16 * 16 * 6;
    let values: Vec<f32> = (0..count).map(|k| (0.37 * k as f32).cos()).collect();
    let input = Tensor::<4>::from_data(TensorData::new(values, [2, 16, 16, 6]), device);
    network
        .regress(network.fuse(input, 1))
        .into_data()
        .try_to_vec::<f32>()
        .unwrap()
}

/// With nearly all weight on one operation a relaxed network is the network of that operation.
#[test]
fn one_weight_alone_is_the_derived_network() {
    for device in [Device::flex(), Device::flex().autodiff()] {
        for (column, operation) in Operation::ALL.into_iter().enumerate() {
            if operation == Operation::Zero {
                continue;
            }
            for reductions in [0, 1, 2] {
                let architecture = architecture(reductions, genotype(operation));
                let mut row = [0.0; 6];
                row[column] = 60.0;
                let set = |network: NormalNetwork| {
                    let path = Vec::new();
                    network.map(&mut Setter { path, row: &row })
                };
                let derived = set(NormalNetwork::new(&architecture, false, &device).unwrap());
                let all = space(&Operation::ALL);
                let relaxed = NormalNetwork::relaxed(&architecture, &all, &device).unwrap();
                let relaxed = set(relaxed);
                let weights = relaxed.relaxation().unwrap().weights();
                assert!(weights[0].operations[0][column] > 0.999_999);
                let (expected, found) = (output(&derived, &device), output(&relaxed, &device));
                for (expected, found) in expected.iter().zip(&found) {
                    assert!(
                        (expected - found).abs() < 1e-3,
                        "{operation:?}, {reductions}"
                    );
                }
            }
        }
    }
}

/// Half of an operation and half of none, and an auxiliary skip: worked out from the operation alone.
#[test]
fn weights_and_auxiliary_skip_add_up() {
    let device = Device::flex();
    let two = space(&[Operation::Skip, Operation::Zero]);
    let architecture = architecture(0, genotype(Operation::Skip));
    let set = |network: NormalNetwork, row: &[f32]| {
        let path = Vec::new();
        network.map(&mut Setter { path, row })
    };
    let relaxed = NormalNetwork::relaxed(&architecture, &two, &device).unwrap();
    let mut half = set(relaxed.clone(), &[0.0, 0.0]);
    let whole = set(relaxed, &[60.0, 0.0]);
    let (halved, full) = (output(&half, &device), output(&whole, &device));
    let largest = |a: &[f32], b: &[f32]| {
        let pairs = a.iter().zip(b);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    };
    assert!(largest(&halved, &full) > 1e-3);
    half.relaxation_mut().unwrap().set_auxiliary_skip(0.5);
    assert!(largest(&output(&half, &device), &full) < 1e-5);
}

/// The expected cost of one chosen operation is the closed form's cost of the derived network, the fixed parts left out.
#[test]
fn expected_cost_of_a_choice_is_its_cost() {
    let device = Device::flex().autodiff();
    let all = space(&Operation::ALL);
    for (column, operation) in Operation::ALL.into_iter().enumerate() {
        let architecture = architecture(1, genotype(operation));
        let NormalBody::Cells(cells) = &architecture.body else {
            unreachable!()
        };
        let mut costs = vec![vec![vec![0.0; 6]; 2]; 3];
        for place in normal_cell_sites(cells, 32 * 32).concat() {
            for (from, edge) in costs[place.cell].iter_mut().enumerate() {
                for (cost, &operation) in edge.iter_mut().zip(&all.operations) {
                    *cost += operation_cost(operation, &place, from).parameters as f32;
                }
            }
        }
        let mut row = [0.0; 6];
        row[column] = 60.0;
        let network = NormalNetwork::relaxed(&architecture, &all, &device).unwrap();
        let network = network.map(&mut Setter {
            path: Vec::new(),
            row: &row,
        });
        let relaxation = network.relaxation().unwrap();
        let found = relaxation
            .expected_cost(&costs)
            .into_data()
            .try_to_vec::<f32>()
            .unwrap()[0];
        let parameters = |operation| {
            let NormalBody::Cells(mut cells) = architecture.body.clone() else {
                unreachable!()
            };
            cells.genotype = genotype(operation).into();
            let body = NormalBody::Cells(cells);
            let architecture = NormalArchitecture {
                mask_channel: false,
                body,
            };
            normal_cost(&architecture, 32 * 32).parameters
        };
        let expected = (parameters(operation) - parameters(Operation::Zero)) as f32;
        assert!(
            (found - expected).abs() <= 1e-3 * expected.max(1.0),
            "{operation:?}: {found}, {expected}"
        );
    }
}

/// A quarter of the channels through the operations: sizes fit at every stride, and the others are not touched.
#[test]
fn partial_channels_keep_the_shapes() {
    let device = Device::flex().autodiff();
    let partial = SearchSpace {
        channel_divisor: 4,
        ..SearchSpace::default()
    };
    let architecture = architecture(2, genotype(Operation::Skip));
    let network = NormalNetwork::relaxed(&architecture, &partial, &device).unwrap();
    let input = Tensor::random([2, 16, 16, 6], Distribution::Uniform(0.0, 1.0), &device);
    let features = network.fuse(input, 2).features();
    assert_eq!(features.dims(), [2, 8, 8, 16]);
    let weights = network.relaxation().unwrap().weights();
    for cell in weights {
        let shares: f32 = cell.edges.iter().sum();
        assert!((shares - 4.0).abs() < 1e-5, "each of four nodes has one");
    }
    let wrong = SearchSpace {
        channel_divisor: 3,
        ..SearchSpace::default()
    };
    let error = NormalNetwork::relaxed(&architecture, &wrong, &device).unwrap_err();
    assert!(
        error.to_string().contains("multiple of channel_divisor"),
        "{error}"
    );
}
