//! What can be wrong with files. Longer than other files: the errors of a library are one type.
use normalight_core::CoreError;
use thiserror::Error;

/// What can be wrong with files that are read or written; each names the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IoError {
    /// A file or folder cannot be read.
    #[error("{name}: cannot be read: {reason}")]
    Read {
        /// Path of the file or folder.
        name: String,
        /// What the system said.
        reason: std::io::Error,
    },
    /// A file or folder cannot be written.
    #[error("{name}: cannot be written: {reason}")]
    Write {
        /// Path of the file or folder.
        name: String,
        /// What the system said.
        reason: std::io::Error,
    },
    /// A file was given that is no image by its content or its extension.
    #[error("{name}: found {found}, expected an image ({expected})")]
    NotAnImage {
        /// The file.
        name: String,
        /// What it looks like instead.
        found: String,
        /// The formats that are read.
        expected: &'static str,
    },
    /// The file is of a known format but damaged, cut off, or of a variant that is not read.
    #[error("{name}: expected a complete {format} image, but: {reason}")]
    Decode {
        /// The file.
        name: String,
        /// Its format.
        format: &'static str,
        /// What the decoder found.
        reason: String,
    },
    /// The file is whole and of a known format, but of a variant that is not read.
    #[error("{name}: {format} with {found}, which is not read; {instead}")]
    Unread {
        /// The file.
        name: String,
        /// Its format.
        format: &'static str,
        /// What is unusual about it.
        found: String,
        /// What to do.
        instead: &'static str,
    },
    /// An image has more pixels than [`crate::Limits::pixels`].
    #[error("{name}: {width}x{height} pixels, at most {limit} pixels are read")]
    TooManyPixels {
        /// The file.
        name: String,
        /// Width according to its header.
        width: u32,
        /// Height according to its header.
        height: u32,
        /// The limit, in pixels.
        limit: u64,
    },
    /// A file is larger than its limit.
    #[error("{name}: {found} bytes, at most {limit} are read")]
    FileTooLarge {
        /// The file.
        name: String,
        /// Its size in bytes.
        found: u64,
        /// The limit, in bytes.
        limit: u64,
    },
    /// All images together need more memory than [`crate::Limits::stack_bytes`].
    #[error(
        "{name}: {images} images of this size need {found} bytes, at most {limit} are kept; use fewer or smaller images"
    )]
    StackTooLarge {
        /// The first image.
        name: String,
        /// Number of images.
        images: usize,
        /// Bytes of all samples.
        found: u64,
        /// The limit, in bytes.
        limit: u64,
    },
    /// More files than [`crate::Limits::files`].
    #[error("{name}: {found} files, at most {limit} are looked at; give the folder of one object")]
    TooManyFiles {
        /// The folder, or "the given files".
        name: String,
        /// Number of files.
        found: usize,
        /// The limit.
        limit: usize,
    },
    /// Too few images were found in a place.
    #[error("{name}: {found} image(s) found, at least {expected} are needed{besides}")]
    TooFewImages {
        /// The folder or list, or "the given files".
        name: String,
        /// Number of images.
        found: usize,
        /// Smallest number that works.
        expected: usize,
        /// What there is besides, in words after a semicolon; empty for nothing.
        besides: String,
    },
    /// A folder holds no files at all.
    #[error(
        "{name}: found no file in it{}, expected at least {expected} photographs",
        folders_label(*.folders)
    )]
    NothingHere {
        /// The folder.
        name: String,
        /// Folders in it, which hold no photographs either.
        folders: usize,
        /// Smallest number of photographs that works.
        expected: usize,
    },
    /// No photographs lie in a folder, but some in folders below it.
    #[error("{name}: no photographs here, but {below}; give that folder")]
    PhotographsBelow {
        /// The folder.
        name: String,
        /// The folders below with their numbers of photographs, in words.
        below: String,
    },
    /// An archive is damaged, of a format that is not read, too large, or holds what is refused.
    #[error("{name}: {format} archive with {found}; expected {expected}")]
    Archive {
        /// The archive.
        name: String,
        /// Its format.
        format: &'static str,
        /// What is wrong with it.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// The same shots lie side by side in two formats or depths.
    #[error(
        "{first} and {second}: the same shot twice, as {shots} of the shots; give one kind of them only"
    )]
    Copies {
        /// One file.
        first: String,
        /// The other file of the same shot.
        second: String,
        /// Number of shots that are there more than once.
        shots: usize,
    },
    /// All photographs are the same picture.
    #[error("{first} and all others are the same picture: each photograph needs another light")]
    AllIdentical {
        /// The first photograph.
        first: String,
    },
    /// All photographs show the same shading.
    #[error(
        "{first} and all others show the same shading (they differ by {:.2} % at most), expected another light in each: the lamp did not move",
        difference * 100.0
    )]
    LampStill {
        /// The first photograph.
        first: String,
        /// Largest mean difference of two shots of the same brightness, relative to their mean.
        difference: f32,
    },
    /// The photographs show several things.
    #[error(
        "photographs of {} different objects found, expected one object under moving light: {groups}",
        .count
    )]
    DifferentObjects {
        /// Number of groups of photographs that have something in common.
        count: usize,
        /// The photographs of each group, in words.
        groups: String,
    },
    /// The camera moved too far between the shots.
    #[error(
        "{files}: found up to {pixels:.1} pixels beside the other photographs, expected a fixed camera and object (here at most {limit:.1}); the align setting (--align) repairs shifts"
    )]
    CameraMoved {
        /// The shots that lie elsewhere than most, in words.
        files: String,
        /// Largest shift in pixels.
        pixels: f32,
        /// Largest shift that is let pass, in pixels.
        limit: f32,
    },
    /// The picture without lamp is brighter than the photographs with it.
    #[error(
        "{name}: brighter than the photographs on {:.0} % of the object, expected the same room, exposure and camera without the lamp",
        share * 100.0
    )]
    AmbientBrighter {
        /// The picture.
        name: String,
        /// Share of the object over all photographs, 0 to 1.
        share: f32,
    },
    /// Fewer images were asked for than photometric stereo works with.
    #[error("{name}: {found} image(s) were asked for, at least {expected} are needed")]
    TooFewRequested {
        /// The folder or list, or "the given files".
        name: String,
        /// Number of images asked for.
        found: usize,
        /// Smallest number that works.
        expected: usize,
    },
    /// A list names a file that is not there.
    #[error("{list}: names {entry}, which is not among the files beside it")]
    ListedFileMissing {
        /// The list file.
        list: String,
        /// The missing file.
        entry: String,
    },
    /// A line of a list is not a file name, or its count disagrees.
    #[error("{list}: found {found}, expected {expected}")]
    ListFormat {
        /// The list file.
        list: String,
        /// What it says.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A light file has more or fewer lights than there are images.
    #[error("{name}: {found} lights, but {expected} are expected")]
    LightCount {
        /// The light file.
        name: String,
        /// Number of lights in it.
        found: usize,
        /// Number of images.
        expected: usize,
    },
    /// A line of a light file cannot be understood, or its values make no light.
    #[error("{name}{}: found {found:?}, expected {expected}", line_label(*line))]
    LightFormat {
        /// The light file.
        name: String,
        /// Line number from 1; 0 when the file as a whole is meant.
        line: usize,
        /// What stands there.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// Most lights of a file lie behind the object.
    #[error(
        "{name}: {behind} of {of} lights lie behind the object (z is negative); expected x right, y up, z to the camera. If the file's y points down and its z into the scene, say that its axes are x-right,y-down,z-in (--light-axes)"
    )]
    LightsBehind {
        /// The light file.
        name: String,
        /// How many lie behind the object.
        behind: usize,
        /// Of how many.
        of: usize,
    },
    /// A file of true normals is not as expected.
    #[error("{name}: found {found}, expected {expected}")]
    TruthFormat {
        /// The file.
        name: String,
        /// What it holds.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A file of normals is not as expected.
    #[error(
        "{name}: found {found}, expected normals: an RGB image, or an array of floating-point numbers of shape [height, width, 3]"
    )]
    NormalFormat {
        /// The file.
        name: String,
        /// What it holds.
        found: String,
    },
    /// A file was given that is no mesh by its extension, or a folder or list without meshes.
    #[error("{name}: found {found}, expected a mesh ({expected})")]
    NotAMesh {
        /// The file, folder or list.
        name: String,
        /// What it is instead.
        found: String,
        /// The formats that are read.
        expected: &'static str,
    },
    /// A mesh file is damaged, cut off, or of a variant that is not read.
    #[error("{name}: {format} mesh with {found}; expected {expected}")]
    MeshFormat {
        /// The file.
        name: String,
        /// Its format.
        format: &'static str,
        /// What it holds.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A binary glTF file keeps its geometry elsewhere.
    #[error("{name}: its geometry lies in {uri:?}, expected all of it in the file itself")]
    ExternalBuffer {
        /// The file.
        name: String,
        /// Where the geometry is.
        uri: String,
    },
    /// What a mesh file holds makes no surface.
    #[error("{name}: {reason}")]
    Mesh {
        /// The file.
        name: String,
        /// What is wrong with it.
        reason: CoreError,
    },
    /// A line of a set's lists names no object.
    #[error("{name}, line {line}: found {found:?}, expected {expected}")]
    SetLine {
        /// The list.
        name: String,
        /// Line number from 1.
        line: usize,
        /// What stands there.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A set, or an object of one, is not as expected.
    #[error("{name}: found {found}, expected {expected}")]
    SetFormat {
        /// The file or the object.
        name: String,
        /// What there is.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// What shall be written is there already.
    #[error("{name}: exists already and is kept as it is")]
    Exists {
        /// Path of the file or folder.
        name: String,
    },
    /// An output cannot be encoded.
    #[error("{name}: cannot be encoded: {reason}")]
    Encode {
        /// Kind of output.
        name: &'static str,
        /// What the encoder said.
        reason: String,
    },
    /// The images or the mask do not fit each other.
    #[error(transparent)]
    Core(#[from] CoreError),
}

fn folders_label(folders: usize) -> String {
    match folders {
        0 => String::new(),
        folders => format!(" and no photographs in its {folders} folder(s)"),
    }
}

fn line_label(line: usize) -> String {
    match line {
        0 => String::new(),
        line => format!(", line {line}"),
    }
}
