/// Most pixels of one image: 100 megapixels, above any camera a phone or a studio uses for this. Under
/// the fuzzer it is one, so that memory or time beyond the limit stands out.
pub const MAX_PIXELS: u64 = if cfg!(fuzzing) { 1 << 20 } else { 100_000_000 };

/// Largest file that is read: 2 GiB, above the largest uncompressed image within [`MAX_PIXELS`].
pub const MAX_FILE_BYTES: u64 = 2 << 30;

/// Largest text file (lists, lights) that is read: 4 MiB.
pub const MAX_TEXT_BYTES: u64 = 4 << 20;

/// Most bytes that the samples of one stack may take: 32 GiB, and 2 GiB where addresses have 32
/// bits (the browser).
pub const MAX_STACK_BYTES: u64 = if usize::BITS > 32 { 32 << 30 } else { 2 << 30 };

/// Most bytes that decoding one image may take, output and scratch: the largest image in
/// floating-point RGBA, and a quarter more.
pub(crate) const MAX_DECODE_BYTES: u64 = MAX_PIXELS * 20;

/// Largest mesh file that is read: 256 MiB, above the largest text of as many triangles as are
/// taken.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Most vertices of one mesh: as many as its triangles can use.
pub(crate) const MAX_MESH_VERTICES: usize = 3 * normalight_core::MAX_TRIANGLES;
