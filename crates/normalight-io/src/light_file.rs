//! Light files of any kind.
use crate::format::split_extension;
use crate::light_axes::LightAxes;
use crate::light_text::{check_count, check_direction, is_intensity, parse_rows, wrong_line};
use crate::text::read_text;
use crate::{IoError, NameMatch, Notice, light_array, light_table};
use normalight_core::{Light, Vec3};

/// One light as it stands in its file.
#[derive(Debug, Clone)]
pub(crate) struct LightRow {
    pub(crate) file: Option<String>,
    /// Not zero, not yet of unit length, in the file's axes.
    pub(crate) vector: Vec3,
    /// 1 where the file says nothing.
    pub(crate) intensity: [f32; 3],
    pub(crate) confidence: f32,
}

/// The lights of a file, with the image names that stand beside them.
#[derive(Debug)]
pub(crate) struct LightFile {
    pub(crate) name: String,
    pub(crate) rows: Vec<LightRow>,
    /// The first of the running numbers that the rows had beside them.
    pub(crate) numbered_from: Option<usize>,
    pub(crate) axes: LightAxes,
    /// The file that says how bright the lights are: this one or one beside it.
    pub(crate) intensities: Option<String>,
    pub(crate) notices: Vec<Notice>,
}

/// Lights that were given, one for each photograph, and how they were found.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenLights {
    /// One light for each photograph.
    pub lights: Vec<Light>,
    /// The least sure rule by which a light was matched with its photograph.
    pub matched: NameMatch,
    /// The axes that the file was taken to have.
    pub axes: LightAxes,
    /// The file that says how bright the lights are; `None` for directions alone.
    pub intensities: Option<String>,
    /// What is doubtful about them.
    pub notices: Vec<Notice>,
}

/// Whether bytes are no text in any of the encodings that are read.
fn is_binary(bytes: &[u8]) -> bool {
    let wide = bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]);
    !wide && bytes.contains(&0)
}

impl LightFile {
    pub(crate) fn parse(name: &str, bytes: &[u8]) -> Result<Self, IoError> {
        let mut file = Self {
            name: name.to_owned(),
            rows: Vec::new(),
            numbered_from: None,
            axes: LightAxes::default(),
            intensities: None,
            notices: Vec::new(),
        };
        if let Some(rows) = light_array::parse(name, bytes) {
            file.rows = rows?;
            return Ok(file);
        }
        if let Some(table) = light_table::parse(name, &read_text(name, bytes)?) {
            let table = table?;
            file.rows = table.rows;
            file.numbered_from = table.numbered_from;
            file.intensities = table.intensities.then(|| name.to_owned());
            if let Some(unit) = table.angles {
                file.notices.push(Notice::LightsAsAngles {
                    file: name.to_owned(),
                    unit: unit.to_owned(),
                });
            }
            return Ok(file);
        }
        file.parse_lines(bytes)?;
        Ok(file)
    }

    pub(crate) fn with_axes(self, axes: LightAxes) -> Self {
        Self { axes, ..self }
    }

    fn parse_lines(&mut self, bytes: &[u8]) -> Result<(), IoError> {
        let name = &self.name;
        let is_table = split_extension(name).1.eq_ignore_ascii_case("csv");
        if is_binary(bytes) {
            return Err(wrong_line(
                name,
                0,
                "content that is no text",
                "a text of lights (.lp, a table, lines of x y z) or an array as numpy saves it (.npy)",
            ));
        }
        let lines = parse_rows(name, bytes).map_err(|error| match error {
            IoError::LightFormat { line: 1, found, .. } if is_table => {
                wrong_line(name, 1, &found, light_table::HEADING)
            }
            error => error,
        })?;
        self.numbered_from = lines.numbered_from;
        for row in &lines.rows {
            let (vector, intensity) = match row.numbers[..] {
                [x, y, z] => ([x, y, z], [1.0; 3]),
                [x, y, z, grey] if row.file.is_some() => ([x, y, z], [grey; 3]),
                [x, y, z, grey, _] if row.file.is_some() => ([x, y, z], [grey; 3]),
                [x, y, z, r, g, b] => ([x, y, z], [r, g, b]),
                _ => return Err(row.wrong(name, "the three numbers x y z")),
            };
            let vector = Vec3::from(vector);
            if check_direction(vector).is_none() {
                return Err(row.wrong(name, "a finite vector that is not zero"));
            }
            if !intensity.into_iter().all(is_intensity) {
                return Err(row.wrong(name, "intensities above zero and below 1e30"));
            }
            if row.numbers.len() > 3 {
                self.intensities = Some(name.clone());
            }
            self.rows.push(LightRow {
                file: row.file.clone(),
                vector,
                intensity,
                confidence: 1.0,
            });
        }
        if let Some(said) = lines.declared
            && said != self.rows.len()
        {
            // Without names nobody can tell which light is missing.
            if self.rows.iter().any(|row| row.file.is_none()) || self.rows.is_empty() {
                check_count(name, self.rows.len(), said)?;
            }
            self.notices.push(Notice::LightsCountLine {
                file: name.clone(),
                said,
                found: self.rows.len(),
            });
        }
        Ok(())
    }

    /// The light of a row in our axes.
    pub(crate) fn light(&self, row: usize) -> Light {
        let LightRow {
            vector,
            intensity,
            confidence,
            ..
        } = self.rows[row];
        let unit = check_direction(vector).unwrap_or(Vec3::Z);
        Light {
            intensity,
            confidence,
            ..Light::new(self.axes.to_ours(unit), 1.0)
        }
    }

    /// The lights of these rows, with what is doubtful about them.
    pub(crate) fn given(
        &self,
        rows: &[usize],
        matched: NameMatch,
        mut notices: Vec<Notice>,
    ) -> Result<GivenLights, IoError> {
        let lights: Vec<Light> = rows.iter().map(|&row| self.light(row)).collect();
        let (behind, of) = (
            lights
                .iter()
                .filter(|light| light.direction.z < 0.0)
                .count(),
            lights.len(),
        );
        let file = self.name.clone();
        if 2 * behind > of {
            return Err(IoError::LightsBehind {
                name: file,
                behind,
                of,
            });
        }
        notices.splice(0..0, self.notices.iter().cloned());
        if behind > 0 {
            notices.push(Notice::LightsBehind {
                file: file.clone(),
                behind,
                of,
            });
        }
        let lengths = rows.iter().map(|&row| self.rows[row].vector.length());
        let (shortest, longest) = lengths.fold((f32::MAX, 0.0f32), |(low, high), length| {
            (low.min(length), high.max(length))
        });
        if of > 0 && (shortest < 0.98 || longest > 1.02) {
            notices.push(Notice::LightsNotUnit {
                file,
                shortest,
                longest,
            });
        }
        Ok(GivenLights {
            lights,
            matched,
            axes: self.axes,
            intensities: self.intensities.clone(),
            notices,
        })
    }
}
