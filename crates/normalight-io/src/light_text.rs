//! The lines of light files.
use crate::IoError;
use crate::stack::read_text;
use csv::{Position, ReaderBuilder, Trim};
use normalight_core::{Light, Vec3};
use serde::{Deserialize, Serialize};

/// One line of `lights.csv`.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct CsvRow {
    pub(crate) file: String,
    pub(crate) x: f32,
    pub(crate) y: f32,
    pub(crate) z: f32,
    pub(crate) intensity: f32,
    pub(crate) confidence: f32,
}

/// One line of numbers, with the file name that may stand before them.
pub(crate) struct Row {
    pub(crate) file: Option<String>,
    pub(crate) numbers: Vec<f32>,
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

    pub(crate) fn wrong(&self, name: &str, expected: &str) -> IoError {
        wrong_line(name, self.line, &self.text, expected)
    }
}

/// Lines of `x y z` or `file x y z`, whose first may be the number of lines after it.
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

/// Our own `lights.csv`.
pub(crate) fn parse_csv(name: &str, bytes: &[u8]) -> Result<Vec<(Option<String>, Light)>, IoError> {
    let text = read_text(name, bytes)?;
    let mut reader = ReaderBuilder::new()
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let failed = |position: Option<&Position>, error: &csv::Error| {
        let line = position.map_or(0, Position::line) as usize;
        let expected = "file,x,y,z,intensity,confidence";
        wrong_line(name, line, &error.to_string(), expected)
    };
    let header = reader.headers().map_err(|e| failed(e.position(), &e))?;
    let header = header.clone();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| failed(e.position(), &e))?;
        let row: CsvRow = record
            .deserialize(Some(&header))
            .map_err(|e| failed(record.position(), &e))?;
        let wrong = |found: String, expected| {
            let line = record.position().map_or(0, Position::line) as usize;
            wrong_line(name, line, &found, expected)
        };
        let vector = Vec3::new(row.x, row.y, row.z);
        let direction = check_direction(vector)
            .ok_or_else(|| wrong(vector.to_string(), "a finite vector that is not zero"))?;
        if !is_intensity(row.intensity) {
            return Err(wrong(row.intensity.to_string(), "an intensity above zero"));
        }
        if !(0.0..=1.0).contains(&row.confidence) {
            return Err(wrong(row.confidence.to_string(), "a confidence in 0..1"));
        }
        let light = Light {
            confidence: row.confidence,
            ..Light::new(direction, row.intensity)
        };
        rows.push((Some(row.file), light));
    }
    Ok(rows)
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

pub(crate) fn is_intensity(value: f32) -> bool {
    value.is_finite() && value > 0.0
}

pub(crate) fn check_direction(vector: Vec3) -> Option<Vec3> {
    // In double precision neither tiny nor huge finite vectors lose their direction.
    let unit = vector.as_dvec3().try_normalize()?.as_vec3();
    unit.is_finite().then_some(unit)
}

pub(crate) fn wrong_line(name: &str, line: usize, found: &str, expected: &str) -> IoError {
    IoError::LightFormat {
        name: name.to_owned(),
        line,
        found: found.chars().take(80).collect(),
        expected: expected.to_owned(),
    }
}

/// Lines of numbers, alone or after a file name.
pub(crate) fn parse_lines(name: &str, bytes: &[u8]) -> Result<Vec<Row>, IoError> {
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
            0..=3 => (None, parse_numbers(words)),
            _ => parse_named(line),
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

/// `name x y z`: the name may hold spaces and commas, but a number is a column too many.
fn parse_named(line: &str) -> (Option<String>, Option<Vec<f32>>) {
    let mut rest = line;
    let mut values = Vec::with_capacity(3);
    for _ in 0..3 {
        let Some((before, word)) = rest.rsplit_once(char::is_whitespace) else {
            return (None, None);
        };
        values.insert(0, word);
        rest = before.trim_end();
    }
    if rest.parse::<f32>().is_ok() {
        return (None, None);
    }
    (Some(rest.to_owned()), parse_numbers(values))
}

fn parse_numbers(words: Vec<&str>) -> Option<Vec<f32>> {
    words.into_iter().map(|word| word.parse().ok()).collect()
}
