//! What the writer takes, checked.
use super::entry::is_plain;
use super::{PublishedEntry, light_list};
use crate::light_text::{check_count, check_direction, is_intensity};
use crate::{IoError, photograph_png};
use normalight_core::{Light, MIN_IMAGES, Mask, NormalMap, StackImage, Transfer, Vec3};

/// An object for [`PublishedWriter::write`](super::PublishedWriter::write).
#[derive(Debug, Clone, Copy)]
pub struct ObjectToPublish<'a> {
    /// Names of shape and material, without spaces.
    pub entry: &'a PublishedEntry,
    /// Linear images of 8 or 16 bits; their names end with `.png` and have no spaces.
    pub images: &'a [StackImage],
    /// The true normals.
    pub normals: &'a NormalMap,
    /// The object's pixels; each must have a normal.
    pub mask: &'a Mask,
    /// The true depth of each pixel; values outside the mask are not written.
    ///
    /// `[height, width]`, rows from the top
    pub depth: Option<&'a [f32]>,
    /// The light of each image.
    pub lights: &'a [Light],
}

impl ObjectToPublish<'_> {
    /// Names and contents of the files of this material.
    pub(super) fn material_files(&self) -> Result<Vec<(String, Vec<u8>)>, IoError> {
        let lights = light_list::text(self.images, self.lights).into_bytes();
        let mut files = vec![(self.entry.lights_name(), lights)];
        for image in self.images {
            files.push((image.name.clone(), photograph_png(image)?));
        }
        Ok(files)
    }

    /// Whether the parts fit together, and can be read again.
    pub(super) fn check(&self) -> Result<(), IoError> {
        for name in [self.entry.shape(), self.entry.material()] {
            if !is_word(name) {
                return self.wrong(format!("the name {name:?}"), "a name without spaces");
            }
        }
        if self.images.len() < MIN_IMAGES {
            let found = format!("{} images", self.images.len());
            return self.wrong(found, "three images or more");
        }
        for (index, image) in self.images.iter().enumerate() {
            let mut before = self.images[..index].iter();
            if before.any(|other| other.name.eq_ignore_ascii_case(&image.name)) {
                let found = format!("two images {:?}", image.name);
                return self.wrong(found, "a name of its own for each");
            }
            self.check_image(image)?;
        }
        self.check_maps()?;
        self.check_lights()
    }

    fn check_image(&self, image: &StackImage) -> Result<(), IoError> {
        let name = &image.name;
        let is_png = name.to_ascii_lowercase().ends_with(".png");
        if !is_png || !is_plain(name) || !is_word(name) {
            return self.wrong(format!("the image name {name:?}"), "a name like 001.png");
        }
        let (width, height) = (self.mask.width(), self.mask.height());
        if (image.width, image.height) != (width, height) {
            let found = format!("{name} of {}x{} pixels", image.width, image.height);
            return self.wrong(found, &format!("{width}x{height} as the mask"));
        }
        match image.transfer {
            Transfer::Linear => Ok(()),
            Transfer::Srgb => self.wrong(format!("{name} in sRGB"), "linear images"),
        }
    }

    fn check_maps(&self) -> Result<(), IoError> {
        let (width, height) = (self.mask.width(), self.mask.height());
        let normals = self.normals;
        if (normals.width(), normals.height()) != (width, height) {
            let found = format!("{}x{} normals", normals.width(), normals.height());
            return self.wrong(found, &format!("{width}x{height} as the mask"));
        }
        let pixels = width * height;
        let depths = self.depth.map_or(pixels, <[f32]>::len);
        if depths != pixels {
            return self.wrong(format!("{depths} depths"), &format!("{pixels}"));
        }
        let inside = self.mask.inside().iter().zip(normals.normals());
        let bare = inside.filter(|(inside, normal)| **inside && **normal == Vec3::ZERO);
        let (bare, object) = (bare.count(), self.mask.count());
        if bare > 0 || object == 0 {
            let found = format!("{bare} of the object's {object} pixels without a normal");
            return self.wrong(found, "an object with a normal in each pixel");
        }
        Ok(())
    }

    fn check_lights(&self) -> Result<(), IoError> {
        let name = self.entry.lights_name();
        check_count(&name, self.lights.len(), self.images.len())?;
        let is_light = |light: &Light| {
            check_direction(light.direction).is_some()
                && light.intensity.into_iter().all(is_intensity)
        };
        match self.lights.iter().find(|light| !is_light(light)) {
            Some(light) => self.wrong(
                format!("{light:?}"),
                "a direction and intensities above zero",
            ),
            None => Ok(()),
        }
    }

    fn wrong(&self, found: String, expected: &str) -> Result<(), IoError> {
        Err(IoError::SetFormat {
            name: self.entry.to_string(),
            found,
            expected: expected.to_owned(),
        })
    }
}

/// Loaders part lines at spaces and drop what follows a number sign.
fn is_word(name: &str) -> bool {
    !name.contains(|c: char| c.is_whitespace() || c == '#')
}
