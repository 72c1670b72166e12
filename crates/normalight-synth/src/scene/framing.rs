use crate::random::Random;
use crate::recipe::ShapeRecipe;
use crate::shapes::{Detail, Object, View, Window};

/// Longer side in pixels of the first look at a whole object, which finds where it is.
const SCOUT: usize = 32;

/// Shows the whole object in a square of `side` pixels.
pub(crate) fn frame(
    object: &Object,
    recipe: &ShapeRecipe,
    random: &mut Random,
    side: usize,
) -> View {
    let inverse_distance = if random.chance(recipe.perspective_share) {
        let [low, high] = recipe.camera_distance;
        // The object's size is twice its reach.
        1.0 / (random.log_range(low, high) * 2.0 * object.reach())
    } else {
        0.0
    };
    let margin = random.range(recipe.margin[0], recipe.margin[1]);
    // Seen from nearby the front looks larger.
    let extent = object.extent() / (1.0 - inverse_distance * object.reach());
    let pitch = 2.0 * extent.max_element() / SCOUT as f32;
    let scout = object.view(
        Window {
            left: -extent.x,
            top: extent.y,
            pitch,
            width: (2.0 * extent.x / pitch + 1.0) as usize,
            height: (2.0 * extent.y / pitch + 1.0) as usize,
            inverse_distance,
        },
        Detail::Depth,
    );
    let (x, y, longer) = bounds(&scout).unwrap_or((0.0, 0.0, 1.0));
    let mut longer = longer / (1.0 - 2.0 * margin);
    loop {
        let window = Window::square(x, y, longer, side, inverse_distance);
        let view = object.view(window, Detail::All);
        // The coarse scout may have overlooked a thin tip, which must not be cut off; a window that holds
        // everything can only be touched in tiny pictures.
        if !touches_border(&view) || longer > 3.0 * extent.max_element() {
            return view;
        }
        longer *= 1.08;
    }
}

fn touches_border(view: &View) -> bool {
    let (width, height) = (view.window.width, view.window.height);
    (0..view.depth.len()).any(|pixel| {
        let (row, column) = (pixel / width, pixel % width);
        let border = row == 0 || column == 0 || row + 1 == height || column + 1 == width;
        border && view.is_inside(pixel)
    })
}

/// Centre and longer side of what is seen.
fn bounds(view: &View) -> Option<(f32, f32, f32)> {
    let (window, width) = (view.window, view.window.width);
    let (mut left, mut right, mut top, mut bottom) = (usize::MAX, 0, usize::MAX, 0);
    for pixel in (0..view.depth.len()).filter(|&pixel| view.is_inside(pixel)) {
        let (row, column) = (pixel / width, pixel % width);
        left = left.min(column);
        right = right.max(column);
        top = top.min(row);
        bottom = bottom.max(row);
    }
    if left == usize::MAX {
        return None;
    }
    let x = (window.x(left) + window.x(right)) / 2.0;
    let y = (window.y(top) + window.y(bottom)) / 2.0;
    let side = (right - left).max(bottom - top) + 1;
    Some((x, y, side as f32 * window.pitch))
}
