use crate::{ColorMode, InputPlan, IoError, NormalFormat, TruthErrors};
use normalight_core::{Decoding, Estimate, Light, Mask, Quality, expected_light_error};
use serde::{Deserialize, Serialize};

/// Everything that is needed to tell later how a result came to be: `report.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct Report {
    /// Version of the program.
    pub version: String,
    /// File names of the images used, in order.
    pub inputs: Vec<String>,
    /// Width of the images in pixels.
    pub width: usize,
    /// Height of the images in pixels.
    pub height: usize,
    /// Where the mask came from, in words.
    pub mask: String,
    /// How samples were taken.
    pub color: ColorMode,
    /// What was decided about the files, and what is doubtful.
    pub plan: InputPlan,
    /// Where the lights came from, in words.
    pub lights_from: String,
    /// How far off the result may be.
    #[serde(default)]
    pub expected_errors: ExpectedErrors,
    /// How far off the normals are, where true ones lie beside the photographs.
    #[serde(default)]
    pub true_errors: Option<TruthErrors>,
    /// What computed the result.
    pub device: String,
    /// Which weights were used.
    pub weights: WeightHashes,
    /// What was asked for.
    pub settings: ReportSettings,
    /// Time of each stage, in the order they ran.
    pub seconds: Vec<StageSeconds>,
}

/// Mean errors in degrees that rendered objects had where the program was as much in doubt; `None` where nothing is known of
/// them: lights that were given, normals of a single view.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct ExpectedErrors {
    /// Of the lights' directions.
    #[cfg_attr(feature = "typescript", tsify(type = "number | null | undefined"))]
    pub lights: Option<f32>,
    /// Of the normals.
    #[cfg_attr(feature = "typescript", tsify(type = "number | null | undefined"))]
    pub normals: Option<f32>,
}

impl ExpectedErrors {
    /// Of an estimate.
    pub fn of(estimate: &Estimate, mask: &Mask, lights_given: bool) -> Self {
        let lights = &estimate.lights;
        let light = |light: &Light| expected_light_error(light.confidence);
        let normals = estimate.normal_errors.as_ref().filter(|_| mask.count() > 0);
        Self {
            lights: (!lights_given && !lights.is_empty())
                .then(|| lights.iter().map(light).sum::<f32>() / lights.len() as f32),
            normals: normals.map(|errors| {
                let sum: f64 = errors.iter().map(|&error| f64::from(error)).sum();
                (sum / mask.count() as f64) as f32
            }),
        }
    }
}

/// What was asked for, in the words of the command line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify), tsify(missing_as_null))]
pub struct ReportSettings {
    /// The device: `auto`, `cpu`, ...
    pub device: String,
    /// Over how many views to average.
    pub quality: Quality,
    /// How light classes become numbers.
    pub decoding: Decoding,
    /// Whether lights are refitted to the normals: never those that were given.
    pub refit: bool,
    /// `auto`, `none` (the whole frame) or the mask's file.
    pub mask: String,
    /// The file of lights that were given.
    pub lights: Option<String>,
    /// Most photographs to use.
    pub images: Option<usize>,
    /// Which way green points in `normals.png`.
    pub normal_format: NormalFormat,
    /// How samples relate to light.
    pub color: ColorMode,
}

/// Where the lights came from, in words: the file that they were `given` in, or an estimation.
pub(crate) fn lights_label(given: Option<&str>, refit: bool) -> String {
    match given {
        Some(file) => file.to_owned(),
        None if refit => "estimated by the light network, refitted to the normals".to_owned(),
        None => "estimated by the light network".to_owned(),
    }
}

/// Hashes of the weights files, `None` for a network that was not used.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify), tsify(missing_as_null))]
pub struct WeightHashes {
    /// The light network.
    pub light: Option<String>,
    /// The normal network.
    pub normal: Option<String>,
}

impl WeightHashes {
    /// Of the light and the normal weights; given lights need no light network.
    pub fn new([light, normal]: [&str; 2], lights_given: bool) -> Self {
        Self {
            light: (!lights_given).then(|| light.to_owned()),
            normal: Some(normal.to_owned()),
        }
    }
}

/// How long one stage took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct StageSeconds {
    /// Name of the stage.
    #[cfg_attr(feature = "typescript", tsify(type = "Stage"))]
    pub stage: String,
    /// Wall time in seconds.
    pub seconds: f64,
}

/// `report.json`: readable, ending with a line break.
///
/// # Errors
/// [`IoError::Encode`] when the settings cannot be JSON.
pub fn report_json(report: &Report) -> Result<Vec<u8>, IoError> {
    let mut bytes = serde_json::to_vec_pretty(report).map_err(|error| IoError::Encode {
        name: "report.json",
        reason: error.to_string(),
    })?;
    bytes.push(b'\n');
    Ok(bytes)
}
