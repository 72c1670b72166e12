//! The files that an estimation leaves, the same from every program.
use crate::report::{ReportSettings, lights_label};
use crate::{
    IoError, NormalFormat, ReadOptions, Report, StackInput, StageSeconds, WeightHashes, albedo_png,
    lights_csv, lights_lp, lights_svg, mask_png, normals_npy, normals_png, report_json,
};
use normalight_core::{Estimate, EstimateSettings};

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
    pub fn report(&self, input: &StackInput) -> Report {
        let [asked, used] = self.device.map(str::to_owned);
        let [light, normal] = self.weights.map(str::to_owned);
        let given = self.lights_file;
        // Lights that were given are never refitted.
        let refit = self.settings.refit.is_some() && given.is_none();
        Report {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            inputs: input.picked_names(),
            width: input.stack.width(),
            height: input.stack.height(),
            mask: input.mask_label().to_owned(),
            color: self.reading.color,
            plan: input.plan.clone(),
            lights_from: lights_label(given, refit),
            device: used,
            weights: WeightHashes {
                light: given.is_none().then_some(light),
                normal: Some(normal),
            },
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

/// Name and content of every file, the report last: where it is, the others are complete.
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
        albedo,
    } = estimate;
    let names = &report.inputs;
    let (width, height) = (input.stack.width(), input.stack.height());
    Ok(vec![
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
        ("report.json", report_json(report)?),
    ])
}
