//! Lights as lines of numbers: DiLiGenT, UW and `.lp` files.
use crate::IoError;
use crate::stack::read_text;
use normalight_core::{Light, Vec3};

/// Unit directions (x right, y up, z to the camera) from text: three numbers on each line,
/// optionally a first line with their count, as DiLiGenT's `light_directions.txt` and UW's
/// `lights.txt` have them.
///
/// # Errors
/// [`IoError::LightFormat`] for lines that are not three numbers or vectors without a direction;
/// [`IoError::LightCount`] when the file's own count is wrong.
pub fn parse_directions(name: &str, bytes: &[u8]) -> Result<Vec<Vec3>, IoError> {
    let rows = parse_rows(name, bytes)?;
    rows.iter()
        .map(|row| match row.file {
            None => row.direction(name),
            Some(_) => Err(row.wrong(name, "only the three numbers x y z")),
        })
        .collect()
}

/// Intensities per colour channel from text: three numbers on each line, or one for grey.
///
/// # Errors
/// [`IoError::LightFormat`] for other lines and for values that are not above zero.
pub fn parse_intensities(name: &str, bytes: &[u8]) -> Result<Vec<[f32; 3]>, IoError> {
    let rows = parse_lines(name, bytes)?;
    rows.iter()
        .map(|row| {
            let intensity = match row.numbers[..] {
                _ if row.file.is_some() => return Err(row.wrong(name, "only intensities")),
                [grey] => [grey; 3],
                [r, g, b] => [r, g, b],
                _ => return Err(row.wrong(name, "one or three intensities")),
            };
            check_intensity(intensity).ok_or_else(|| row.wrong(name, "intensities above zero"))
        })
        .collect()
}

/// Lights from directions and intensities of the same images, confidence 1.
///
/// # Errors
/// [`IoError::LightCount`] (naming `intensities_name`) when there are more or fewer intensities
/// than directions.
pub fn combine_lights(
    directions: &[Vec3],
    intensities_name: &str,
    intensities: &[[f32; 3]],
) -> Result<Vec<Light>, IoError> {
    check_count(intensities_name, intensities.len(), directions.len())?;
    Ok(directions
        .iter()
        .zip(intensities)
        .map(|(&direction, &intensity)| Light {
            intensity,
            ..Light::new(direction, 1.0)
        })
        .collect())
}

pub(crate) fn check_count(name: &str, found: usize, expected: usize) -> Result<(), IoError> {
    if found == expected {
        return Ok(());
    }
    Err(IoError::LightCount {
        name: name.to_owned(),
        found,
        expected,
    })
}

pub(crate) fn check_intensity(intensity: [f32; 3]) -> Option<[f32; 3]> {
    let good = |value: &f32| value.is_finite() && *value > 0.0;
    intensity.iter().all(good).then_some(intensity)
}

pub(crate) fn check_direction(vector: Vec3) -> Option<Vec3> {
    // Rejects zero, NaN, infinity and vectors too short to have a direction.
    vector.try_normalize()
}

/// One line of numbers, with the file name that may stand before them.
pub(crate) struct Row {
    pub(crate) file: Option<String>,
    numbers: Vec<f32>,
    line: usize,
    text: String,
}

impl Row {
    pub(crate) fn direction(&self, name: &str) -> Result<Vec3, IoError> {
        let [x, y, z] = self.numbers[..] else {
            return Err(self.wrong(name, "the three numbers x y z"));
        };
        check_direction(Vec3::new(x, y, z))
            .ok_or_else(|| self.wrong(name, "a finite vector that is not zero"))
    }

    fn wrong(&self, name: &str, expected: &str) -> IoError {
        IoError::LightFormat {
            name: name.to_owned(),
            line: self.line,
            found: self.text.chars().take(80).collect(),
            expected: expected.to_owned(),
        }
    }
}

/// The lines of a light file whose first line may be the number of lines after it.
pub(crate) fn parse_rows(name: &str, bytes: &[u8]) -> Result<Vec<Row>, IoError> {
    let mut rows = parse_lines(name, bytes)?;
    let declared = rows
        .first()
        .filter(|row| row.file.is_none() && row.numbers.len() == 1)
        .and_then(|row| row.text.parse::<usize>().ok());
    if let Some(declared) = declared {
        rows.remove(0);
        check_count(name, rows.len(), declared)?;
    }
    Ok(rows)
}

fn parse_lines(name: &str, bytes: &[u8]) -> Result<Vec<Row>, IoError> {
    let text = read_text(name, bytes)?;
    let mut rows = Vec::new();
    for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let words: Vec<&str> = line
            .split(|c: char| c.is_whitespace() || c == ',')
            .filter(|word| !word.is_empty())
            .collect();
        let (file, numbers) = match words.len() {
            0..=3 => (None, parse_numbers(&words)),
            // `name x y z`: the name may hold spaces and commas, but a number is a column too many.
            _ => {
                let mut last = line.rsplitn(4, char::is_whitespace);
                let mut values: Vec<&str> = last.by_ref().take(3).collect();
                values.reverse();
                let file = last.next().map(|file| file.trim().to_owned());
                let is_name = |file: &String| file.parse::<f32>().is_err();
                let named = file.as_ref().is_some_and(is_name);
                (file, parse_numbers(&values).filter(|_| named))
            }
        };
        let row = Row {
            file,
            line: index + 1,
            text: line.to_owned(),
            numbers: Vec::new(),
        };
        let Some(numbers) = numbers else {
            return Err(row.wrong(name, "the three numbers x y z, after a file name or alone"));
        };
        rows.push(Row { numbers, ..row });
    }
    Ok(rows)
}

fn parse_numbers(words: &[&str]) -> Option<Vec<f32>> {
    words.iter().map(|word| word.parse().ok()).collect()
}
