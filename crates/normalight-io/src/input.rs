//! What a stack is read from, how, and what comes out.
use crate::input_plan::LightsDecision;
use crate::{ColorMode, GivenLights, InputPlan, Limits, Notice, Truth};
use normalight_core::{
    ImageStack, Light, LightAgreement, LightCoverage, Mask, MaskSource, intensities_from_directions,
};

/// A file in memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedBytes {
    /// File name; folders before it only appear in messages.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Where the mask shall come from.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum MaskChoice {
    /// The mask among the files, else the transparency of the first image, else a guess.
    #[default]
    Auto,
    /// Every pixel belongs to the object.
    WholeFrame,
    /// This image, see [`decode_mask`](crate::decode_mask).
    File(NamedBytes),
}

impl MaskChoice {
    /// The word of the command line, or the file's name.
    pub fn label(&self) -> &str {
        match self {
            Self::Auto => "auto",
            Self::WholeFrame => "none",
            Self::File(file) => &file.name,
        }
    }
}

/// What becomes of a picture without lamp, whose light is in all photographs.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum AmbientChoice {
    /// One that is recognised is left out, and that is said.
    #[default]
    LeaveOut,
    /// One that is recognised, by its name or by what it shows, is subtracted from all photographs.
    Auto,
    /// This one is subtracted; where it is among the photographs, it is none of them.
    File(NamedBytes),
}

impl AmbientChoice {
    /// The word of the command line, or the file's name.
    pub fn label(&self) -> &str {
        match self {
            Self::LeaveOut => "none",
            Self::Auto => "auto",
            Self::File(file) => &file.name,
        }
    }
}

/// How a stack is read.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ReadOptions {
    /// How samples relate to light.
    pub color: ColorMode,
    /// Where the mask comes from.
    pub mask: MaskChoice,
    /// Read only this many images, spread over the stack; all when `None` or too large.
    pub images: Option<usize>,
    /// How much is read at most.
    pub limits: Limits,
    /// What becomes of a picture without lamp.
    pub ambient: AmbientChoice,
    /// Whether photographs that a moved camera took are laid over the others (shifts only).
    pub align: bool,
}

/// A stack as read, ready for the pipeline.
#[derive(Debug, Clone)]
pub struct StackInput {
    /// The images; their names are file names, with folders only where names repeat.
    pub stack: ImageStack,
    /// The object's pixels; checked to fit the stack and to have some light inside.
    pub mask: Mask,
    /// Where the mask came from.
    pub mask_source: MaskSource,
    /// File names of all images found, read or not, in the order of the stack.
    pub file_names: Vec<String>,
    /// Position in `file_names` of each image of the stack: all of them unless
    /// [`ReadOptions::images`] chose some or one shows no lamp.
    pub picked: Vec<usize>,
    /// True normals, where a file among the photographs has them.
    pub truth: Option<Truth>,
    /// What was decided about the files, and what is doubtful.
    pub plan: InputPlan,
}

impl StackInput {
    /// File names of the images that were read, in order.
    pub fn picked_names(&self) -> Vec<String> {
        let images = self.stack.images().iter();
        images.map(|image| image.name.clone()).collect()
    }

    /// Takes lights that were given in a file, one for each photograph, and keeps in the plan how they were found and
    /// whether the photographs contradict them.
    pub fn accept_lights(&mut self, file: &str, given: GivenLights) -> Vec<Light> {
        self.plan.lights = Some(LightsDecision {
            file: file.to_owned(),
            matched: given.matched,
            intensities: given.intensities.clone(),
        });
        self.plan.notices.extend(given.notices);
        let mut lights = given.lights;
        if given.intensities.is_none() {
            let found = intensities_from_directions(&self.stack, &self.mask, &lights);
            for (light, found) in lights.iter_mut().zip(found.iter().flatten()) {
                light.intensity = [*found; 3];
            }
            self.plan.notices.push(Notice::LightsWithoutIntensity {
                file: file.to_owned(),
                found: found.is_some(),
            });
        }
        let agreement = LightAgreement::of(&self.stack, &self.mask, &lights);
        if let Some(agreement) = agreement.filter(LightAgreement::contradicts) {
            let axes = agreement.other_axes.map(|other| given.axes.then(other));
            self.plan.notices.push(Notice::LightsContradict {
                file: file.to_owned(),
                axes: axes.map(|axes| axes.to_string()),
            });
        }
        self.judge_coverage(&lights);
        lights
    }

    /// Keeps in the plan what is doubtful about the sides that the lights came from, and returns it. Lights of a file are
    /// judged when they are accepted.
    pub fn judge_coverage(&mut self, lights: &[Light]) -> &[Notice] {
        let before = self.plan.notices.len();
        if let Some(coverage) = LightCoverage::of(lights) {
            if coverage.is_flat() {
                self.plan.notices.push(Notice::LightsInPlane {
                    degrees: coverage.off_plane.asin().to_degrees(),
                });
            } else if let Some(side) = coverage.one_side() {
                self.plan.notices.push(Notice::LightsOneSided {
                    side: side.to_owned(),
                    dark: coverage.dark_degrees,
                });
            }
        }
        &self.plan.notices[before..]
    }

    /// Where the mask came from, in words or by its file name: for people and for the report.
    pub fn mask_label(&self) -> &str {
        mask_label(&self.mask_source)
    }
}

pub(crate) fn mask_label(source: &MaskSource) -> &str {
    match source {
        MaskSource::File(name) => name,
        MaskSource::Alpha => "transparency of the first image",
        MaskSource::Guessed => "told from the photographs",
        MaskSource::WholeFrame => "whole frame",
    }
}
