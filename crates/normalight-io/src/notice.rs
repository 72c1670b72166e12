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
    /// The files came out of an archive.
    FromArchive {
        /// The archive.
        archive: String,
        /// The folder in it that holds the photographs; empty for none, or for several with a
        /// photograph or two each.
        folder: String,
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
    /// A profile, or what else a file says of its colours, that cannot be honoured.
    ProfileNotUnderstood {
        /// The file.
        file: String,
        /// What is wrong with it.
        reason: String,
        /// How the samples were taken instead.
        taken: String,
    },
    /// Nothing in the files says how samples relate to light.
    ColorUnstated {
        /// How they were taken.
        taken: String,
        /// Where the shading decided: how often such an answer is right, 0 to 1, measured on rendered
        /// objects.
        sure: Option<f32>,
    },
    /// The files say different things of their colours; each was read as it says.
    ColorMixed {
        /// What is said, or how files that say nothing were taken, each with the first such file.
        said: Vec<String>,
    },
    /// Samples taken as linear look as if a curve for viewing lay on them, or the other way round.
    LooksOtherwise {
        /// How they were taken.
        taken: String,
        /// How they look.
        looks: String,
        /// By how much the other reading explains the photographs better, as a factor.
        factor: f32,
        /// How often such an answer is right, 0 to 1, measured on rendered objects.
        sure: f32,
    },
    /// The mask has several clear values or colours; all but one were taken as the object.
    MaskLabels {
        /// The mask.
        file: String,
        /// Number of values that are the object.
        parts: usize,
    },
    /// Much of the mask is neither dark nor bright, as in a photograph.
    MaskSoft {
        /// The mask.
        file: String,
        /// Share of such pixels, 0 to 1.
        share: f32,
    },
    /// The whole of the mask is inside.
    MaskFull {
        /// The mask.
        file: String,
    },
    /// The mask has another size than the photographs and was scaled to theirs.
    MaskScaled {
        /// The mask.
        file: String,
        /// Its width and height in pixels.
        from: [usize; 2],
        /// Those of the photographs.
        to: [usize; 2],
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
    /// No object was told from a background: the whole frame was taken.
    MaskGuessedWhole,
    /// The mask was told from the photographs, and part of its outline is doubtful.
    MaskGuessUnsure {
        /// Share of the outline that the photographs agree with, 0 to 1.
        certainty: f32,
    },
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
    /// Much of the object is saturated over all shots.
    Overexposed {
        /// Share of saturated samples over the object and all shots, 0 to 1.
        share: f32,
    },
    /// All shots show nearly the same shading.
    LampHardlyMoved {
        /// Largest mean difference of two shots of the same brightness, relative to their mean.
        difference: f32,
    },
    /// A shot is brighter and flatter than all others.
    RoomLit {
        /// The shot.
        file: String,
    },
    /// A picture without lamp was left out.
    AmbientLeftOut {
        /// The picture.
        file: String,
    },
    /// A picture without lamp was to be subtracted, but none was recognised.
    NoAmbient,
    /// The picture without lamp is brighter than photographs with it.
    AmbientBrighter {
        /// The picture.
        file: String,
        /// Share of the object's pixels where that is so, 0 to 1.
        share: f32,
    },
    /// The camera moved a little.
    CameraMoved {
        /// The shots that lie elsewhere than most.
        files: Vec<String>,
        /// Largest shift in pixels.
        pixels: f32,
    },
    /// Shots that show nothing of what the others show.
    Unlike {
        /// The shots.
        files: Vec<String>,
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
            Self::FromArchive { archive, folder } if folder.is_empty() => {
                write!(f, "{archive}: an archive, read without unpacking it to the disk")
            }
            Self::FromArchive { archive, folder } => write!(
                f,
                "{archive}: an archive, read without unpacking it to the disk; photographs from its folder {folder}"
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
            Self::ProfileNotUnderstood { file, reason, taken } => write!(
                f,
                "{file}: what it says of its colours is not understood ({reason}); taken as {taken}"
            ),
            Self::ColorUnstated { taken, sure } => {
                write!(
                    f,
                    "nothing in the photographs says how their numbers relate to light; taken as {taken}"
                )?;
                match sure {
                    Some(sure) if *sure > 0.5 => {
                        write!(f, " by their shading ({:.0} % sure)", sure * 100.0)?;
                    }
                    Some(_) => f.write_str(" by their shading, which is hardly better than a guess")?,
                    None => f.write_str(", as such files usually are")?,
                }
                f.write_str("; the colour setting (--color) says otherwise")
            }
            Self::ColorMixed { said } => write!(
                f,
                "the photographs say different things of their colours; each was read as it says: {}",
                some_names(said)
            ),
            Self::LooksOtherwise { taken, looks, factor, sure } => write!(
                f,
                "the photographs were taken as {taken} but look {looks} (which explains them {factor:.1} times better; {:.0} % sure); if so, say it with the colour setting (--color {})",
                sure * 100.0,
                looks.to_lowercase()
            ),
            Self::MaskLabels { file, parts } => write!(
                f,
                "{file}: holds {parts} parts beside the background, all taken as the object"
            ),
            Self::MaskSoft { file, share } => write!(
                f,
                "{file}: {:.0} % of it are neither dark nor bright, as in a photograph; inside is what is above the middle",
                share * 100.0
            ),
            Self::MaskFull { file } => {
                write!(f, "{file}: all of the frame is inside")
            }
            Self::MaskScaled { file, from: [width, height], to: [to_width, to_height] } => write!(
                f,
                "{file}: has {width}x{height} pixels, scaled to the {to_width}x{to_height} of the photographs"
            ),
            Self::MaskFromTransparency { file } => write!(
                f,
                "{file}: its colours show no mask, so its transparency was taken as one"
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
                "no mask was found and no object could be told from a background, so the whole frame was taken; if there is a background, give a mask",
            ),
            Self::MaskGuessUnsure { certainty } => write!(
                f,
                "no mask was found; the object was told from its background by the photographs, which agree with {:.0} % of its outline: look at the mask, or give one",
                certainty * 100.0
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
            Self::Overexposed { share } => write!(
                f,
                "{:.0} % of the object are saturated over all photographs, where shading cannot be seen: expose less",
                share * 100.0
            ),
            Self::LampHardlyMoved { difference } => write!(
                f,
                "all photographs show nearly the same shading (they differ by {:.1} % at most); did the lamp move?",
                difference * 100.0
            ),
            Self::RoomLit { file } => write!(
                f,
                "{file}: brighter and flatter than all others; if not a strong lamp beside the camera but another light was on, leave it out"
            ),
            Self::AmbientLeftOut { file } => write!(
                f,
                "{file}: shows the object without lamp and was left out; its light can be subtracted from all photographs with the ambient setting (--ambient auto)"
            ),
            Self::NoAmbient => f.write_str(
                "no picture without lamp was recognised, by its name or by what it shows; nothing was subtracted",
            ),
            Self::AmbientBrighter { file, share } => write!(
                f,
                "{file}: brighter than the photographs on {:.0} % of the object, so it was taken with another exposure or another light; what was subtracted is wrong there",
                share * 100.0
            ),
            Self::CameraMoved { files, pixels } => write!(
                f,
                "{}: lies up to {pixels:.1} pixels beside the other photographs, so the camera or the object moved; the align setting (--align) repairs it",
                some_names(files)
            ),
            Self::Unlike { files } => write!(
                f,
                "{}: shows nothing of what the other photographs show; another object, out of focus, or moved far?",
                some_names(files)
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
