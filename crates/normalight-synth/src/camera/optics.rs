use super::visible::Visible;

/// Furthest neighbour that a kernel reaches, in pixels.
const REACH: usize = 5;
const TAPS: usize = 2 * REACH + 1;

/// Weights of a line of pixels: a shift by a fraction of a pixel and a Gaussian blur in one.
pub(crate) struct Kernel([f32; TAPS]);

impl Kernel {
    /// Shift and deviation in pixels, -2..=2 and 0..=1.
    pub(crate) fn new(shift: f32, deviation: f32) -> Self {
        let mut taps = [0.0; TAPS];
        let whole = shift.floor();
        for (neighbour, share) in [(whole, 1.0 - (shift - whole)), (whole + 1.0, shift - whole)] {
            for (index, tap) in taps.iter_mut().enumerate() {
                let offset = index as f32 - REACH as f32 - neighbour;
                *tap += share * gaussian(offset, deviation);
            }
        }
        let sum: f32 = taps.iter().sum();
        Self(taps.map(|tap| tap / sum))
    }
}

fn gaussian(offset: f32, deviation: f32) -> f32 {
    if deviation < 0.05 {
        return f32::from(u8::from(offset == 0.0));
    }
    let deviations = offset / deviation;
    libm::expf(-0.5 * deviations * deviations)
}

/// Replaces every visible pixel by the weighted mean of the visible ones around: what is beside the
/// object is not known and must not darken it.
pub(crate) fn blurred(light: &mut [f32], visible: &Visible, across: &Kernel, along: &Kernel) {
    let weights = spread(visible, None, across, along);
    for plane in light.chunks_exact_mut(visible.pixels.len()) {
        let sums = spread(visible, Some(plane), across, along);
        for (value, &pixel) in plane.iter_mut().zip(visible.pixels) {
            let weight = weights[pixel as usize];
            if weight > 1e-3 {
                *value = sums[pixel as usize] / weight;
            }
        }
    }
}

/// Both kernels over a picture of the given values (ones by default) with zeros around.
fn spread(visible: &Visible, values: Option<&[f32]>, across: &Kernel, along: &Kernel) -> Vec<f32> {
    let size = visible.size;
    let mut picture = vec![0.0; size * size];
    for (index, &pixel) in visible.pixels.iter().enumerate() {
        picture[pixel as usize] = values.map_or(1.0, |values| values[index]);
    }
    let mut rows = vec![0.0; size * size];
    for (row, line) in rows.chunks_exact_mut(size).zip(picture.chunks_exact(size)) {
        for (tap, &weight) in across
            .0
            .iter()
            .enumerate()
            .filter(|(_, weight)| **weight != 0.0)
        {
            let shift = tap as isize - REACH as isize;
            let (to, from) = overlap(size, shift);
            let count = size - shift.unsigned_abs().min(size);
            for (sum, value) in row[to..to + count]
                .iter_mut()
                .zip(&line[from..from + count])
            {
                *sum += weight * value;
            }
        }
    }
    let mut result = vec![0.0; size * size];
    for (tap, &weight) in along
        .0
        .iter()
        .enumerate()
        .filter(|(_, weight)| **weight != 0.0)
    {
        let shift = tap as isize - REACH as isize;
        let (to, from) = overlap(size, shift);
        let count = size * (size - shift.unsigned_abs().min(size));
        let (to, from) = (to * size, from * size);
        for (sum, value) in result[to..to + count]
            .iter_mut()
            .zip(&rows[from..from + count])
        {
            *sum += weight * value;
        }
    }
    result
}

/// Where lines begin that lie `shift` apart: (target, source).
fn overlap(size: usize, shift: isize) -> (usize, usize) {
    let shift = shift.clamp(-(size as isize), size as isize);
    ((-shift).max(0) as usize, shift.max(0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_shifts_move_the_picture() {
        let size = 16;
        let pixels: Vec<u32> = (0..256).collect();
        let visible = Visible {
            size,
            pixels: &pixels,
        };
        let picture: Vec<f32> = (0..256).map(|pixel| (pixel % 7) as f32).collect();
        let mut moved = picture.clone();
        blurred(
            &mut moved,
            &visible,
            &Kernel::new(1.0, 0.0),
            &Kernel::new(-2.0, 0.0),
        );
        for row in 2..16 {
            for column in 0..15 {
                let expected = picture[(row - 2) * 16 + column + 1];
                assert!((moved[row * 16 + column] - expected).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn blurring_spreads_a_point_by_its_deviation_and_keeps_flat_fields() {
        let size = 21;
        let pixels: Vec<u32> = (0..21 * 21).collect();
        let visible = Visible {
            size,
            pixels: &pixels,
        };
        let mut flat = vec![0.3; 21 * 21];
        let kernel = || Kernel::new(0.3, 0.7);
        blurred(&mut flat, &visible, &kernel(), &kernel());
        assert!(flat.iter().all(|value| (value - 0.3).abs() < 1e-5));

        let mut point = vec![0.0; 21 * 21];
        point[10 * 21 + 10] = 1.0;
        let unshifted = || Kernel::new(0.0, 0.7);
        blurred(&mut point, &visible, &unshifted(), &unshifted());
        let spread: f32 = (0..21 * 21)
            .map(|pixel| point[pixel] * (pixel as f32 % 21.0 - 10.0).powi(2))
            .sum();
        assert!((spread.sqrt() - 0.7).abs() < 0.02, "{}", spread.sqrt());
    }

    #[test]
    fn what_is_beside_the_object_does_not_darken_it() {
        let pixels: Vec<u32> = (0..64).filter(|pixel| pixel % 8 < 4).collect();
        let visible = Visible {
            size: 8,
            pixels: &pixels,
        };
        let mut light = vec![0.5; pixels.len()];
        blurred(
            &mut light,
            &visible,
            &Kernel::new(0.4, 0.5),
            &Kernel::new(0.0, 0.5),
        );
        assert!(light.iter().all(|value| (value - 0.5).abs() < 1e-5));
    }
}
