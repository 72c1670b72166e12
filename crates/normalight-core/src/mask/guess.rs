use super::Mask;
use crate::ImageStack;

impl Mask {
    /// A first guess where no mask is given: pixels that some light brightens (Otsu's threshold on
    /// the square root of the brightest value over all images), the largest connected part of
    /// them, holes filled.
    ///
    /// The square root spreads the dark values, where object and background part.
    pub fn guess(stack: &ImageStack) -> Self {
        let roots: Vec<f32> = stack.brightest().iter().map(|value| value.sqrt()).collect();
        let threshold = otsu_threshold(&roots);
        let inside = roots.iter().map(|&value| value > threshold).collect();
        Self::new(stack.width(), stack.height(), inside)
            .largest_component()
            .holes_filled()
    }
}

/// Threshold that parts values best into two classes (Otsu 1979), on 256 bins of their range.
fn otsu_threshold(values: &[f32]) -> f32 {
    let (low, high) = values
        .iter()
        .fold((f32::MAX, f32::MIN), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
    if high <= low {
        // One value only: nothing to part, so everything lit counts as object.
        return if high > 0.0 { low - 1.0 } else { high };
    }
    let mut histogram = [0usize; 256];
    let scale = 255.0 / (high - low);
    for &value in values {
        histogram[((value - low) * scale) as usize] += 1;
    }
    let total = values.len() as f64;
    let sum: f64 = (0..256).map(|bin| bin as f64 * histogram[bin] as f64).sum();
    let (mut below, mut sum_below) = (0.0, 0.0);
    let (mut best_bin, mut best_spread) = (0, -1.0);
    for (bin, &count) in histogram.iter().enumerate().take(255) {
        below += count as f64;
        sum_below += bin as f64 * count as f64;
        let above = total - below;
        if below == 0.0 || above == 0.0 {
            continue;
        }
        let difference = sum_below / below - (sum - sum_below) / above;
        let spread = below * above * difference * difference;
        if spread > best_spread {
            (best_bin, best_spread) = (bin, spread);
        }
    }
    low + (best_bin as f32 + 1.0) / scale
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn otsu_parts_two_groups() {
        let mut values = vec![0.1; 700];
        values.extend(vec![0.8; 300]);
        let threshold = otsu_threshold(&values);
        assert!(threshold > 0.1 && threshold < 0.8, "{threshold}");
        assert!(otsu_threshold(&[0.0, 0.0]) >= 0.0);
        assert!(otsu_threshold(&[0.5, 0.5]) < 0.5);
    }
}
