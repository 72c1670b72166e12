use crate::IoError;
use serde::{Deserialize, Serialize};

/// Everything that is needed to tell later how a result came to be: `report.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
    /// How samples were taken: auto, linear or srgb.
    pub color: String,
    /// Where the lights came from, in words.
    pub lights_from: String,
    /// What computed the result.
    pub device: String,
    /// Which weights were used.
    pub weights: WeightHashes,
    /// All settings, as the program names them.
    pub settings: serde_json::Value,
    /// Time of each stage, in the order they ran.
    pub seconds: Vec<StageSeconds>,
}

/// Hashes of the weights files, `None` for a network that was not used.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct WeightHashes {
    /// The light network.
    pub light: Option<String>,
    /// The normal network.
    pub normal: Option<String>,
}

/// How long one stage took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StageSeconds {
    /// Name of the stage.
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
