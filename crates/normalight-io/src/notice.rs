//! What is doubtful about an input but usable: typed, for the report, the page and the command.
use serde::{Deserialize, Serialize};
use std::fmt;

/// Something about the input that a person should know.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Notice {
    /// A file is of another format than its extension says; the content was believed.
    ContentOverExtension {
        /// The file.
        file: String,
        /// Format of the content.
        content: String,
        /// The extension, without its dot.
        extension: String,
    },
    /// A list names files with other extensions than they have.
    ListByStem {
        /// The list.
        list: String,
    },
    /// A text among the files looks like a list, but its name says that it lists rejects.
    ListIgnored {
        /// The text.
        list: String,
    },
    /// A photograph whose name is unlike all others.
    OddName {
        /// The file.
        file: String,
    },
    /// A file holds several pages or pictures; one was taken.
    SeveralPages {
        /// The file.
        file: String,
        /// Number of pages.
        pages: usize,
        /// Which was taken, from 1.
        page: usize,
    },
    /// A file is an animation; its first picture was taken.
    Animation {
        /// The file.
        file: String,
    },
    /// A file holds several pictures under names (layers, parts); one was taken.
    SeveralLayers {
        /// The file.
        file: String,
        /// The one that was taken.
        taken: String,
        /// The others.
        others: Vec<String>,
    },
    /// Channels that are neither colours nor transparency were left out.
    ExtraChannels {
        /// The file.
        file: String,
        /// How many.
        channels: usize,
    },
    /// Samples without a finite value: infinite ones were taken as the brightest finite one.
    Infinite {
        /// The file.
        file: String,
        /// Number of such samples.
        samples: usize,
    },
    /// The photographs disagree about which side is up; pixels were taken as stored.
    Orientations {
        /// The shots that say otherwise than most.
        files: Vec<String>,
    },
    /// A profile that cannot be honoured; the samples were taken as sRGB.
    ProfileNotUnderstood {
        /// The file.
        file: String,
        /// What is wrong with the profile.
        reason: String,
    },
    /// Nothing in the files says how samples relate to light.
    ColorUnstated {
        /// How they were taken.
        taken: String,
    },
    /// Samples taken as linear look as if a curve for viewing lay on them, or the other way round.
    LooksOtherwise {
        /// How they were taken.
        taken: String,
        /// How they look.
        looks: String,
        /// By how much the other reading explains the photographs better, as a factor.
        factor: f32,
    },
    /// The mask is the transparency of its file.
    MaskFromTransparency {
        /// The mask.
        file: String,
    },
    /// The mask was taken inverted: its bright part is the border of the frame.
    MaskInverted {
        /// The mask.
        file: String,
    },
    /// The mask has other values than black and white; what was inside is stated.
    MaskValues {
        /// The mask.
        file: String,
        /// Values found, 0 to 1.
        values: Vec<f32>,
        /// Value above which a pixel is inside.
        above: f32,
    },
    /// The guessed mask is nearly the whole frame.
    MaskGuessedWhole,
    /// Shots that are nearly the same picture.
    NearlyIdentical {
        /// The files.
        files: Vec<String>,
    },
    /// Shots that are black inside the mask.
    Black {
        /// The files.
        files: Vec<String>,
    },
    /// Shots of which a large part is saturated inside the mask.
    Saturated {
        /// The files.
        files: Vec<String>,
        /// Largest share of saturated pixels, 0 to 1.
        share: f32,
    },
    /// A light file's first line says another number of lights than there are.
    LightsCountLine {
        /// The light file.
        file: String,
        /// What it says.
        said: usize,
        /// Lights found.
        found: usize,
    },
    /// A light file has lights of photographs that are not used.
    LightsUnused {
        /// The light file.
        file: String,
        /// Number of such lights.
        lights: usize,
    },
    /// Names stand beside the lights, but none is that of a photograph: the order counted.
    LightsByPosition {
        /// The light file.
        file: String,
    },
    /// Lights are no unit vectors; only their directions were used.
    LightsNotUnit {
        /// The light file.
        file: String,
        /// Shortest vector.
        shortest: f32,
        /// Longest vector.
        longest: f32,
    },
    /// Some lights lie behind the object.
    LightsBehind {
        /// The light file.
        file: String,
        /// How many.
        behind: usize,
        /// Of how many.
        of: usize,
    },
    /// Lights are given as angles.
    LightsAsAngles {
        /// The light file.
        file: String,
        /// `degrees` or `radians`.
        unit: String,
    },
}

