//! The photographs of a plan, decoded and brought to one size and side.
use crate::decode::{Stored, decode_stored, turned_mask};
use crate::format::base_name;
use crate::input_plan::{LeftOut, LeftOutReason};
use crate::plan::StackPlan;
use crate::turn::{swaps_sides, turned};
use crate::{IoError, Limits, Notice, ReadOptions};
use image::metadata::Orientation;
use normalight_core::{MIN_IMAGES, Mask, Samples, StackImage, on_all_cores};

/// Files that are in memory beside what they decode to.
const AT_ONCE: usize = 8;

/// The decoded photographs and what was found out on the way.
pub(super) struct Shots {
    pub(super) images: Vec<StackImage>,
    /// Their positions in the plan.
    pub(super) picked: Vec<usize>,
    /// Those of another size.
    pub(super) left_out: Vec<LeftOut>,
    /// What each file says about its samples.
    pub(super) stated: Vec<Option<String>>,
    pub(super) alpha: Option<Mask>,
    pub(super) notices: Vec<Notice>,
}

/// Decodes the picked photographs, `load` handing out each file's bytes once; those of another size than most are left
/// out, and all are turned upright alike.
pub(super) fn read_shots(
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
    // The first one by itself: it forecasts how much memory all need.
    let (first, others) = picked.split_at(picked.len().min(1));
    for positions in std::iter::once(first).chain(others.chunks(AT_ONCE)) {
        let mut files = Vec::with_capacity(positions.len());
        for &position in positions {
            let index = plan.images[position];
            files.push((&names[index], load(index)?));
        }
        let decoded = on_all_cores(files.len(), |file| {
            let (name, bytes) = &files[file];
            decode_stored(name, bytes, options.color, &options.limits)
        });
        for (decoded, (name, _)) in decoded.into_iter().zip(&files) {
            let Stored {
                image,
                alpha: transparent,
                orientation,
                stated: says,
                notices: more,
            } = decoded?;
            let image = StackImage {
                name: base_name(name).to_owned(),
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
