//! Decodes what a plan names, and decides what only the pixels can tell.
use crate::color::evidence::encoded_factor;
use crate::decode::{Stored, decode_stored, turned_mask};
use crate::format::{base_name, is_foreign, not_an_image};
use crate::input::mask_label;
use crate::input_plan::{ColorDecision, ColorReason, InputPlan};
use crate::limits::MAX_STACK_BYTES;
use crate::plan::{StackPlan, is_helper};
use crate::shots::ambient::{Ambient, NamedAmbient};
use crate::turn::turned;
use crate::{
    AmbientChoice, ColorMode, IoError, MaskChoice, Notice, ReadOptions, StackInput, mask_file,
    shots,
};
use image::metadata::Orientation;
use normalight_core::{
    ImageStack, MIN_IMAGES, Mask, MaskSource, Samples, StackImage, Transfer, evenly_spaced_indices,
};

/// How much better one reading must explain the photographs to be believed where nothing is said.
const CLEAR: f32 = 1.25;
/// ... and to be said where something else was taken.
const CONTRADICTED: f32 = 2.0;

/// The decoded photographs and what was found out on the way.
struct Shots {
    images: Vec<StackImage>,
    /// What each file says about its samples.
    stated: Vec<Option<String>>,
    alpha: Option<Mask>,
    notices: Vec<Notice>,
}

/// `load` hands out each file's bytes once.
pub(crate) fn assemble(
    place: &str,
    names: &[String],
    plan: StackPlan,
    options: &ReadOptions,
    mut load: impl FnMut(usize) -> Result<Vec<u8>, IoError>,
) -> Result<StackInput, IoError> {
    let mut picked = pick(place, names, &plan, options.images)?;
    let file_names = shown_names(names, &plan);
    let shots = read_shots(names, &plan, &picked, options.color, &mut load)?;
    let mut notices = plan.notices.clone();
    notices.extend(shots.notices);
    let mut images = shots.images;
    for (image, &position) in images.iter_mut().zip(&picked) {
        image.name = file_names[position].clone();
    }
    let given = match &options.mask {
        MaskChoice::WholeFrame => None,
        MaskChoice::File(file) => {
            Some((file.name.clone(), mask_file::read(&file.name, &file.bytes)?))
        }
        MaskChoice::Auto => match plan.mask {
            Some(index) => {
                let file = mask_file::read(&names[index], &load(index)?)?;
                Some((names[index].clone(), file))
            }
            None => None,
        },
    };
    let unstated = shots.stated.iter().any(Option::is_none);
    let mut stack = ImageStack::new(images)?;
    let (mask, mask_source) = match (given, shots.alpha) {
        (Some((name, file)), _) => {
            notices.extend(file.notices);
            (file.mask, MaskSource::File(base_name(&name).to_owned()))
        }
        _ if options.mask == MaskChoice::WholeFrame => {
            let whole = Mask::whole(stack.width(), stack.height());
            (whole, MaskSource::WholeFrame)
        }
        // Some programs write an alpha channel of zeros: that is no mask.
        (None, Some(mask)) if mask.count() > 0 => (mask, MaskSource::Alpha),
        (None, _) => (Mask::guess(&stack), MaskSource::Guessed),
    };
    check_mask(&stack, &mask, &mask_source)?;
    let color = decide_color(
        &mut stack,
        &mask,
        &shots.stated,
        &plan,
        options.color,
        &mut notices,
    );
    // The guess sees light, not codes.
    let mask = match mask_source == MaskSource::Guessed && unstated {
        true => Mask::guess(&stack),
        false => mask,
    };
    if mask_source == MaskSource::Guessed && 10 * mask.count() > 9 * mask.inside().len() {
        notices.push(Notice::MaskGuessedWhole);
    }
    let named = match plan.ambient {
        Some(index) => Some(NamedAmbient {
            file: base_name(&names[index]).to_owned(),
            bytes: match options.ambient {
                AmbientChoice::Auto => load(index)?,
                _ => Vec::new(),
            },
        }),
        None => None,
    };
    let (mut mask, mut ambient, mut aligned) = (mask, Ambient::default(), None);
    // Benchmarks are what they are, unless somebody asks.
    if !plan.benchmark || options.ambient != AmbientChoice::LeaveOut {
        ambient = shots::ambient::settle(
            (&mut stack, &mask, &mut picked),
            named,
            (&options.ambient, options.color),
            &mut notices,
        )?;
    }
    if !plan.benchmark {
        notices.extend(shots::check(&stack, &mask)?);
    }
    if !plan.benchmark || options.align {
        aligned = shots::motion::settle(&mut stack, &mut mask, options.align, &mut notices)?;
    }
    let mut left_out = plan.left_out;
    left_out.extend(ambient.left_out);
    if let Some(file) = &ambient.subtracted {
        left_out.retain(|left| base_name(&left.file) != file);
    }
    let plan = InputPlan {
        photographs: stack
            .images()
            .iter()
            .map(|image| image.name.clone())
            .collect(),
        order: plan.order,
        left_out,
        mask: mask_label(&mask_source).to_owned(),
        color,
        lights: None,
        ambient: ambient.subtracted,
        aligned,
        notices,
    };
    Ok(StackInput {
        stack,
        mask,
        mask_source,
        file_names,
        picked,
        plan,
    })
}

/// Names of the images without folders, or with them where names repeat.
fn shown_names(names: &[String], plan: &StackPlan) -> Vec<String> {
    let full = || plan.images.iter().map(|&index| &names[index]);
    let mut bases: Vec<&str> = full().map(|name| base_name(name)).collect();
    bases.sort_unstable();
    let unique = bases.windows(2).all(|pair| pair[0] != pair[1]);
    full()
        .map(|name| if unique { base_name(name) } else { name })
        .map(str::to_owned)
        .collect()
}

