//! Light files of any kind, and which of their lights belongs to which image.
use crate::format::{base_name, split_extension};
use crate::light_text::{check_count, parse_csv, parse_rows};
use crate::{IoError, StackInput};
use normalight_core::Light;

/// The lights of a file, with the image names that stand beside them.
pub(crate) struct LightFile {
    name: String,
    pub(crate) rows: Vec<(Option<String>, Light)>,
}

impl LightFile {
    pub(crate) fn parse(name: &str, bytes: &[u8]) -> Result<Self, IoError> {
        let rows = if split_extension(name).1.eq_ignore_ascii_case("csv") {
            parse_csv(name, bytes)?
        } else {
            let rows = parse_rows(name, bytes)?.into_iter();
            rows.map(|row| Ok((Light::new(row.direction(name)?, 1.0), row.file)))
                .map(|row| row.map(|(light, file)| (file, light)))
                .collect::<Result<_, IoError>>()?
        };
        Ok(Self {
            name: name.to_owned(),
            rows,
        })
    }

    /// One light for each image: by name where any name matches, else by order.
    pub(crate) fn for_images(&self, file_names: &[String]) -> Result<Vec<Light>, IoError> {
        if let Some(lights) = self.by_name(file_names) {
            return lights;
        }
        check_count(&self.name, self.rows.len(), file_names.len())?;
        Ok(self.rows.iter().map(|(_, light)| *light).collect())
    }

    /// One light for each image that was read; the file may have been made for all images found.
    pub(crate) fn for_input(&self, input: &StackInput) -> Result<Vec<Light>, IoError> {
        let names = input.picked_names();
        if let Some(lights) = self.by_name(&names) {
            return lights;
        }
        if self.rows.len() == names.len() {
            return self.for_images(&names);
        }
        let all = self.for_images(&input.file_names)?;
        Ok(input.picked.iter().map(|&index| all[index]).collect())
    }

    /// `None` when no image's name is in the file.
    fn by_name(&self, file_names: &[String]) -> Option<Result<Vec<Light>, IoError>> {
        let light_of = |file: &String| {
            let named = |row: &&(Option<String>, Light)| {
                let row_file = row.0.as_deref().map(base_name);
                row_file == Some(base_name(file))
            };
            self.rows.iter().find(named).map(|(_, light)| *light)
        };
        let matched: Vec<Option<Light>> = file_names.iter().map(light_of).collect();
        if matched.iter().all(Option::is_none) {
            return None;
        }
        let complete = matched.into_iter().zip(file_names).map(|(light, file)| {
            light.ok_or_else(|| IoError::LightFormat {
                name: self.name.clone(),
                line: 0,
                found: format!("{} lights of other images", self.rows.len()),
                expected: format!("a light for {file}"),
            })
        });
        Some(complete.collect())
    }
}

/// Reads one light for each image: our `lights.csv`, an `.lp` file (count, then `name x y z`), or
/// lines of `x y z` (unit length or not) with or without a count before them, as DiLiGenT's
/// `light_directions.txt` and UW's `lights.txt` have them.
///
/// Lines with file names are matched with `file_names` (folders do not count) and may cover more
/// images than these. When no name matches, and in files without names, the order counts and there
/// must be as many lines as names. Files without intensities give intensity 1.
///
/// # Errors
/// [`IoError::LightCount`]; [`IoError::LightFormat`] for lines that cannot be understood, vectors
/// that are zero or not finite, and images that a file with names leaves out.
pub fn read_lights(name: &str, bytes: &[u8], file_names: &[String]) -> Result<Vec<Light>, IoError> {
    LightFile::parse(name, bytes)?.for_images(file_names)
}

impl StackInput {
    /// As [`read_lights`], for the images of this stack; a file without names may have a line for
    /// each of them or for each image found.
    ///
    /// # Errors
    /// Those of [`read_lights`].
    pub fn read_lights(&self, name: &str, bytes: &[u8]) -> Result<Vec<Light>, IoError> {
        LightFile::parse(name, bytes)?.for_input(self)
    }
}
