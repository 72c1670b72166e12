//! Light files with a heading: our `lights.csv`, also after a spreadsheet, and tables of angles.
use crate::IoError;
use crate::light_file::LightRow;
use crate::light_text::{check_direction, first_running, is_intensity, parse_number, wrong_line};
use csv::{ReaderBuilder, StringRecord, Trim};
use normalight_core::Vec3;

/// What a heading must say, for messages.
pub(crate) const HEADING: &str =
    "the heading file,x,y,z,intensity,confidence (file,azimuth,elevation for angles)";

/// Words for each column, the first is ours.
const FILE: &[&str] = &[
    "file",
    "filename",
    "file name",
    "name",
    "image",
    "img",
    "photo",
];
const X: &[&str] = &["x", "lx", "dx", "light x", "dir x", "direction x"];
const Y: &[&str] = &["y", "ly", "dy", "light y", "dir y", "direction y"];
const Z: &[&str] = &["z", "lz", "dz", "light z", "dir z", "direction z"];
const INTENSITY: &[&str] = &["intensity", "brightness"];
const CONFIDENCE: &[&str] = &["confidence"];
const NUMBER: &[&str] = &[
    "number", "nr", "no", "no.", "idx", "index", "id", "i", "n", "", "light", "lamp",
];
const AZIMUTH: &[&str] = &["azimuth", "azimut", "az", "phi"];
const ELEVATION: &[&str] = &["elevation", "altitude", "elev", "el"];
const ZENITH: &[&str] = &["zenith", "polar", "inclination", "theta"];

/// Where the direction stands.
#[derive(Clone, Copy)]
enum Direction {
    Vector([usize; 3]),
    /// Azimuth, and the angle from the image plane or, when `true`, from the axis.
    Angles(usize, usize, bool),
}

/// The rows of a table.
pub(crate) struct Table {
    pub(crate) rows: Vec<LightRow>,
    /// The first of the running numbers that the rows had.
    pub(crate) numbered_from: Option<usize>,
    /// Whether a column says how bright the lights are.
    pub(crate) intensities: bool,
    /// The unit of the angles, when there were any.
    pub(crate) angles: Option<&'static str>,
}

struct Columns {
    words: Vec<String>,
    direction: Direction,
}

impl Columns {
    /// `None` for a line that is no heading.
    fn of(heading: &StringRecord) -> Option<Self> {
        let words: Vec<String> = heading.iter().map(word).collect();
        let place = |known: &[&str]| column(&words, known);
        let direction = match (place(X), place(Y), place(Z)) {
            (Some(x), Some(y), Some(z)) => Direction::Vector([x, y, z]),
            _ => match (place(AZIMUTH)?, place(ELEVATION), place(ZENITH)) {
                (azimuth, Some(elevation), _) => Direction::Angles(azimuth, elevation, false),
                (azimuth, None, zenith) => Direction::Angles(azimuth, zenith?, true),
            },
        };
        Some(Self { words, direction })
    }

    fn place(&self, known: &[&str]) -> Option<usize> {
        column(&self.words, known)
    }
}

fn column(words: &[String], known: &[&str]) -> Option<usize> {
    words.iter().position(|word| known.contains(&word.as_str()))
}

/// A word of a heading without its unit.
fn word(text: &str) -> String {
    let bare = text.trim_start_matches('#').split(['(', '[']).next();
    let bare = bare.unwrap_or_default().replace('_', " ");
    bare.trim().to_lowercase()
}

/// `None` when the first line is no heading.
pub(crate) fn parse(name: &str, text: &str) -> Option<Result<Table, IoError>> {
    // Spreadsheets say first what parts the columns.
    let hint = text
        .split_once('\n')
        .filter(|(first, _)| first.to_ascii_lowercase().starts_with("sep="));
    let text = hint.map_or(text, |(_, rest)| rest);
    let first = text.lines().find(|line| !line.trim().is_empty())?;
    let delimiter = [b';', b'\t', b',']
        .into_iter()
        .max_by_key(|&mark| first.bytes().filter(|&byte| byte == mark).count())?;
    let mut reader = ReaderBuilder::new()
        .trim(Trim::All)
        .delimiter(delimiter)
        .from_reader(text.as_bytes());
    let columns = Columns::of(reader.headers().ok()?)?;
    let rows: Result<Vec<(usize, StringRecord)>, IoError> = reader
        .into_records()
        .map(|record| {
            record
                .map(|record| (line_of(record.position()), record))
                .map_err(|error| {
                    wrong_line(name, line_of(error.position()), &error.to_string(), HEADING)
                })
        })
        .collect();
    Some(rows.and_then(|rows| table(name, &columns, &rows)))
}

