//! Decodes what a plan names, and decides what only the pixels can tell.
use crate::color::decision;
use crate::decode::{Stored, decode_stored, turned_mask};
use crate::format::{base_name, is_foreign, not_an_image};
use crate::input::mask_label;
use crate::input_plan::{InputPlan, LeftOut, LeftOutReason};
use crate::plan::{StackPlan, is_helper};
use crate::shots::ambient::{Ambient, NamedAmbient};
use crate::turn::{swaps_sides, turned};
use crate::{
    AmbientChoice, IoError, Limits, MaskChoice, Notice, ReadOptions, StackInput, left_out_lines,
    mask_file, shots,
};
use image::metadata::Orientation;
use normalight_core::{
    ImageStack, MIN_IMAGES, Mask, MaskGuess, MaskSource, Samples, StackImage, evenly_spaced_indices,
};

/// Share of a guessed mask's outline that the photographs agree with when nothing need be said.
const SURE: f32 = 0.8;

/// The decoded photographs and what was found out on the way.
struct Shots {
    images: Vec<StackImage>,
    /// Their positions in the plan.
    picked: Vec<usize>,
    /// Those of another size.
    left_out: Vec<LeftOut>,
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
    let shots = read_shots(names, &plan, &picked, options, &mut load)?;
    picked.clone_from(&shots.picked);
    let mut notices = plan.notices.clone();
    notices.extend(shots.notices);
    let mut images = shots.images;
    for (image, &position) in images.iter_mut().zip(&picked) {
        image.name = file_names[position].clone();
    }
    let given = match &options.mask {
        MaskChoice::WholeFrame => None,
        MaskChoice::File(file) => {
            let read = mask_file::read(&file.name, &file.bytes, &options.limits)?;
            Some((file.name.clone(), read))
        }
        MaskChoice::Auto => match plan.mask {
            Some(index) => {
                let file = mask_file::read(&names[index], &load(index)?, &options.limits)?;
                Some((names[index].clone(), file))
            }
            None => None,
        },
    };
    let unstated = shots.stated.iter().any(Option::is_none);
    let mut stack = ImageStack::new(images)?;
    let mut guess = None;
    let (mask, mask_source) = match (given, shots.alpha) {
        (Some((name, file)), _) => {
            let file = file.fitted(&name, &stack);
            notices.extend(file.notices);
            (file.mask, MaskSource::File(base_name(&name).to_owned()))
        }
        _ if options.mask == MaskChoice::WholeFrame => {
            let whole = Mask::whole(stack.width(), stack.height());
            (whole, MaskSource::WholeFrame)
        }
        // Some programs write an alpha channel of zeros: that is no mask.
        (None, Some(mask)) if mask.count() > 0 => (mask, MaskSource::Alpha),
        (None, _) => {
            let found = guess.insert(Mask::guess(&stack));
            (found.mask.clone(), MaskSource::Guessed)
        }
    };
    stack.check_mask(&mask, mask_label(&mask_source))?;
    let (color, doubts) = decision::decide(
        &mut stack,
        &mask,
        &shots.stated,
        plan.benchmark,
        options.color,
    );
    notices.extend(doubts);
    let mask = match guess {
        None => mask,
        Some(guess) => {
            // It sees light, not codes.
            let guess = if unstated { Mask::guess(&stack) } else { guess };
            notices.extend(doubt_of(&guess));
            guess.mask
        }
    };
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
            options,
            &mut notices,
        )?;
    }
    let mut left_out = plan.left_out;
    left_out.extend(shots.left_out);
    if !plan.benchmark {
        left_out.extend(shots::dark::settle(&mut stack, &mask, &mut picked)?);
        notices.extend(shots::check(&stack, &mask)?);
    }
    if !plan.benchmark || options.align {
        aligned = shots::motion::settle(&mut stack, &mut mask, options.align, &mut notices)?;
    }
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
    options: &ReadOptions,
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
        } = decode_stored(&names[index], &load(index)?, options.color, &options.limits)?;
        let image = StackImage {
            name: base_name(&names[index]).to_owned(),
            ..image
        };
        // The images may differ in depth, so the sum is watched as well as the forecast.
        total += sample_bytes(&image);
        let forecast = sample_bytes(&image) * picked.len() as u64;
        let need = if images.is_empty() { forecast } else { total };
        check_total(&image, picked.len(), need, &options.limits)?;
        if images.is_empty() {
            alpha = transparent;
        }
        images.push(image);
        stated.push(says);
        turns.push(orientation);
        notices.extend(more);
    }
    let mut picked = picked.to_vec();
    let upright = upright_alone(&images, &turns);
    let left_out = match upright {
        true => Vec::new(),
        false => {
            let odd = of_other_size(&images);
            let mut left_out = Vec::new();
            for &place in odd.iter().rev() {
                let image = images.remove(place);
                // The transparency that counts is the first one's.
                if place == 0 {
                    alpha = None;
                }
                picked.remove(place);
                stated.remove(place);
                turns.remove(place);
                let size = [image.width, image.height];
                let reason = LeftOutReason::OtherSize { size };
                left_out.insert(0, LeftOut::new(&image.name, reason));
            }
            left_out
        }
    };
    if upright {
        images = images
            .into_iter()
            .zip(&turns)
            .map(|(image, &turn)| turned(image, turn))
            .collect();
    }
    let orientation = match upright {
        true => Orientation::NoTransforms,
        false => agreed(&turns).unwrap_or(Orientation::NoTransforms),
    };
    if !upright && agreed(&turns).is_none() {
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
        picked,
        left_out,
        alpha: alpha.map(|mask| turned_mask(mask, orientation)),
        stated,
        notices,
    })
}