/// Some names for a message: all of a few, else the first and how many more.
pub(crate) fn some_names(names: &[String]) -> String {
    const SHOWN: usize = 6;
    let shown = names[..names.len().min(SHOWN)].join(", ");
    match names.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ContentOverExtension { file, content, extension } => write!(
                f,
                "{file}: the content is {content} though the extension is {extension:?}; read as {content}"
            ),
            Self::ListByStem { list } => write!(
                f,
                "{list}: names files with other extensions; matched without them"
            ),
            Self::ListIgnored { list } => write!(
                f,
                "{list}: by its name a list of rejects, not taken as the list of the photographs"
            ),
            Self::OddName { file } => write!(
                f,
                "{file}: named unlike the other photographs, but taken as one"
            ),
            Self::SeveralPages { file, pages, page } => write!(
                f,
                "{file}: has {pages} pages, page {page} was taken; save others as files of their own to use them"
            ),
            Self::Animation { file } => {
                write!(f, "{file}: an animation, of which the first picture was taken")
            }
            Self::SeveralLayers { file, taken, others } => write!(
                f,
                "{file}: holds several pictures; {taken} was taken, not {}",
                some_names(others)
            ),
            Self::ExtraChannels { file, channels } => write!(
                f,
                "{file}: {channels} channel(s) beside its colours were left out"
            ),
            Self::Infinite { file, samples } => write!(
                f,
                "{file}: {samples} infinite samples, taken as the brightest finite value"
            ),
            Self::Orientations { files } => write!(
                f,
                "{}: turned otherwise than the other shots by their EXIF orientation; pixels of all shots were taken as stored",
                some_names(files)
            ),
            Self::ProfileNotUnderstood { file, reason } => write!(
                f,
                "{file}: its colour profile is not understood ({reason}); taken as sRGB"
            ),
            Self::ColorUnstated { taken } => write!(
                f,
                "nothing in the photographs says how their numbers relate to light; taken as {taken}"
            ),
            Self::LooksOtherwise { taken, looks, factor } => write!(
                f,
                "the photographs were taken as {taken} but look {looks} (which explains them {factor:.1} times better); if so, say it with the colour setting"
            ),
            Self::MaskFromTransparency { file } => write!(
                f,
                "{file}: all of one colour, so its transparency was taken as the mask"
            ),
            Self::MaskInverted { file } => write!(
                f,
                "{file}: bright at the border of the frame and dark inside; taken inverted"
            ),
            Self::MaskValues { file, values, above } => write!(
                f,
                "{file}: holds the values {values:.3?}; inside is what is above {above:.3}"
            ),
            Self::MaskGuessedWhole => f.write_str(
                "no mask was found and the guess is nearly the whole frame: a mask would help, above all if the background is bright",
            ),
            Self::NearlyIdentical { files } => write!(
                f,
                "{}: nearly the same picture; did the light move?",
                some_names(files)
            ),
            Self::Black { files } => {
                write!(f, "{}: black inside the mask", some_names(files))
            }
            Self::Saturated { files, share } => write!(
                f,
                "{}: up to {:.0} % of the object are saturated; expose less",
                some_names(files),
                share * 100.0
            ),
            Self::LightsCountLine { file, said, found } => write!(
                f,
                "{file}: its first line says {said} lights, but {found} follow"
            ),
            Self::LightsUnused { file, lights } => write!(
                f,
                "{file}: {lights} of its lights belong to no photograph that is used"
            ),
            Self::LightsByPosition { file } => write!(
                f,
                "{file}: none of its names is that of a photograph, so lights were matched by their order"
            ),
            Self::LightsNotUnit { file, shortest, longest } => write!(
                f,
                "{file}: vectors of length {shortest:.3} to {longest:.3}; only their directions were used"
            ),
            Self::LightsBehind { file, behind, of } => write!(
                f,
                "{file}: {behind} of {of} lights lie behind the object (negative z)"
            ),
            Self::LightsAsAngles { file, unit } => write!(
                f,
                "{file}: angles were taken as {unit}, the azimuth from right towards up"
            ),
        }
    }
}
