//! What is doubtful about an input but usable: typed, for the report, the page and the command.
mod words;

use serde::{Deserialize, Serialize};
pub(crate) use words::some_names;

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
    /// The browser decoded files of a format that is not read here.
    DecodedByBrowser {
        /// The format.
        format: String,
        /// The files.
        files: Vec<String>,
    },
    /// The files came out of an archive.
    FromArchive {
        /// The archive.
        archive: String,
        /// The folder in it that holds the photographs; empty for none, or for several with a
        /// photograph or two each.
        folder: String,
    },
    /// The photographs lie in folders of their own, one in each.
    OneInEachFolder,
    /// The pages of a file were taken as the photographs.
    PagesAsPhotographs {
        /// The file.
        file: String,
        /// Number of pages.
        pages: usize,
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
    /// Samples that are no numbers (NaN), taken as black.
    NotNumbers {
        /// The file.
        file: String,
        /// Number of such samples.
        samples: usize,
    },
    /// True normals that cannot be compared with.
    TruthUnread {
        /// The file and what is wrong with it.
        reason: String,
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
    /// A light file gives directions only.
    LightsWithoutIntensity {
        /// The light file.
        file: String,
        /// Whether the brightnesses were found from the photographs; else all are taken as equal.
        found: bool,
    },
    /// The photographs contradict the lights: the object's outline does not brighten towards them.
    LightsContradict {
        /// The light file.
        file: String,
        /// Axes of the file under which they would agree, as the setting takes them.
        axes: Option<String>,
    },
    /// Lights lie nearly in one plane with the object: normals are ambiguous across it.
    LightsInPlane {
        /// Typical angle between the lights and that plane, in degrees.
        degrees: f32,
    },
    /// All lights came from one side.
    LightsOneSided {
        /// The side, in words.
        side: String,
        /// Degrees around the viewing axis in which there is no light.
        dark: f32,
    },
    /// Lights are given as angles.
    LightsAsAngles {
        /// The light file.
        file: String,
        /// `degrees` or `radians`.
        unit: String,
    },
}