/// Whether the photographs are of one size only when each is turned upright.
fn upright_alone(images: &[StackImage], turns: &[Orientation]) -> bool {
    let one = |sizes: Vec<[usize; 2]>| sizes.windows(2).all(|pair| pair[0] == pair[1]);
    let stored = images.iter().map(|image| [image.width, image.height]);
    let upright = images
        .iter()
        .zip(turns)
        .map(|(image, &turn)| match swaps_sides(turn) {
            true => [image.height, image.width],
            false => [image.width, image.height],
        });
    !one(stored.collect()) && one(upright.collect())
}

/// Positions of photographs that have another size than most, where enough have that of most: one odd one shall not
/// stop all others, wherever it lies.
fn of_other_size(images: &[StackImage]) -> Vec<usize> {
    let size = |image: &StackImage| [image.width, image.height];
    let count = |wanted: [usize; 2]| images.iter().filter(|image| size(image) == wanted).count();
    let Some(usual) = images.iter().map(size).max_by_key(|&size| count(size)) else {
        return Vec::new();
    };
    if count(usual) < MIN_IMAGES.max(3 * images.len() / 4) {
        return Vec::new();
    }
    let odd = images.iter().enumerate();
    odd.filter(|(_, image)| size(image) != usual)
        .map(|(place, _)| place)
        .collect()
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

/// What a place with too few photographs holds besides, for a message.
fn besides(plan: &StackPlan) -> String {
    let lines = left_out_lines(&plan.left_out, false);
    lines.iter().map(|line| format!("; {line}")).collect()
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
            besides: besides(plan),
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

/// What is doubtful about a mask that nobody gave.
fn doubt_of(guess: &MaskGuess) -> Option<Notice> {
    match guess.certainty {
        _ if guess.is_whole_frame() => Some(Notice::MaskGuessedWhole),
        certainty if certainty < SURE => Some(Notice::MaskGuessUnsure { certainty }),
        _ => None,
    }
}

fn sample_bytes(image: &StackImage) -> u64 {
    let bytes = match &image.samples {
        Samples::U8(samples) => samples.len(),
        Samples::U16(samples) => 2 * samples.len(),
        Samples::F32(samples) => 4 * samples.len(),
    };
    bytes as u64
}

fn check_total(
    image: &StackImage,
    images: usize,
    found: u64,
    limits: &Limits,
) -> Result<(), IoError> {
    if found > limits.stack_bytes {
        return Err(IoError::StackTooLarge {
            name: image.name.clone(),
            images,
            found,
            limit: limits.stack_bytes,
        });
    }
    Ok(())
}
