//! From files to a stack; where the bytes come from is the caller's affair.
use crate::source::{MemoryFiles, read_files};
use crate::{IoError, NamedBytes, ReadOptions, StackInput};

/// Reads a stack from files in memory: images, and possibly a list and a mask, see
/// [`plan_stack`](crate::plan_stack). Each file is dropped once it is decoded; files that are no
/// images are left out.
///
/// Zip, tar and tar.gz archives, known by their content, are opened where the images beside them
/// are too few for a stack: their files count as if they were handed in, with their paths as names.
/// Of an archive with several folders, the one with photographs counts and those above it. Each
/// file is unpacked when it is its turn (a tar.gz at once). The limits are
/// [`MAX_ARCHIVE_FILES`](crate::MAX_ARCHIVE_FILES), [`MAX_ARCHIVE_BYTES`](crate::MAX_ARCHIVE_BYTES)
/// and [`MAX_ARCHIVE_RATIO`](crate::MAX_ARCHIVE_RATIO).
///
/// # Errors
/// Any [`IoError`] about a list, an image or an archive; [`IoError::TooFewImages`] or
/// [`IoError::TooFewRequested`]; [`IoError::NotAnImage`] when there are only other files;
/// [`IoError::PhotographsBelow`] for several folders of photographs in an archive;
/// [`IoError::AllIdentical`]; [`IoError::Core`] for images of different sizes, NaN, a mask of
/// another size, an empty mask or nothing but black.
pub fn read_stack(files: Vec<NamedBytes>, options: &ReadOptions) -> Result<StackInput, IoError> {
    options.limits.check_files("the given files", files.len())?;
    read_files(None, Box::new(MemoryFiles::new(files)), options)
}
