//! What an estimation hands to JavaScript: numbers to show, and the files of the command line.
use crate::error::Failure;
use crate::file::OutputFile;
use js_sys::{Float32Array, Uint8Array};
use normalight_core::MaskSource;
use normalight_io::{Report, StackInput, StageSeconds, albedo_rgba, normals_rgba, result_files};
use normalight_model::{Estimate, Quality};
use serde::Serialize;
use wasm_bindgen::JsValue;

/// A finished run and what it was made from.
pub(crate) struct Run<'a> {
    pub(crate) input: &'a StackInput,
    pub(crate) estimate: &'a Estimate,
    pub(crate) report: Report,
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
    normal_map: FloatMap,
    albedo_map: FloatMap,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    normals: Uint8Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    albedo: Uint8Array,
    files: Vec<OutputFile>,
}

/// Numbers with their shape.
#[derive(Serialize)]
struct FloatMap {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    data: Float32Array,
    shape: [usize; 3],
}

impl FloatMap {
    /// Three numbers a pixel, from the pixel's place.
    fn new(width: usize, height: usize, pixel: impl Fn(usize) -> [f32; 3]) -> Self {
        let values: Vec<[f32; 3]> = (0..width * height).map(pixel).collect();
        Self {
            data: Float32Array::from(values.as_flattened()),
            shape: [height, width, 3],
        }
    }
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
    let Run {
        input,
        estimate,
        report,
    } = run;
    let (width, height) = (input.stack.width(), input.stack.height());
    let lights = report.inputs.iter().zip(&estimate.lights);
    let normals = normals_rgba(&estimate.normals, report.settings.normal_format);
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
        device: &report.device,
        quality: report.settings.quality,
        seconds: &report.seconds,
        normal_map: FloatMap::new(width, height, |pixel| {
            estimate.normals.normals()[pixel].to_array()
        }),
        albedo_map: FloatMap::new(width, height, |pixel| {
            [0, 1, 2].map(|channel| estimate.albedo[channel * width * height + pixel])
        }),
        normals: Uint8Array::from(normals.as_slice()),
        albedo: Uint8Array::from(albedo.as_slice()),
        files: result_files(input, estimate, report)?
            .iter()
            .map(|(name, bytes)| OutputFile::new(name, bytes))
            .collect(),
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
