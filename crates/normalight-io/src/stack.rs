//! From files to a stack; where the bytes come from is the caller's affair.
use crate::assemble::assemble;
use crate::plan::{find_list, plan_stack};
use crate::text::read_text;
use crate::{IoError, NamedBytes, ReadOptions, StackInput};

/// Reads a stack from files in memory: images, and possibly a list and a mask, see
/// [`plan_stack`]. Each file is dropped once it is decoded; files that are no images are left out.
///
/// # Errors
/// Any [`IoError`] about a list or an image; [`IoError::TooManyFiles`]; [`IoError::TooFewImages`] or
/// [`IoError::TooFewRequested`]; [`IoError::NotAnImage`] when there are only other files;
/// [`IoError::AllIdentical`]; [`IoError::Core`] for images of different sizes, NaN, a mask of
/// another size, an empty mask or nothing but black.
pub fn read_stack(files: Vec<NamedBytes>, options: &ReadOptions) -> Result<StackInput, IoError> {
    options.limits.check_files("the given files", files.len())?;
    let names: Vec<String> = files.iter().map(|file| file.name.clone()).collect();
    let list = find_list(&names, |index| {
        read_text(&names[index], &files[index].bytes)
    })?;
    let list = list
        .as_ref()
        .map(|(index, text)| (names[*index].as_str(), text.as_str()));
    let place = list.map_or("the given files", |(name, _)| name).to_owned();
    let plan = plan_stack(&names, list)?;
    let mut contents: Vec<Vec<u8>> = files.into_iter().map(|file| file.bytes).collect();
    assemble(&place, &names, plan, options, |index| {
        Ok(std::mem::take(&mut contents[index]))
    })
}
