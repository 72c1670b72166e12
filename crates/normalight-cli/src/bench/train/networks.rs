//! The networks that are timed.
use crate::bench::median_seconds;
use anyhow::{Context, Result};
use burn::tensor::{Device, Distribution, Tensor};
use normalight_model::{
    CellNormal, NormalArchitecture, NormalBody, NormalNetwork, PlainNormal, Upsampling,
    normal_cost, paper_genotypes,
};
use normalight_run::{OptimiserKind, OptimiserRecipe};
use normalight_train::{OptimiserStep, SampleSource, TrainRecipe};
use serde::Serialize;
use std::time::{Duration, Instant};

/// A training step: 16 samples of ten crops of 32x32.
const BATCH: usize = 16;
const IMAGES: usize = 10;
const SIDE: usize = 32;

/// Times of one network on some threads; milliseconds are those of a sample.
#[derive(Debug, Serialize)]
pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) threads: usize,
    /// Forward and backward alone.
    pub(super) ms_per_sample: f64,
    pub(super) forward_ms: f64,
    pub(super) backward_ms: f64,
    /// A step of Adam.
    pub(super) adam_ms: f64,
    /// A step of Muon.
    pub(super) muon_ms: f64,
    /// One thread's time for drawing and preparing samples; in training other threads do it.
    pub(super) data_ms: f64,
    pub(super) samples_per_second: f64,
    pub(super) parameters: usize,
    /// Six operations for each multiply-add of the plain definition: forward and both gradients.
    pub(super) gflops: f64,
    /// Of the speed of a large matrix product.
    pub(super) share_of_matmul: f64,
}

pub(super) struct Candidate {
    pub(super) name: &'static str,
    architecture: NormalArchitecture,
}

/// The networks.
pub(super) fn all() -> Result<Vec<Candidate>> {
    let genotype = paper_genotypes()
        .normal
        .context("no published normal cells")?;
    let plain = |widths, pixel_branch| {
        NormalBody::Plain(PlainNormal {
            pixel_branch,
            ..PlainNormal::new(widths, 32)
        })
    };
    let cells = |width| {
        NormalBody::Cells(CellNormal {
            width,
            stem_strides: [1, 2],
            reductions: 2,
            upsampling: Upsampling::Nearest,
            fused_convolutions: 1,
            genotype: genotype.clone().into(),
        })
    };
    let candidate = |name, body| Candidate {
        name,
        architecture: NormalArchitecture {
            mask_channel: false,
            body,
        },
    };
    Ok(vec![
        candidate("plain-127k", plain([16, 32, 64], 0)),
        candidate("plain-483k", plain([32, 64, 128], 0)),
        candidate("pixels-157k", plain([16, 32, 64], 32)),
        candidate("paper-c8", cells(8)),
        candidate("paper-c16", cells(16)),
    ])
}

/// Milliseconds of one thread for drawing and preparing a sample.
pub(super) fn data_ms() -> Result<f64> {
    let text = format!(
        "network = \"normal\"\nsteps = 1000\nsize = {SIDE}\nbatch = {BATCH}\nimages = [{IMAGES}, {IMAGES}]\n"
    );
    let mut source = SampleSource::new(&TrainRecipe::parse("bench", &text)?)?;
    let start = Instant::now();
    let samples = source.group()?;
    Ok(1e3 * start.elapsed().as_secs_f64() / samples as f64)
}

/// What holds for all networks that are measured together.
pub(super) struct Conditions {
    pub(super) threads: usize,
    /// GFLOP/s of Burn's matrix product.
    pub(super) matmul: f64,
    /// Time for each case, at least.
    pub(super) least: Duration,
    /// Milliseconds of one thread for a sample.
    pub(super) data_ms: f64,
}

impl Candidate {
    pub(super) fn measure(&self, device: &Device, conditions: &Conditions) -> Result<Case> {
        let &Conditions {
            threads,
            matmul,
            least,
            data_ms,
        } = conditions;
        let device = device.clone().autodiff();
        let network = NormalNetwork::new(&self.architecture, false, &device)?;
        let channels = self.architecture.input_channels();
        let random = |shape| Tensor::<4>::random(shape, Distribution::Default, &device);
        let input = random([BATCH * IMAGES, SIDE, SIDE, channels]);
        let truth = random([BATCH, SIDE, SIDE, 3]);
        let optimiser = |kind| {
            OptimiserStep::new(OptimiserRecipe {
                kind,
                ..OptimiserRecipe::default()
            })
        };
        let (mut adam, mut muon) = (
            optimiser(OptimiserKind::Adam),
            optimiser(OptimiserKind::Muon),
        );
        let mut network = Some(network);
        let [both, forward, backward, of_adam, of_muon] = median_seconds(least, || {
            let trained = network.take().expect("every repetition leaves a network");

            let start = Instant::now();
            let normals = trained.regress(trained.fuse(input.clone(), BATCH));
            let loss = (normals * truth.clone()).mean();
            let forward = start.elapsed();
            let gradients = loss.backward();
            let both = start.elapsed();
            drop(adam.take(trained.clone(), &gradients));
            let after_adam = start.elapsed();
            network = Some(muon.take(trained, &gradients));
            let after_muon = start.elapsed();
            [
                both,
                forward,
                both - forward,
                after_adam - both,
                after_muon - after_adam,
            ]
        });
        let cost = normal_cost(&self.architecture, SIDE * SIDE);
        let per_sample = |seconds: f64| 1e3 * seconds / BATCH as f64;
        let gflops = 6e-9 * cost.multiply_adds(IMAGES) as f64 * BATCH as f64 / both;
        Ok(Case {
            name: self.name,
            threads,
            ms_per_sample: per_sample(both),
            forward_ms: per_sample(forward),
            backward_ms: per_sample(backward),
            adam_ms: per_sample(of_adam),
            muon_ms: per_sample(of_muon),
            data_ms,
            samples_per_second: BATCH as f64 / both,
            parameters: cost.parameters,
            gflops,
            share_of_matmul: gflops / matmul,
        })
    }
}
