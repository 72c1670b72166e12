//! DiLiGenT's intensities, which stand in a file of their own.
use crate::IoError;
use crate::light_file::LightFile;
use crate::light_text::{Row, check_count, is_intensity, parse_rows};

impl LightFile {
    /// Takes the intensities per colour channel from a second file with as many lines: three
    /// numbers on each, or one for grey.
    pub(crate) fn with_intensities(mut self, name: &str, bytes: &[u8]) -> Result<Self, IoError> {
        let lines = parse_rows(name, bytes)?.rows;
        check_count(name, lines.len(), self.rows.len())?;
        for (light, line) in self.rows.iter_mut().zip(&lines) {
            light.intensity = intensity(name, line)?;
        }
        self.intensities = Some(name.to_owned());
        Ok(self)
    }
}

fn intensity(name: &str, row: &Row) -> Result<[f32; 3], IoError> {
    let intensity = match row.numbers[..] {
        [r, g, b] if row.file.is_none() => [r, g, b],
        [grey] if row.file.is_none() => [grey; 3],
        _ => return Err(row.wrong(name, "one or three intensities")),
    };
    if intensity.into_iter().all(is_intensity) {
        return Ok(intensity);
    }
    Err(row.wrong(name, "intensities above zero and below 1e30"))
}