fn read_shots(
    names: &[String],
    plan: &StackPlan,
    picked: &[usize],
    color: ColorMode,
    load: &mut impl FnMut(usize) -> Result<Vec<u8>, IoError>,
) -> Result<Shots, IoError> {
    let mut images: Vec<StackImage> = Vec::with_capacity(picked.len());
    let (mut stated, mut turns, mut notices) = (Vec::new(), Vec::new(), Vec::new());
    let mut alpha = None;
    let mut total = 0;
    for &position in picked {
        let index = plan.images[position];
        let Stored {
            image,
            alpha: transparent,
            orientation,
            stated: says,
            notices: more,
        } = decode_stored(&names[index], &load(index)?, color)?;
        let image = StackImage {
            name: base_name(&names[index]).to_owned(),
            ..image
        };
        // The images may differ in depth, so the sum is watched as well as the forecast.
        total += sample_bytes(&image);
        let forecast = sample_bytes(&image) * picked.len() as u64;
        let need = if images.is_empty() { forecast } else { total };
        check_total(&image, picked.len(), need)?;
        if images.is_empty() {
            alpha = transparent;
        }
        images.push(image);
        stated.push(says);
        turns.push(orientation);
        notices.extend(more);
    }
    let orientation = agreed(&turns).unwrap_or(Orientation::NoTransforms);
    if agreed(&turns).is_none() {
        let usual = most_frequent(&turns);
        let odd = images
            .iter()
            .zip(&turns)
            .filter(|(_, turn)| **turn != usual);
        notices.push(Notice::Orientations {
            files: odd.map(|(image, _)| image.name.clone()).collect(),
        });
    }
    Ok(Shots {
        images: images
            .into_iter()
            .map(|image| turned(image, orientation))
            .collect(),
        alpha: alpha.map(|mask| turned_mask(mask, orientation)),
        stated,
        notices,
    })
}

fn agreed(turns: &[Orientation]) -> Option<Orientation> {
    let first = *turns.first()?;
    turns.iter().all(|turn| *turn == first).then_some(first)
}

fn most_frequent(turns: &[Orientation]) -> Orientation {
    let count = |wanted: &Orientation| turns.iter().filter(|turn| *turn == wanted).count();
    let most = turns.iter().max_by_key(|turn| count(turn));
    most.copied().unwrap_or(Orientation::NoTransforms)
}

/// How samples are taken to relate to light, and why; sets the transfer of images that say nothing.
fn decide_color(
    stack: &mut ImageStack,
    mask: &Mask,
    stated: &[Option<String>],
    plan: &StackPlan,
    asked: ColorMode,
    notices: &mut Vec<Notice>,
) -> ColorDecision {
    let benchmark = plan.benchmark && asked == ColorMode::Auto;
    let unstated: Vec<usize> = (0..stated.len()).filter(|&k| stated[k].is_none()).collect();
    let factor = match benchmark {
        true => None,
        false => encoded_factor(stack, mask),
    };
    let is_8_bit = |&image: &usize| matches!(stack.images()[image].samples, Samples::U8(_));
    let decided = match factor {
        _ if unstated.is_empty() => None,
        _ if benchmark => Some((Transfer::Linear, ColorReason::Benchmark)),
        _ if !unstated.iter().all(is_8_bit) => Some((Transfer::Linear, ColorReason::Usual)),
        Some(factor) if factor < 1.0 / CLEAR => Some((Transfer::Linear, ColorReason::Shading)),
        Some(factor) if factor > CLEAR => Some((Transfer::Srgb, ColorReason::Shading)),
        _ => Some((Transfer::Srgb, ColorReason::Usual)),
    };
    let word = |transfer| match transfer {
        Transfer::Linear => "linear",
        Transfer::Srgb => "sRGB",
    };
    if let Some((transfer, because)) = decided {
        for &image in &unstated {
            stack.set_transfer(image, transfer);
        }
        if because != ColorReason::Benchmark {
            notices.push(Notice::ColorUnstated {
                taken: word(transfer).to_owned(),
            });
        }
    }
    let all = |wanted| stack.images().iter().all(|image| image.transfer == wanted);
    let integers = |image: &StackImage| !matches!(image.samples, Samples::F32(_));
    if let Some(factor) = factor
        && stack.images().iter().all(integers)
    {
        let looks = match factor {
            factor if factor > CONTRADICTED && all(Transfer::Linear) => Some(Transfer::Srgb),
            factor if factor < 1.0 / CONTRADICTED && all(Transfer::Srgb) => Some(Transfer::Linear),
            _ => None,
        };
        if let Some(looks) = looks {
            let taken = stack.images()[0].transfer;
            notices.push(Notice::LooksOtherwise {
                taken: word(taken).to_owned(),
                looks: word(looks).to_owned(),
                factor: factor.max(1.0 / factor),
            });
        }
    }
    let mut said: Vec<String> = stated.iter().flatten().cloned().collect();
    said.extend(decided.map(|(transfer, _)| word(transfer).to_owned()));
    said.sort();
    said.dedup();
    ColorDecision {
        taken: said.join(" and "),
        because: match (asked, decided) {
            (ColorMode::Auto, Some((_, because))) => because,
            (ColorMode::Auto, None) => ColorReason::Stated,
            _ => ColorReason::Asked,
        },
    }
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
        && let Some(name) = names
            .iter()
            .find(|name| is_foreign(name) && !is_helper(name))
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
