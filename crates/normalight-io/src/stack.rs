use crate::decode::{decode_image, decode_mask};
use crate::limits::{MAX_STACK_BYTES, MAX_TEXT_BYTES};
use crate::plan::{StackPlan, find_list, plan_stack};
use crate::{ColorMode, IoError};
use normalight_core::{ImageStack, MIN_IMAGES, Mask, MaskSource, Samples, StackImage};

/// A file in memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedBytes {
    /// File name; folders before it are allowed and ignored.
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
    /// This image: inside is where it is brighter than half.
    File(NamedBytes),
}

/// How a stack is read.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct StackOptions {
    /// How samples relate to light.
    pub color: ColorMode,
    /// Where the mask comes from.
    pub mask: MaskChoice,
    /// Read only this many images, evenly spaced over the stack; all when `None` or too large.
    pub images: Option<usize>,
}

/// A stack as read, ready for the pipeline.
#[derive(Debug, Clone)]
pub struct StackInput {
    /// The images.
    pub stack: ImageStack,
    /// The object's pixels; checked to fit the stack and to have some light inside.
    pub mask: Mask,
    /// Where the mask came from.
    pub mask_source: MaskSource,
    /// Position of each read image among all images found: `0..found` unless
    /// [`StackOptions::images`] chose some.
    pub picked: Vec<usize>,
    /// Number of images found, read or not.
    pub found: usize,
}

/// Reads a stack from files in memory: images, and possibly a list and a mask, see
/// [`plan_stack`]. Each file is dropped once it is decoded.
///
/// # Errors
/// Any [`IoError`] about a list or an image; [`IoError::Core`] for images of different sizes, NaN,
/// a mask of another size, an empty mask or nothing but black.
pub fn read_stack(files: Vec<NamedBytes>, options: StackOptions) -> Result<StackInput, IoError> {
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

/// Text of a small file; bytes that are no UTF-8 are replaced.
pub(crate) fn read_text(name: &str, bytes: &[u8]) -> Result<String, IoError> {
    if bytes.len() as u64 > MAX_TEXT_BYTES {
        return Err(IoError::FileTooLarge {
            name: name.to_owned(),
            found: bytes.len() as u64,
            limit: MAX_TEXT_BYTES,
        });
    }
    Ok(String::from_utf8_lossy(bytes).into_owned())
}

/// Decodes what a plan names; `load` hands out each file's bytes once.
pub(crate) fn assemble(
    place: &str,
    names: &[String],
    plan: StackPlan,
    options: StackOptions,
    mut load: impl FnMut(usize) -> Result<Vec<u8>, IoError>,
) -> Result<StackInput, IoError> {
    let found = plan.images.len();
    let count = options.images.map_or(found, |wanted| wanted.min(found));
    if count < MIN_IMAGES {
        return Err(IoError::TooFewImages {
            name: place.to_owned(),
            found: count,
            expected: MIN_IMAGES,
        });
    }
    let picked: Vec<usize> = (0..count).map(|k| k * found / count).collect();
    let mut images: Vec<StackImage> = Vec::with_capacity(count);
    let mut alpha = None;
    let mut total = 0u64;
    for &position in &picked {
        let index = plan.images[position];
        let decoded = decode_image(&names[index], &load(index)?, options.color)?;
        if images.is_empty() {
            alpha = decoded.alpha;
            check_total(
                &decoded.image,
                count,
                sample_bytes(&decoded.image) * count as u64,
            )?;
        }
        // The images may differ in depth, so the sum is watched as well as the forecast.
        total += sample_bytes(&decoded.image);
        check_total(&decoded.image, count, total)?;
        images.push(decoded.image);
    }
    let stack = ImageStack::new(images)?;
    let given = match options.mask {
        MaskChoice::WholeFrame => {
            let mask = Mask::whole(stack.width(), stack.height());
            return finish(stack, mask, MaskSource::WholeFrame, picked, found);
        }
        MaskChoice::File(file) => Some((file.name, file.bytes)),
        MaskChoice::Auto => match plan.mask {
            Some(index) => Some((names[index].clone(), load(index)?)),
            None => None,
        },
    };
    let (mask, source) = match (given, alpha) {
        (Some((name, bytes)), _) => (decode_mask(&name, &bytes)?, MaskSource::File(name)),
        // Some programs write an alpha channel of zeros: that is no mask.
        (None, Some(mask)) if mask.count() > 0 => (mask, MaskSource::Alpha),
        (None, _) => (Mask::guess(&stack), MaskSource::Guessed),
    };
    finish(stack, mask, source, picked, found)
}

fn finish(
    stack: ImageStack,
    mask: Mask,
    mask_source: MaskSource,
    picked: Vec<usize>,
    found: usize,
) -> Result<StackInput, IoError> {
    let name = match &mask_source {
        MaskSource::File(name) => name.as_str(),
        MaskSource::Alpha => "transparency of the first image",
        MaskSource::Guessed => "guessed mask",
        MaskSource::WholeFrame => "whole frame",
    };
    let checked = stack.check_mask(&mask, name);
    // A guess finds nothing only where there is no light: say that instead.
    if mask_source == MaskSource::Guessed && checked.is_err() {
        stack.check_mask(&Mask::whole(stack.width(), stack.height()), name)?;
    }
    checked?;
    Ok(StackInput {
        stack,
        mask,
        mask_source,
        picked,
        found,
    })
}

fn sample_bytes(image: &StackImage) -> u64 {
    let bytes = match &image.samples {
        Samples::U8(samples) => samples.len(),
        Samples::U16(samples) => 2 * samples.len(),
        Samples::F32(samples) => 4 * samples.len(),
    };
    bytes as u64
}

fn check_total(image: &StackImage, images: usize, found: u64) -> Result<(), IoError> {
    if found > MAX_STACK_BYTES {
        return Err(IoError::StackTooLarge {
            name: image.name.clone(),
            images,
            found,
            limit: MAX_STACK_BYTES,
        });
    }
    Ok(())
}