fn line_of(position: Option<&csv::Position>) -> usize {
    position.map_or(0, csv::Position::line) as usize
}

fn table(
    name: &str,
    columns: &Columns,
    records: &[(usize, StringRecord)],
) -> Result<Table, IoError> {
    let number = |line: usize, record: &StringRecord, place: usize| {
        let found = record.get(place).unwrap_or_default();
        parse_number(found).ok_or_else(|| wrong_line(name, line, found, "a number"))
    };
    let radians = match columns.direction {
        Direction::Vector(_) => None,
        Direction::Angles(azimuth, height, _) => {
            let mut largest = [0.0f32; 2];
            for (line, record) in records {
                for (largest, place) in largest.iter_mut().zip([azimuth, height]) {
                    *largest = largest.max(number(*line, record, place)?.abs());
                }
            }
            // Lamps of a dome stand more than a few degrees apart.
            Some(largest[0] <= 6.3 && largest[1] <= 3.2)
        }
    };
    let mut rows = Vec::with_capacity(records.len());
    for (line, record) in records {
        let line = *line;
        let value = |place| number(line, record, place);
        let vector = match columns.direction {
            Direction::Vector([x, y, z]) => Vec3::new(value(x)?, value(y)?, value(z)?),
            Direction::Angles(azimuth, height, from_axis) => {
                let unit = |angle: f32| match radians {
                    Some(true) => f64::from(angle),
                    _ => f64::from(angle).to_radians(),
                };
                let (azimuth, height) = (unit(value(azimuth)?), unit(value(height)?));
                let elevation = match from_axis {
                    true => std::f64::consts::FRAC_PI_2 - height,
                    false => height,
                };
                let flat = elevation.cos();
                let [x, y] = [flat * azimuth.cos(), flat * azimuth.sin()];
                Vec3::new(x as f32, y as f32, elevation.sin() as f32)
            }
        };
        let wrong = |found: f32, expected| wrong_line(name, line, &found.to_string(), expected);
        if check_direction(vector).is_none() {
            let found = vector.to_string();
            return Err(wrong_line(
                name,
                line,
                &found,
                "a finite vector that is not zero",
            ));
        }
        let optional = |known| columns.place(known).map_or(Ok(1.0), value);
        let (intensity, confidence) = (optional(INTENSITY)?, optional(CONFIDENCE)?);
        if !is_intensity(intensity) {
            return Err(wrong(intensity, "an intensity above zero and below 1e30"));
        }
        if !(0.0..=1.0).contains(&confidence) {
            return Err(wrong(confidence, "a confidence in 0..1"));
        }
        let file = columns.place(FILE).or_else(|| columns.place(NUMBER));
        let file = file.and_then(|place| record.get(place));
        rows.push(LightRow {
            file: file.filter(|file| !file.is_empty()).map(str::to_owned),
            vector,
            intensity: [intensity; 3],
            confidence,
        });
    }
    let numbered_from = match columns.place(FILE) {
        None => by_running_number(&mut rows),
        Some(_) => None,
    };
    let angles = radians.map(|radians| if radians { "radians" } else { "degrees" });
    Ok(Table {
        rows,
        numbered_from,
        intensities: columns.place(INTENSITY).is_some(),
        angles,
    })
}

/// Brings rows into the order of their numbers where those run, and takes the numbers away; gives the first.
fn by_running_number(rows: &mut Vec<LightRow>) -> Option<usize> {
    let numbers = rows.iter().map(|row| row.file.as_deref()?.parse().ok());
    let numbers = numbers.collect::<Option<Vec<usize>>>()?;
    let first = first_running(&numbers)?;
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by_key(|&row| numbers[row]);
    *rows = order.into_iter().map(|row| rows[row].clone()).collect();
    rows.iter_mut().for_each(|row| row.file = None);
    Some(first)
}
