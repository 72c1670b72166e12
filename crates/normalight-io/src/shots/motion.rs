//! A camera that moved, and photographs of other things.
use crate::notice::some_names;
use crate::{IoError, Notice};
use normalight_core::{
    ImageStack, Mask, Registration, ShotLight, keep_seen, register_shots, translated,
};

/// Smallest shorter side of the object, in pixels, where anything can be said.
const SMALLEST: usize = 48;
/// Certainty from which a shift is refused, said, and repaired where that was asked for. Measured on
/// rendered and photographed stacks: a still camera, of any object, at most 7 with 12 lights and more
/// (13 with five); shifts of
/// a hundredth of the object 9 to 36, of a fiftieth 16 to 80, larger ones up to 100.
const SURE: f32 = 24.0;
const LIKELY: f32 = 9.0;
const REPAIRED_FROM: f32 = 4.0;
/// Shifts that are said: pixels, and the share of the object's longer side. Three of twelve shots
/// moved by 1 pixel cost half a degree to one and a half on rendered objects of 150 pixels.
const SAID: (f32, f32) = (0.7, 1.0 / 500.0);
/// Shifts that are refused. There 2 pixels cost 1 to 4 degrees, 4 pixels 2 to 12, 8 pixels up to 20.
const REFUSED: (f32, f32) = (2.5, 1.0 / 80.0);
/// Objects less lit than this show highlights alone, which wander as nothing but the object should.
const MIRROR: f32 = 0.03;
/// Smallest shift that is repaired, in pixels.
const REPAIRED: f32 = 0.2;
/// Share of the photographs that must show the same thing.
const ALIKE: f32 = 0.6;

/// Says what moved and what shows something else; with `align` shifts are repaired instead, what
/// is not seen in all shots leaves the mask, and the largest shift is returned.
///
/// # Errors
/// [`IoError::DifferentObjects`]; [`IoError::CameraMoved`] without `align`.
pub(crate) fn settle(
    stack: &mut ImageStack,
    mask: &mut Mask,
    align: bool,
    notices: &mut Vec<Notice>,
) -> Result<Option<f32>, IoError> {
    let unmoved = align.then_some(0.0);
    let Some(area) = mask.bounding_box() else {
        return Ok(unmoved);
    };
    if area.width.min(area.height) < SMALLEST {
        return Ok(unmoved);
    }
    let found = register_shots(stack, mask);
    let names = |shots: &[usize]| -> Vec<String> {
        let images = stack.images();
        shots
            .iter()
            .map(|&shot| images[shot].name.clone())
            .collect()
    };
    check_groups(&found, &names, notices)?;
    if ShotLight::new(stack, mask).lit_share() < MIRROR {
        return Ok(unmoved);
    }
    if align {
        return Ok(Some(repair(stack, mask, &found)?));
    }
    let side = area.width.max(area.height) as f32;
    let above = |(pixels, share): (f32, f32)| pixels.max(share * side);
    let moved: Vec<usize> = (0..stack.len())
        .filter(|&shot| found.shifts[shot].certainty > LIKELY)
        .filter(|&shot| found.shifts[shot].pixels() > above(SAID))
        .collect();
    let sure = |shot: &&usize| found.shifts[**shot].certainty > SURE;
    let pixels_of = |shots: &mut dyn Iterator<Item = &usize>| {
        let shifts = shots.map(|&shot| found.shifts[shot].pixels());
        shifts.fold(0.0, f32::max)
    };
    let pixels = pixels_of(&mut moved.iter());
    let limit = above(REFUSED);
    if pixels_of(&mut moved.iter().filter(sure)) > limit {
        return Err(IoError::CameraMoved {
            files: some_names(&names(&moved)),
            pixels,
            limit,
        });
    }
    if !moved.is_empty() {
        let files = names(&moved);
        notices.push(Notice::CameraMoved { files, pixels });
    }
    Ok(None)
}

fn check_groups(
    found: &Registration,
    names: &dyn Fn(&[usize]) -> Vec<String>,
    notices: &mut Vec<Notice>,
) -> Result<(), IoError> {
    let compared: usize = found.groups.iter().map(Vec::len).sum();
    let [largest, others @ ..] = &found.groups[..] else {
        return Ok(());
    };
    if others.is_empty() || compared < 3 {
        return Ok(());
    }
    if (largest.len() as f32) < ALIKE * compared as f32 {
        let groups = found.groups.iter().map(|group| some_names(&names(group)));
        return Err(IoError::DifferentObjects {
            count: found.groups.len(),
            groups: groups.collect::<Vec<_>>().join("; "),
        });
    }
    notices.push(Notice::Unlike {
        files: names(&others.concat()),
    });
    Ok(())
}

/// Moves shots back; the largest shift.
fn repair(stack: &mut ImageStack, mask: &mut Mask, found: &Registration) -> Result<f32, IoError> {
    let (mut images, mut most) = (Vec::with_capacity(stack.len()), 0.0f32);
    for (image, shot) in stack.images().iter().zip(&found.shifts) {
        if shot.certainty < REPAIRED_FROM || shot.pixels() < REPAIRED {
            images.push(image.clone());
            continue;
        }
        images.push(translated(image, shot.shift));
        *mask = keep_seen(mask, shot.shift);
        most = most.max(shot.pixels());
    }
    *stack = ImageStack::new(images)?;
    stack.check_mask(mask, "the mask without what a moved shot does not show")?;
    Ok(most)
}
