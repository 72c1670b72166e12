//! The files that an estimation leaves, the same from every program.
use crate::report::{ExpectedErrors, ReportSettings, lights_label};
use crate::{
    IoError, NormalFormat, ReadOptions, Report, StackInput, StageSeconds, WeightHashes, albedo_png,
    lights_csv, lights_lp, lights_svg, mask_png, normal_errors_png, normals_npy, normals_png,
    report_json,
};
use normalight_core::{Estimate, EstimateSettings};
use serde::{Deserialize, Serialize};

/// Names of the files that an estimation leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub enum OutputName {
    /// The normal map, 16 bits.
    #[serde(rename = "normals.png")]
    NormalsPng,
    /// The normals as numbers.
    #[serde(rename = "normals.npy")]
    NormalsNpy,
    /// The lights as a table.
    #[serde(rename = "lights.csv")]
    LightsCsv,
    /// The lights for relighting programs.
    #[serde(rename = "lights.lp")]
    LightsLp,
    /// The map of the lights.
    #[serde(rename = "lights.svg")]
    LightsSvg,
    /// Colour without shading.
    #[serde(rename = "albedo.png")]
    AlbedoPng,
    /// The pixels that were taken for the object.
    #[serde(rename = "mask.png")]
    MaskPng,
    /// How far off each normal may be.
    #[serde(rename = "normals-error.png")]
    NormalsErrorPng,
    /// How far off each normal is, where true ones are known.
    #[serde(rename = "normals-true-error.png")]
    NormalsTrueErrorPng,
    /// How the result came to be: a [`Report`].
    #[serde(rename = "report.json")]
    ReportJson,
}

/// How an estimate came to be.
#[derive(Debug, Clone)]
pub struct RunDescription<'a> {
    /// How the photographs were read.
    pub reading: &'a ReadOptions,
    /// How lights and normals were estimated.
    pub settings: EstimateSettings,
    /// The file of lights that were given.
    pub lights_file: Option<&'a str>,
    /// The device that was asked for, and the name of the one that computed.
    pub device: [&'a str; 2],
    /// SHA-256 of the light and the normal weights, in hexadecimal.
    pub weights: [&'a str; 2],
    /// Which way green points in `normals.png`.
    pub normal_format: NormalFormat,
    /// Time of each stage, in the order they ran.
    pub seconds: Vec<StageSeconds>,
}

impl RunDescription<'_> {
    /// What `report.json` says about the run.
    pub fn report(&self, input: &StackInput, estimate: &Estimate) -> Report {
        let [asked, used] = self.device.map(str::to_owned);
        let given = self.lights_file;
        let refit = self.settings.refit_of(given.is_some()).is_some();
        Report {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            inputs: input.picked_names(),
            width: input.stack.width(),
            height: input.stack.height(),
            mask: input.mask_label().to_owned(),
            color: self.reading.color,
            plan: input.plan.clone(),
            lights_from: lights_label(given, refit),
            expected_errors: ExpectedErrors::of(estimate, &input.mask, given.is_some()),
            true_errors: (input.truth.as_ref())
                .and_then(|truth| truth.errors(estimate, &input.mask)),
            device: used,
            weights: WeightHashes::new(self.weights, given.is_some()),
            settings: ReportSettings {
                device: asked,
                quality: self.settings.quality,
                decoding: self.settings.decoding,
                refit,
                mask: self.reading.mask.label().to_owned(),
                lights: given.map(str::to_owned),
                images: self.reading.images,
                normal_format: self.normal_format,
                color: self.reading.color,
            },
            seconds: self.seconds.clone(),
        }
    }
}

/// Name (one of [`OutputName`]) and content of every file, the report last: where it is, the others are complete.
///
/// # Errors
/// [`IoError::Encode`].
pub fn result_files(
    input: &StackInput,
    estimate: &Estimate,
    report: &Report,
) -> Result<Vec<(&'static str, Vec<u8>)>, IoError> {
    let Estimate {
        lights,
        normals,
        normal_errors,
        albedo,
    } = estimate;
    let names = &report.inputs;
    let (width, height) = (input.stack.width(), input.stack.height());
    let mut files = vec![
        (
            "normals.png",
            normals_png(normals, report.settings.normal_format)?,
        ),
        ("normals.npy", normals_npy(normals)?),
        ("lights.csv", lights_csv(names, lights)?),
        ("lights.lp", lights_lp(names, lights)?),
        ("lights.svg", lights_svg(lights)),
        ("albedo.png", albedo_png(albedo, width, height)?),
        ("mask.png", mask_png(&input.mask)?),
    ];
    if let Some(errors) = normal_errors {
        files.push(("normals-error.png", normal_errors_png(errors, &input.mask)?));
    }
    if let Some(truth) = &input.truth {
        let errors = truth.map(normals, &input.mask);
        let map = normal_errors_png(&errors, &input.mask)?;
        files.push(("normals-true-error.png", map));
    }
    files.push(("report.json", report_json(report)?));
    Ok(files)
}
