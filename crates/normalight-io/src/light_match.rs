//! Which light belongs to which photograph.
use crate::light_axes::LightAxes;
use crate::light_file::{GivenLights, LightFile};
use crate::light_text::{check_count, wrong_line};
use crate::names::{NameKey, NameMatch, find};
use crate::{IoError, Notice, StackInput};
use normalight_core::Light;

/// Rows for some photographs, and the least sure rule that found one.
type Matched = (Vec<usize>, NameMatch);

impl LightFile {
    /// One light for each image: by name where any name matches, else by order.
    pub(crate) fn for_images(&self, file_names: &[String]) -> Result<GivenLights, IoError> {
        if let Some(matched) = self.by_name(file_names) {
            return self.named(matched?);
        }
        if let Some(rows) = self.by_running_number(file_names) {
            return self.named((rows, NameMatch::Number));
        }
        let (rows, notices) = self.by_position(file_names)?;
        self.given(&rows, NameMatch::Position, notices)
    }

    /// One light for each image that was read; the file may have been made for all images found.
    pub(crate) fn for_input(&self, input: &StackInput) -> Result<GivenLights, IoError> {
        let names = input.picked_names();
        if let Some(matched) = self.by_name(&names) {
            return self.named(matched?);
        }
        if self.rows.len() == names.len() {
            return self.for_images(&names);
        }
        // As many as were found are for those, by their order.
        if self.rows.len() != input.file_names.len()
            && let Some(rows) = self.by_running_number(&names)
        {
            return self.named((rows, NameMatch::Number));
        }
        let (all, notices) = self.by_position(&input.file_names)?;
        let rows: Vec<usize> = input.picked.iter().map(|&index| all[index]).collect();
        self.given(&rows, NameMatch::Position, notices)
    }

    fn named(&self, (rows, matched): Matched) -> Result<GivenLights, IoError> {
        let mut used = vec![false; self.rows.len()];
        rows.iter().for_each(|&row| used[row] = true);
        let unused = used.iter().filter(|used| !**used).count();
        let notice = (unused > 0).then(|| Notice::LightsUnused {
            file: self.name.clone(),
            lights: unused,
        });
        self.given(&rows, matched, notice.into_iter().collect())
    }

    /// `None` when no image's name is in the file.
    fn by_name(&self, file_names: &[String]) -> Option<Result<Matched, IoError>> {
        let named: Vec<usize> = (0..self.rows.len())
            .filter(|&row| self.rows[row].file.is_some())
            .collect();
        let keys: Vec<NameKey> = named
            .iter()
            .map(|&row| NameKey::new(self.rows[row].file.as_deref().unwrap_or_default()))
            .collect();
        let images: Vec<NameKey> = file_names.iter().map(|name| NameKey::new(name)).collect();
        let found: Vec<_> = images.iter().map(|image| find(image, &keys)).collect();
        if found.iter().all(Option::is_none) {
            let rows = by_number(&images, &keys)?;
            let rows = rows.into_iter().map(|key| named[key]).collect();
            return Some(Ok((rows, NameMatch::Number)));
        }
        let mut rows = Vec::with_capacity(found.len());
        let (mut missing, mut several) = (Vec::new(), Vec::new());
        let mut least = NameMatch::Full;
        for (place, (name, found)) in file_names.iter().zip(found).enumerate() {
            let Some((rule, keys)) = found else {
                missing.push(name.as_str());
                continue;
            };
            let row = named[keys[0]];
            // Twice the same light is no contradiction.
            let agree = keys
                .iter()
                .all(|&key| self.light(named[key]) == self.light(row));
            if !agree || (rows.contains(&row) && rows.len() == place) {
                several.push(name.as_str());
            }
            least = least.max(rule);
            rows.push(row);
        }
        let wrong = |found: String, expected: String| {
            Some(Err(IoError::LightFormat {
                name: self.name.clone(),
                line: 0,
                found,
                expected,
            }))
        };
        if !missing.is_empty() {
            let found = format!("{} lights of other images", self.rows.len());
            return wrong(found, format!("a light for {}", missing.join(", ")));
        }
        if !several.is_empty() {
            let found = format!("more than one match for {}", several.join(", "));
            return wrong(found, "one light for each photograph".to_owned());
        }
        Some(Ok((rows, least)))
    }

