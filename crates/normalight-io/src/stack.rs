//! From files to a stack; where the bytes come from is the caller's affair.
use crate::decode::{decode_image, decode_mask};
use crate::format::{base_name, is_foreign, not_an_image};
use crate::input::mask_label;
use crate::limits::{MAX_STACK_BYTES, MAX_TEXT_BYTES};
use crate::plan::{StackPlan, find_list, plan_stack};
use crate::{IoError, MaskChoice, NamedBytes, ReadOptions, StackInput};
use normalight_core::{
    ImageStack, MIN_IMAGES, Mask, MaskSource, Samples, StackImage, evenly_spaced_indices,
};

/// Reads a stack from files in memory: images, and possibly a list and a mask, see
/// [`plan_stack`]. Each file is dropped once it is decoded; files that are no images are ignored.
///
/// # Errors
/// Any [`IoError`] about a list or an image; [`IoError::TooFewImages`] or
/// [`IoError::TooFewRequested`]; [`IoError::NotAnImage`] when there are only other files;
/// [`IoError::Core`] for images of different sizes, NaN, a mask of another size, an empty mask or
/// nothing but black.
pub fn read_stack(files: Vec<NamedBytes>, options: &ReadOptions) -> Result<StackInput, IoError> {
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
///
/// # Errors
/// [`IoError::FileTooLarge`] above [`MAX_TEXT_BYTES`].
pub fn read_text(name: &str, bytes: &[u8]) -> Result<String, IoError> {
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
    options: &ReadOptions,
    mut load: impl FnMut(usize) -> Result<Vec<u8>, IoError>,
) -> Result<StackInput, IoError> {
    let picked = pick(place, names, &plan, options.images)?;
    let mut images: Vec<StackImage> = Vec::with_capacity(picked.len());
    let mut alpha = None;
    let mut total = 0;
    for &position in &picked {
        let index = plan.images[position];
        let decoded = decode_image(&names[index], &load(index)?, options.color)?;
        let image = StackImage {
            name: base_name(&names[index]).to_owned(),
            ..decoded.image
        };
        // The images may differ in depth, so the sum is watched as well as the forecast.
        total += sample_bytes(&image);
        let forecast = sample_bytes(&image) * picked.len() as u64;
        let need = if images.is_empty() { forecast } else { total };
        check_total(&image, picked.len(), need)?;
        if images.is_empty() {
            alpha = decoded.alpha;
        }
        images.push(image);
    }
    let stack = ImageStack::new(images)?;
    let given = match &options.mask {
        MaskChoice::WholeFrame => None,
        MaskChoice::File(file) => Some((&file.name, decode_mask(&file.name, &file.bytes)?)),
        MaskChoice::Auto => match plan.mask {
            Some(index) => Some((&names[index], decode_mask(&names[index], &load(index)?)?)),
            None => None,
        },
    };
    let (mask, mask_source) = match (given, alpha) {
        (Some((name, mask)), _) => (mask, MaskSource::File(base_name(name).to_owned())),
        _ if options.mask == MaskChoice::WholeFrame => {
            let whole = Mask::whole(stack.width(), stack.height());
            (whole, MaskSource::WholeFrame)
        }
        // Some programs write an alpha channel of zeros: that is no mask.
        (None, Some(mask)) if mask.count() > 0 => (mask, MaskSource::Alpha),
        (None, _) => (Mask::guess(&stack), MaskSource::Guessed),
    };
    check_mask(&stack, &mask, &mask_source)?;
    let all = plan.images.iter();
    Ok(StackInput {
        stack,
        mask,
        mask_source,
        file_names: all
            .map(|&index| base_name(&names[index]).to_owned())
            .collect(),
        picked,
    })
}

/// Positions in the plan of the images to read.
fn pick(
    place: &str,
    names: &[String],
    plan: &StackPlan,
    wanted: Option<usize>,
) -> Result<Vec<usize>, IoError> {
    let found = plan.images.len();
    if found == 0
        && let Some(name) = names.iter().find(|name| is_foreign(name))
    {
        return Err(not_an_image(name));
    }
    let name = place.to_owned();
    let expected = MIN_IMAGES;
    if found < expected {
        return Err(IoError::TooFewImages {
            name,
            found,
            expected,
        });
    }
    match wanted {
        Some(found) if found < expected => Err(IoError::TooFewRequested {
            name,
            found,
            expected,
        }),
        _ => Ok(evenly_spaced_indices(found, wanted.unwrap_or(found))),
    }
}

fn check_mask(stack: &ImageStack, mask: &Mask, source: &MaskSource) -> Result<(), IoError> {
    let name = mask_label(source);
    let checked = stack.check_mask(mask, name);
    // A guess finds nothing only where there is no light: say that instead.
    if *source == MaskSource::Guessed && checked.is_err() {
        stack.check_mask(&Mask::whole(stack.width(), stack.height()), name)?;
    }
    Ok(checked?)
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
