use glam::Vec3;
use thiserror::Error;

/// What can be wrong with values that enter this crate.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CoreError {
    /// Photometric stereo needs at least [`crate::MIN_IMAGES`] photographs.
    #[error("{found} image(s) found, at least {expected} are needed")]
    TooFewImages {
        /// Number of images given.
        found: usize,
        /// Smallest number that works.
        expected: usize,
    },
    /// One image differs in size from the first.
    #[error(
        "{name}: {found_width}x{found_height} pixels, but the first image has {expected_width}x{expected_height}"
    )]
    SizeMismatch {
        /// The image's file name.
        name: String,
        /// Its width.
        found_width: usize,
        /// Its height.
        found_height: usize,
        /// Width of the first image.
        expected_width: usize,
        /// Height of the first image.
        expected_height: usize,
    },
    /// An image holds more or fewer samples than its size needs.
    #[error("{name}: {found} samples, but {expected} are expected for its size")]
    SampleCount {
        /// The image's file name.
        name: String,
        /// Number of samples given.
        found: usize,
        /// width * height * channels.
        expected: usize,
    },
    /// Images too small to estimate anything from.
    #[error("{name}: {width}x{height} pixels, at least {expected}x{expected} are needed")]
    TooSmall {
        /// The image's file name.
        name: String,
        /// Its width.
        width: usize,
        /// Its height.
        height: usize,
        /// Smallest side that works.
        expected: usize,
    },
    /// A sample is NaN or infinite.
    #[error("{name}: sample {index} is {value}, finite numbers are expected")]
    NotFinite {
        /// The image's file name.
        name: String,
        /// Position of the sample.
        index: usize,
        /// Its value.
        value: f32,
    },
    /// No image has any light inside the mask.
    #[error("all {images} images are black inside the mask: nothing to estimate from")]
    AllBlack {
        /// Number of images.
        images: usize,
    },
    /// The mask marks no pixel.
    #[error("{name}: the mask is empty, at least one pixel must belong to the object")]
    EmptyMask {
        /// Where the mask came from.
        name: String,
    },
    /// The mask has another size than the images.
    #[error(
        "{name}: the mask has {found_width}x{found_height} pixels, the images have {expected_width}x{expected_height}"
    )]
    MaskSize {
        /// Where the mask came from.
        name: String,
        /// Width of the mask.
        found_width: usize,
        /// Height of the mask.
        found_height: usize,
        /// Width of the images.
        expected_width: usize,
        /// Height of the images.
        expected_height: usize,
    },
    /// The number of lights differs from the number of images.
    #[error("{found} lights for {expected} images: one light per image is expected")]
    LightCount {
        /// Number of lights.
        found: usize,
        /// Number of images.
        expected: usize,
    },
    /// Lights of which none points out of the plane of the others.
    #[error(
        "the {lights} lights lie in a plane: at least three must point in independent directions"
    )]
    LightsInPlane {
        /// Number of lights.
        lights: usize,
    },
    /// Photographs that do not tell three directions of light apart.
    #[error(
        "the {images} images differ in fewer than three independent ways: lights in a plane, or an object without relief"
    )]
    RankTooLow {
        /// Number of images.
        images: usize,
    },
    /// Too few pixels of the object have neighbours on all sides.
    #[error(
        "{found} pixels of the object have neighbours on all sides, at least {expected} are needed"
    )]
    TooFewPixels {
        /// Number of such pixels.
        found: usize,
        /// Smallest number that works.
        expected: usize,
    },
    /// Two maps that must have the same size differ.
    #[error(
        "maps of different sizes: {found_width}x{found_height} against {expected_width}x{expected_height}"
    )]
    MapSize {
        /// Width of the second map.
        found_width: usize,
        /// Height of the second map.
        found_height: usize,
        /// Width of the first map.
        expected_width: usize,
        /// Height of the first map.
        expected_height: usize,
    },
    /// A focal length that no camera has.
    #[error("a focal length of {found} pixels, a number above zero is expected")]
    FocalLength {
        /// The focal length given, in pixels.
        found: f32,
    },
    /// A mesh without triangles.
    #[error("no triangles found, at least one is needed")]
    NoTriangles,
    /// A mesh has more triangles than [`crate::MAX_TRIANGLES`].
    #[error("{found} triangles, at most {allowed} are taken")]
    TooManyTriangles {
        /// Number of triangles.
        found: usize,
        /// The limit.
        allowed: usize,
    },
    /// A vertex of a mesh has a coordinate that is NaN or infinite.
    #[error("vertex {vertex} is at {value}, finite numbers are expected")]
    MeshPosition {
        /// Number of the vertex, from 0.
        vertex: usize,
        /// Its position.
        value: Vec3,
    },
    /// A triangle of a mesh names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {index}, but there are {vertices} (from 0)")]
    MeshIndex {
        /// Number of the triangle, from 0.
        triangle: usize,
        /// The vertex that it names.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// No triangle of a mesh has an area.
    #[error("none of {triangles} triangles has an area, at least one is needed")]
    FlatMesh {
        /// Number of triangles.
        triangles: usize,
    },
}
