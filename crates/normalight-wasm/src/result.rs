//! What an estimation hands to JavaScript: numbers to show, and the files of the command line.
use crate::error::Failure;
use crate::file::OutputFile;
use crate::settings::Settings;
use js_sys::Uint8Array;
use normalight_core::MaskSource;
use normalight_io::{
    ColorMode, Report, StackInput, StageSeconds, WeightHashes, albedo_png, albedo_rgba, lights_csv,
    lights_lp, lights_svg, mask_png, normals_npy, normals_png, normals_rgba, report_json,
};
use normalight_model::{Estimate, Quality};
use serde::Serialize;
use serde_json::json;
use wasm_bindgen::JsValue;

/// A finished run and what it was made from.
pub(crate) struct Run<'a> {
    pub(crate) input: &'a StackInput,
    pub(crate) estimate: &'a Estimate,
    pub(crate) settings: &'a Settings,
    pub(crate) lights_file: Option<&'a str>,
    pub(crate) weights: [&'a str; 2],
    pub(crate) device: &'a str,
    pub(crate) seconds: Vec<StageSeconds>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Estimated<'a> {
    width: usize,
    height: usize,
    lights: Vec<LightRow<'a>>,
    mask: Mask<'a>,
    device: &'a str,
    quality: Quality,
    seconds: &'a [StageSeconds],
    #[serde(with = "serde_wasm_bindgen::preserve")]
    normals: Uint8Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    albedo: Uint8Array,
    files: Vec<OutputFile>,
}

#[derive(Serialize)]
struct LightRow<'a> {
    file: &'a str,
    x: f32,
    y: f32,
    z: f32,
    intensity: f32,
    confidence: f32,
}

#[derive(Serialize)]
struct Mask<'a> {
    source: &'static str,
    words: &'a str,
    pixels: usize,
}

pub(crate) fn result(run: &Run<'_>) -> Result<JsValue, Failure> {
    let (input, estimate) = (run.input, run.estimate);
    let (width, height) = (input.stack.width(), input.stack.height());
    let names = input.picked_names();
    let lights = names.iter().zip(&estimate.lights);
    let normals = normals_rgba(&estimate.normals, run.settings.normal_format.into());
    let albedo = albedo_rgba(&estimate.albedo, width, height)?;
    Ok(serde_wasm_bindgen::to_value(&Estimated {
        width,
        height,
        lights: lights
            .map(|(file, light)| LightRow {
                file,
                x: light.direction.x,
                y: light.direction.y,
                z: light.direction.z,
                intensity: light.mean_intensity(),
                confidence: light.confidence,
            })
            .collect(),
        mask: Mask {
            source: source_word(&input.mask_source),
            words: input.mask_label(),
            pixels: input.mask.count(),
        },
        device: run.device,
        quality: run.settings.quality,
        seconds: &run.seconds,
        normals: Uint8Array::from(normals.as_slice()),
        albedo: Uint8Array::from(albedo.as_slice()),
        files: files(run, &names)?,
    })?)
}

fn source_word(source: &MaskSource) -> &'static str {
    match source {
        MaskSource::File(_) => "file",
        MaskSource::Alpha => "alpha",
        MaskSource::Guessed => "guessed",
        MaskSource::WholeFrame => "none",
    }
}

/// The files that the command line writes.
fn files(run: &Run<'_>, names: &[String]) -> Result<Vec<OutputFile>, Failure> {
    let Estimate {
        lights,
        normals,
        albedo,
    } = run.estimate;
    let (width, height) = (normals.width(), normals.height());
    let format = run.settings.normal_format.into();
    Ok(vec![
        OutputFile::new("normals.png", &normals_png(normals, format)?),
        OutputFile::new("normals.npy", &normals_npy(normals)?),
        OutputFile::new("lights.csv", &lights_csv(names, lights)?),
        OutputFile::new("lights.lp", &lights_lp(names, lights)?),
        OutputFile::new("lights.svg", &lights_svg(lights)),
        OutputFile::new("albedo.png", &albedo_png(albedo, width, height)?),
        OutputFile::new("mask.png", &mask_png(&run.input.mask)?),
        OutputFile::new("report.json", &report(run, names)?),
    ])
}

fn report(run: &Run<'_>, names: &[String]) -> Result<Vec<u8>, Failure> {
    let [light, normal] = run.weights.map(str::to_owned);
    Ok(report_json(&Report {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        inputs: names.to_vec(),
        width: run.input.stack.width(),
        height: run.input.stack.height(),
        mask: run.input.mask_label().to_owned(),
        color: ColorMode::from(run.settings.color).to_string(),
        lights_from: lights_in_words(run).to_owned(),
        device: run.device.to_owned(),
        weights: WeightHashes {
            light: run.lights_file.is_none().then_some(light),
            normal: Some(normal),
        },
        // Named as on the command line.
        settings: json!({
            "mask": run.settings.mask,
            "lights": run.lights_file,
            "images": run.settings.images,
            "normal_format": run.settings.normal_format,
            "color": run.settings.color,
            "refit": run.settings.refit,
            "quality": run.settings.quality,
        }),
        seconds: run.seconds.clone(),
    })?)
}

fn lights_in_words<'a>(run: &Run<'a>) -> &'a str {
    match run.lights_file {
        Some(name) => name,
        None if run.settings.refit => "estimated by the light network, refitted to the normals",
        None => "estimated by the light network",
    }
}
