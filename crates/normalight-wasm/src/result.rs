//! What an estimation hands to JavaScript: numbers to show, and the files of the command line.
use crate::error::Failure;
use crate::file::OutputFile;
use crate::maps::FloatMap;
use crate::mask::MaskOrigin;
use js_sys::Uint8Array;
use normalight_io::{
    ExpectedErrors, InputPlan, Report, StackInput, StageSeconds, TruthErrors, albedo_rgba,
    normals_rgba, result_files,
};
use normalight_model::{Estimate, Quality};
use serde::Serialize;
use tsify::Tsify;

/// A finished run and what it was made from.
pub(crate) struct Run<'a> {
    pub(crate) input: &'a StackInput,
    pub(crate) estimate: &'a Estimate,
    pub(crate) report: Report,
}

/// What an estimation gives.
#[derive(Debug, Serialize, Tsify)]
#[serde(rename_all = "camelCase")]
#[tsify(rename = "Estimate")]
pub struct Estimated {
    /// In pixels.
    width: usize,
    /// In pixels.
    height: usize,
    /// One per image used, in order.
    #[tsify(type = "Light[]")]
    lights: Vec<LightRow>,
    /// Which pixels were taken for the object, and how many.
    mask: MaskReport,
    /// What was decided about the files, and what is doubtful.
    plan: InputPlan,
    /// The same in words, a line each, as the command says them.
    plan_words: Vec<String>,
    /// What computed.
    device: String,
    /// Over how many views it was averaged.
    quality: Quality,
    /// Time of each stage, in the order they ran.
    seconds: Vec<StageSeconds>,
    /// Unit normals: x right, y up, z to the camera; zero outside the object.
    normal_map: FloatMap,
    /// Linear RGB up to one scale; zero outside the object.
    albedo_map: FloatMap,
    /// Expected error of each normal in degrees, one a pixel, zero outside the object; not with quality `fast`.
    #[tsify(optional)]
    normal_errors: Option<FloatMap>,
    /// Mean of the errors that are to be expected, in degrees.
    expected_errors: ExpectedErrors,
    /// How far off the normals are, where a file among the photographs has true ones.
    #[tsify(optional)]
    true_errors: Option<TruthErrors>,
    /// The error of each normal in degrees, one a pixel, there; not a number where nothing is to be compared.
    #[tsify(optional)]
    true_error_map: Option<FloatMap>,
    /// The normals as 8-bit RGBA, transparent outside the object; rows from the top.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    normals: Uint8Array,
    /// The albedo as 8-bit sRGB with alpha; rows from the top.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    albedo: Uint8Array,
    /// Files to keep.
    files: Vec<OutputFile>,
}

/// The light of one photograph: a unit vector from the object to the light, x right, y up, z to the camera.
#[derive(Debug, Serialize, Tsify)]
#[tsify(rename = "Light")]
struct LightRow {
    /// The photograph's file name.
    file: String,
    x: f32,
    y: f32,
    z: f32,
    /// Brightness relative to the mean of the stack.
    intensity: f32,
    /// 0 (no idea) to 1 (certain).
    confidence: f32,
}

/// Which pixels were taken for the object.
#[derive(Debug, Serialize, Tsify)]
struct MaskReport {
    /// Where the mask came from.
    source: MaskOrigin,
    /// The mask's file name, or the source in words.
    words: String,
    /// How many pixels it has.
    pixels: usize,
}

impl Estimated {
    /// Of a finished run.
    ///
    /// # Errors
    /// A map that its file format cannot hold.
    pub(crate) fn new(run: &Run<'_>) -> Result<Self, Failure> {
        let Run {
            input,
            estimate,
            report,
        } = run;
        let (width, height) = (input.stack.width(), input.stack.height());
        let lights = report.inputs.iter().zip(&estimate.lights);
        let normals = normals_rgba(&estimate.normals, report.settings.normal_format);
        let albedo = albedo_rgba(&estimate.albedo, width, height)?;
        Ok(Self {
            width,
            height,
            lights: lights
                .map(|(file, light)| LightRow {
                    file: file.clone(),
                    x: light.direction.x,
                    y: light.direction.y,
                    z: light.direction.z,
                    intensity: light.mean_intensity(),
                    confidence: light.confidence,
                })
                .collect(),
            mask: MaskReport {
                source: MaskOrigin::from(&input.mask_source),
                words: input.mask_label().to_owned(),
                pixels: input.mask.count(),
            },
            plan: input.plan.clone(),
            plan_words: input.plan.lines(true),
            device: report.device.clone(),
            quality: report.settings.quality,
            seconds: report.seconds.clone(),
            normal_map: FloatMap::new(width, height, |pixel| {
                estimate.normals.normals()[pixel].to_array()
            }),
            albedo_map: FloatMap::new(width, height, |pixel| {
                [0, 1, 2].map(|channel| estimate.albedo[channel * width * height + pixel])
            }),
            normal_errors: (estimate.normal_errors.as_ref())
                .map(|errors| FloatMap::new(width, height, |pixel| [errors[pixel]])),
            expected_errors: report.expected_errors,
            true_errors: report.true_errors.clone(),
            true_error_map: input.truth.as_ref().map(|truth| {
                let errors = truth.map(&estimate.normals, &input.mask);
                FloatMap::new(width, height, |pixel| [errors[pixel]])
            }),
            normals: Uint8Array::from(normals.as_slice()),
            albedo: Uint8Array::from(albedo.as_slice()),
            files: result_files(input, estimate, report)?
                .iter()
                .map(|(name, bytes)| OutputFile::new(name, bytes))
                .collect(),
        })
    }
}
