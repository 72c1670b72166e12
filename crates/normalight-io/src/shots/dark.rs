//! Photographs without light to speak of: left out.
use crate::IoError;
use crate::input_plan::{LeftOut, LeftOutReason};
use normalight_core::{ImageStack, MIN_IMAGES, Mask, ShotLight};

/// Mean light, as a share of the middle one of all shots, below which a shot is of no use: lamps at the edge of what they
/// light leave a fifth and more, a lamp that did not fire leaves the room's light.
const DARK: f32 = 0.08;

/// Takes shots that are black, or nearly, out of the stack and their positions out of `picked`, unless too few would be left.
///
/// # Errors
/// Those of [`ImageStack::new`].
pub(crate) fn settle(
    stack: &mut ImageStack,
    mask: &Mask,
    picked: &mut Vec<usize>,
) -> Result<Vec<LeftOut>, IoError> {
    let light = ShotLight::new(stack, mask);
    let mut means: Vec<f32> = (0..stack.len()).map(|shot| light.mean(shot)).collect();
    let is_dark: Vec<bool> = {
        let mut sorted = means.clone();
        sorted.sort_by(f32::total_cmp);
        let usual = sorted[sorted.len() / 2];
        means.drain(..).map(|mean| mean < DARK * usual).collect()
    };
    let dark = is_dark.iter().filter(|dark| **dark).count();
    if dark == 0 || stack.len() - dark < MIN_IMAGES {
        return Ok(Vec::new());
    }
    let (mut kept, mut left) = (Vec::new(), Vec::new());
    let mut positions = Vec::new();
    for ((image, &position), dark) in stack.images().iter().zip(picked.iter()).zip(is_dark) {
        if dark {
            left.push(LeftOut::new(&image.name, LeftOutReason::TooDark));
        } else {
            kept.push(image.clone());
            positions.push(position);
        }
    }
    *stack = ImageStack::new(kept)?;
    *picked = positions;
    Ok(left)
}
