//! Reading lights of any kind, and writing ours.
use crate::IoError;
use crate::format::{base_name, split_extension};
use crate::light_text::{check_count, check_direction, check_intensity, parse_rows};
use normalight_core::{Light, Vec3};
use serde::{Deserialize, Serialize};

/// One line of `lights.csv`.
#[derive(Debug, Serialize, Deserialize)]
struct CsvRow {
    file: String,
    x: f32,
    y: f32,
    z: f32,
    intensity: f32,
    confidence: f32,
}

/// Reads one light for each image: our `lights.csv`, an `.lp` file (count, then `name x y z`), or
/// lines of `x y z` with or without a count before them.
///
/// Lines with file names are matched with `file_names` (folders do not count) and may cover more
/// images than were read. When no name matches, and in files without names, the order counts and the
/// number of lines must be `expected_count`. Files without intensities give intensity 1.
///
/// # Errors
/// [`IoError::LightCount`] or [`IoError::LightFormat`].
pub fn read_lights(
    name: &str,
    bytes: &[u8],
    expected_count: usize,
    file_names: &[String],
) -> Result<Vec<Light>, IoError> {
    let rows = if split_extension(name).1.eq_ignore_ascii_case("csv") {
        read_csv(name, bytes)?
    } else {
        parse_rows(name, bytes)?
            .into_iter()
            .map(|row| Ok((row.direction(name).map(|d| Light::new(d, 1.0))?, row.file)))
            .map(|row| row.map(|(light, file)| (file, light)))
            .collect::<Result<_, IoError>>()?
    };
    in_order(name, rows, expected_count, file_names)
}

fn in_order(
    name: &str,
    rows: Vec<(Option<String>, Light)>,
    expected_count: usize,
    file_names: &[String],
) -> Result<Vec<Light>, IoError> {
    let light_of = |file: &String| {
        rows.iter().find_map(|(row_file, light)| {
            let row_file = row_file.as_deref()?;
            (base_name(row_file) == base_name(file)).then_some(*light)
        })
    };
    let matched: Vec<Option<Light>> = file_names.iter().map(light_of).collect();
    if matched.iter().all(Option::is_none) {
        check_count(name, rows.len(), expected_count)?;
        return Ok(rows.into_iter().map(|(_, light)| light).collect());
    }
    check_count(name, matched.len(), expected_count)?;
    matched
        .into_iter()
        .zip(file_names)
        .map(|(light, file)| {
            light.ok_or_else(|| IoError::LightFormat {
                name: name.to_owned(),
                line: 0,
                found: format!("{} other names", rows.len()),
                expected: format!("a line for {file}"),
            })
        })
        .collect()
}

fn read_csv(name: &str, bytes: &[u8]) -> Result<Vec<(Option<String>, Light)>, IoError> {
    let wrong = |line: u64, found: String, expected: &str| IoError::LightFormat {
        name: name.to_owned(),
        line: line as usize,
        found,
        expected: expected.to_owned(),
    };
    let mut rows = Vec::new();
    for row in csv::Reader::from_reader(bytes).deserialize() {
        let row: CsvRow = row.map_err(|error| {
            let line = error.position().map_or(0, csv::Position::line);
            wrong(line, error.to_string(), "file,x,y,z,intensity,confidence")
        })?;
        let line = rows.len() as u64 + 2;
        let vector = Vec3::new(row.x, row.y, row.z);
        let direction = check_direction(vector)
            .ok_or_else(|| wrong(line, vector.to_string(), "a finite vector that is not zero"))?;
        check_intensity([row.intensity; 3])
            .ok_or_else(|| wrong(line, row.intensity.to_string(), "an intensity above zero"))?;
        if !(0.0..=1.0).contains(&row.confidence) {
            return Err(wrong(
                line,
                row.confidence.to_string(),
                "a confidence in 0..1",
            ));
        }
        let light = Light {
            confidence: row.confidence,
            ..Light::new(direction, row.intensity)
        };
        rows.push((Some(row.file), light));
    }
    Ok(rows)
}

/// `lights.csv`: a line `file,x,y,z,intensity,confidence` for each image; intensity is the mean of
/// the channels. [`read_lights`] reads it again.
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
                file: file.clone(),
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
        let file = file.replace(['\n', '\r'], " ");
        text.push_str(&format!("{file} {x:.6} {y:.6} {z:.6}\n"));
    }
    Ok(text.into_bytes())
}