    /// Of more lights than photographs, numbered from the first: those with the numbers in the photographs' names.
    fn by_running_number(&self, file_names: &[String]) -> Option<Vec<usize>> {
        let first = self
            .numbered_from
            .filter(|_| self.rows.len() > file_names.len())?;
        let images: Vec<NameKey> = file_names.iter().map(|name| NameKey::new(name)).collect();
        let keys = (0..self.rows.len()).map(|row| NameKey::new(&(first + row).to_string()));
        by_number(&images, &keys.collect::<Vec<_>>())
    }

    /// The first light belongs to the first image, unless the numbers in the names say otherwise.
    fn by_position(&self, file_names: &[String]) -> Result<(Vec<usize>, Vec<Notice>), IoError> {
        check_count(&self.name, self.rows.len(), file_names.len())?;
        let mut notices = Vec::new();
        let named: Option<Vec<&str>> = self.rows.iter().map(|row| row.file.as_deref()).collect();
        if let Some(named) = named.filter(|named| !named.is_empty()) {
            let order = |names: &mut dyn Iterator<Item = &str>| -> Option<Vec<usize>> {
                let numbers: Vec<u64> = names
                    .map(|name| NameKey::new(name).number)
                    .collect::<Option<_>>()?;
                let mut order: Vec<usize> = (0..numbers.len()).collect();
                order.sort_by_key(|&place| numbers[place]);
                Some(order)
            };
            let rows = order(&mut named.into_iter());
            let images = order(&mut file_names.iter().map(String::as_str));
            if let (Some(rows), Some(images)) = (rows, images)
                && rows != images
            {
                return Err(wrong_line(
                    &self.name,
                    0,
                    "names of other images, numbered in another order",
                    "the names of the photographs, or as many lines in their order",
                ));
            }
            notices.push(Notice::LightsByPosition {
                file: self.name.clone(),
            });
        }
        Ok(((0..self.rows.len()).collect(), notices))
    }
}

/// The row with the same number for each image, where numbers tell all of them apart.
fn by_number(images: &[NameKey], keys: &[NameKey]) -> Option<Vec<usize>> {
    let numbers = |keys: &[NameKey]| -> Option<Vec<u64>> {
        let numbers: Vec<u64> = keys.iter().map(|key| key.number).collect::<Option<_>>()?;
        let mut sorted = numbers.clone();
        sorted.sort_unstable();
        sorted.dedup();
        (sorted.len() == numbers.len()).then_some(numbers)
    };
    let rows = numbers(keys)?;
    let wanted = numbers(images)?;
    let row_of = |number| rows.iter().position(|&row| row == number);
    wanted.into_iter().map(row_of).collect()
}

/// Reads one light for each image: our `lights.csv`, also after a spreadsheet and with azimuth and
/// elevation instead of a vector; an `.lp` file (count, then `name x y z`); lines of `x y z` (unit
/// length or not) with or without a count before them, or a running number before each, as
/// DiLiGenT's `light_directions.txt` and UW's `lights.txt` have them; an array of numpy.
///
/// Lines with names are matched with `file_names`, see [`NameMatch`], and may cover more images
/// than these. When no name matches, and in files without names, the order counts and there must
/// be as many lines as names. Files without intensities give intensity 1.
///
/// # Errors
/// [`IoError::LightCount`]; [`IoError::LightFormat`] for lines that cannot be understood, vectors
/// that are zero or not finite, images that a file with names leaves out or names twice;
/// [`IoError::LightsBehind`].
pub fn read_lights(name: &str, bytes: &[u8], file_names: &[String]) -> Result<Vec<Light>, IoError> {
    Ok(LightFile::parse(name, bytes)?
        .for_images(file_names)?
        .lights)
}

impl StackInput {
    /// As [`read_lights`], for the images of this stack; a file without names may have a line for
    /// each of them or for each image found.
    ///
    /// # Errors
    /// Those of [`read_lights`].
    pub fn read_lights(&self, name: &str, bytes: &[u8]) -> Result<Vec<Light>, IoError> {
        Ok(self.given_lights(name, bytes, LightAxes::default())?.lights)
    }

    /// As [`StackInput::read_lights`], for a file with these axes, and with what there is to say.
    ///
    /// # Errors
    /// Those of [`read_lights`].
    pub fn given_lights(
        &self,
        name: &str,
        bytes: &[u8],
        axes: LightAxes,
    ) -> Result<GivenLights, IoError> {
        LightFile::parse(name, bytes)?
            .with_axes(axes)
            .for_input(self)
    }
}
