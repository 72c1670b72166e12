//! Lights as files for other programs.
use crate::IoError;
use crate::light_text::{check_count, parse_number};
use normalight_core::{Light, Vec3};
use serde::Serialize;

/// One line of `lights.csv`.
#[derive(Serialize)]
struct CsvRow<'a> {
    file: &'a str,
    x: f32,
    y: f32,
    z: f32,
    intensity: f32,
    confidence: f32,
}

/// `lights.csv`: a line `file,x,y,z,intensity,confidence` for each image; intensity is the mean of
/// the channels. [`read_lights`](crate::read_lights) reads it again.
///
/// # Errors
/// [`IoError::LightCount`] when there are more or fewer names than lights.
pub fn lights_csv(file_names: &[String], lights: &[Light]) -> Result<Vec<u8>, IoError> {
    check_count("lights.csv", lights.len(), file_names.len())?;
    let failed = |error: String| IoError::Encode {
        name: "lights.csv",
        reason: error,
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    for (file, light) in file_names.iter().zip(lights) {
        writer
            .serialize(CsvRow {
                file,
                x: light.direction.x,
                y: light.direction.y,
                z: light.direction.z,
                intensity: light.mean_intensity(),
                confidence: light.confidence,
            })
            .map_err(|error| failed(error.to_string()))?;
    }
    writer
        .into_inner()
        .map_err(|error| failed(error.to_string()))
}

/// `lights.lp`, which other relighting programs read: the count, then `name x y z` on each line.
///
/// # Errors
/// [`IoError::LightCount`] when there are more or fewer names than lights.
pub fn lights_lp(file_names: &[String], lights: &[Light]) -> Result<Vec<u8>, IoError> {
    check_count("lights.lp", lights.len(), file_names.len())?;
    let mut text = format!("{}\n", lights.len());
    for (file, light) in file_names.iter().zip(lights) {
        let Vec3 { x, y, z } = light.direction;
        // A line break in a name would start a new light.
        let mut file = file.replace(['\n', '\r'], " ");
        // A name of numbers alone would be taken for some, and one that begins like a comment for one.
        let numbers = file
            .split_whitespace()
            .all(|word| parse_number(word).is_some());
        if numbers || file.starts_with(['#', '%']) {
            file = format!("\"{file}\"");
        }
        text.push_str(&format!("{file} {x:.6} {y:.6} {z:.6}\n"));
    }
    Ok(text.into_bytes())
}
