//! Decodes what a plan names, and decides what only the pixels can tell.
mod photographs;

use crate::color::decision;
use crate::format::{base_name, is_foreign, not_an_image};
use crate::input::mask_label;
use crate::input_plan::InputPlan;
use crate::plan::{StackPlan, is_helper};
use crate::shots::ambient::{Ambient, NamedAmbient};
use crate::truth::{Truth, read_truth};
use crate::{
    AmbientChoice, IoError, MaskChoice, Notice, ReadOptions, StackInput, left_out_lines, mask_file,
    shots,
};
use normalight_core::{
    ImageStack, MIN_IMAGES, Mask, MaskGuess, MaskSource, Transfer, spread_indices,
};
use photographs::read_shots;

/// Share of a guessed mask's outline that the photographs agree with when nothing need be said.
const SURE: f32 = 0.8;

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
    let taken_before = transfers(&stack);
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
            let guess = match transfers(&stack) == taken_before {
                true => guess,
                false => Mask::guess(&stack),
            };
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
    let size = (stack.width(), stack.height());
    let mut truth = None;
    if let Some(index) = plan.truth {
        // What only serves to be compared with stops nothing.
        match load(index).and_then(|bytes| read_truth(&names[index], &bytes, size)) {
            Ok(normals) => {
                let file = base_name(&names[index]).to_owned();
                truth = Some(Truth { file, normals });
            }
            Err(error) => notices.push(Notice::TruthUnread {
                reason: error.to_string(),
            }),
        }
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
        truth: truth.as_ref().map(|truth| truth.file.clone()),
        aligned,
        notices,
    };
    Ok(StackInput {
        stack,
        mask,
        mask_source,
        file_names,
        picked,
        truth,
        plan,
    })
}

/// How the samples of each image are taken.
fn transfers(stack: &ImageStack) -> Vec<Transfer> {
    stack.images().iter().map(|image| image.transfer).collect()
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
        _ => Ok(spread_indices(found, wanted.unwrap_or(found))),
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
