//! What stays in a picture when the light moves: where its edges are and along which line they run.
use super::view::Picture;
use rustfft::num_complex::Complex32;

/// Light below this share of the bright parts of a picture counts little: there is only noise.
const DARK: f32 = 0.03;
/// Light of one step of 8 bits, for pictures that are dark altogether.
const STEP: f32 = 1.0 / 255.0;
/// Change of the logarithm of light from one pixel to the next that makes an edge.
const EDGE: f32 = 0.05;

/// One number a pixel, `[height, width]`: its length says how sure there is an edge, 0 to 1, its
/// angle is twice that of the edge, so that an edge which is bright on its other side under another
/// light stays the same.
///
/// The angle of the gradient hardly depends on the light (Chen, Belhumeur and Jacobs, CVPR 2000);
/// the logarithm makes bright and dim lamps alike. The border is zero.
pub(super) fn edges(picture: &Picture) -> Vec<Complex32> {
    let (width, height) = (picture.width, picture.height);
    let bright = bright_value(&picture.light);
    if bright <= 0.0 {
        return vec![Complex32::ZERO; picture.light.len()];
    }
    let floor = DARK + STEP / bright;
    let mut logs: Vec<f32> = picture
        .light
        .iter()
        .map(|&light| libm::logf(light / bright + floor))
        .collect();
    smooth(&mut logs, width, height);
    let mut field = vec![Complex32::ZERO; logs.len()];
    for y in 1..height.saturating_sub(1) {
        for x in 1..width.saturating_sub(1) {
            let at = y * width + x;
            let right = (logs[at + 1] - logs[at - 1]) / 2.0;
            let down = (logs[at + width] - logs[at - width]) / 2.0;
            let gradient = Complex32::new(right, down);
            field[at] = gradient * gradient / (gradient.norm_sqr() + EDGE * EDGE);
        }
    }
    field
}

/// The value that one in a hundred exceeds.
pub(super) fn bright_value(values: &[f32]) -> f32 {
    let mut values = values.to_vec();
    let place = (values.len() * 99 / 100).min(values.len() - 1);
    *values.select_nth_unstable_by(place, f32::total_cmp).1
}

/// Binomial filter of 3 x 3, the border repeated.
fn smooth(values: &mut [f32], width: usize, height: usize) {
    let filtered = |before: f32, here: f32, after: f32| (before + 2.0 * here + after) / 4.0;
    for row in values.chunks_exact_mut(width) {
        let mut before = row[0];
        for x in 0..width {
            let after = row[(x + 1).min(width - 1)];
            let here = row[x];
            row[x] = filtered(before, here, after);
            before = here;
        }
    }
    let mut above: Vec<f32> = values[..width].to_vec();
    for y in 0..height {
        for x in 0..width {
            let below = values[(y + 1).min(height - 1) * width + x];
            let here = values[y * width + x];
            values[y * width + x] = filtered(above[x], here, below);
            above[x] = here;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_the_same_from_either_side_and_at_any_brightness() {
        let picture = |left: f32, right: f32| Picture {
            width: 20,
            height: 12,
            light: (0..240)
                .map(|at| if at % 20 < 10 { left } else { right })
                .collect(),
        };
        let one = edges(&picture(0.2, 0.8));
        let other = edges(&picture(0.8, 0.2));
        let middle = 6 * 20 + 10;
        // The gradient points along x: twice its angle is 0, or a full turn.
        assert!(one[middle].re > 0.9 && one[middle].im.abs() < 1e-6);
        assert!((one[middle] - other[middle]).norm() < 1e-3);
        assert!(one[6 * 20 + 4].norm() < 1e-6);
        let black = edges(&picture(0.0, 0.0));
        assert!(black.iter().all(|value| *value == Complex32::ZERO));
    }
}
