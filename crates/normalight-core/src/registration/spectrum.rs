//! Two-dimensional Fourier transforms of small complex fields.
use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;

/// Transforms of one size. A spectrum lies transposed, `[width, height]`: nobody looks at its
/// pixels, and it saves two turns.
pub(super) struct Transform {
    pub(super) width: usize,
    pub(super) height: usize,
    along_rows: [Arc<dyn Fft<f32>>; 2],
    along_columns: [Arc<dyn Fft<f32>>; 2],
}

impl Transform {
    /// For fields of at least this size; the transform's own is a little larger, of small factors.
    pub(super) fn at_least(width: usize, height: usize) -> Self {
        let (width, height) = (quick_length(width), quick_length(height));
        let mut planner = FftPlanner::new();
        let mut both = |length| {
            [
                planner.plan_fft_forward(length),
                planner.plan_fft_inverse(length),
            ]
        };
        Self {
            width,
            height,
            along_rows: both(width),
            along_columns: both(height),
        }
    }

    /// Number of values of a field and of its spectrum.
    pub(super) fn len(&self) -> usize {
        self.width * self.height
    }

    /// Spectrum `[width, height]` of a field `[height, width]`.
    pub(super) fn forward(&self, mut field: Vec<Complex32>) -> Vec<Complex32> {
        self.along_rows[0].process(&mut field);
        let mut spectrum = transposed(&field, self.width);
        self.along_columns[0].process(&mut spectrum);
        spectrum
    }

    /// The real parts of the fields `[height, width]` of one or two spectra, without the factor of 1 / (width * height), by
    /// one transform; of one spectrum, the second is empty.
    pub(super) fn real_inverse(&self, spectra: &[Vec<Complex32>]) -> [Vec<f32>; 2] {
        let parts = |field: &[Complex32], part: fn(&Complex32) -> f32| -> Vec<f32> {
            field.iter().map(part).collect()
        };
        let [first, second] = spectra else {
            let alone = spectra.first().map(|first| self.inverse(first.clone()));
            let alone = alone.unwrap_or_default();
            return [parts(&alone, |value| value.re), Vec::new()];
        };
        let both = self.inverse(spectrum_of_two([first, second], self.height));
        let mut fields = [
            parts(&both, |value| value.re),
            parts(&both, |value| value.im),
        ];
        for (field, spectrum) in fields.iter_mut().zip(spectra) {
            // Nothing stays nothing, without the rounding of the other.
            if spectrum.iter().all(|value| *value == Complex32::ZERO) {
                field.fill(0.0);
            }
        }
        fields
    }

    /// Field `[height, width]` of a spectrum, without the factor of 1 / (width * height).
    fn inverse(&self, mut spectrum: Vec<Complex32>) -> Vec<Complex32> {
        self.along_columns[1].process(&mut spectrum);
        let mut field = transposed(&spectrum, self.height);
        self.along_rows[1].process(&mut field);
        field
    }
}

/// The spectrum of the real part of the first field and, times i, of the second's: one transform brings both back.
fn spectrum_of_two([first, second]: [&[Complex32]; 2], height: usize) -> Vec<Complex32> {
    let width = first.len() / height;
    let mut both = Vec::with_capacity(first.len());
    for x in 0..width {
        let line = |spectrum| line(spectrum, x, height);
        let opposite = |spectrum| self::line(spectrum, (width - x) % width, height);
        let (a, a_opposite) = (line(first), opposite(first));
        let (b, b_opposite) = (line(second), opposite(second));
        for y in 0..height {
            let y_opposite = if y == 0 { 0 } else { height - y };
            // Twice the part of a spectrum that is a real field's.
            let real_a = a[y] + a_opposite[y_opposite].conj();
            let real_b = b[y] + b_opposite[y_opposite].conj();
            both.push(Complex32::new(real_a.re - real_b.im, real_a.im + real_b.re) * 0.5);
        }
    }
    both
}

/// The entries of one frequency across.
fn line(spectrum: &[Complex32], x: usize, height: usize) -> &[Complex32] {
    &spectrum[x * height..(x + 1) * height]
}

fn transposed(field: &[Complex32], width: usize) -> Vec<Complex32> {
    // A few columns at a time, so that what is written stays in the cache.
    const COLUMNS: usize = 16;
    let height = field.len() / width;
    let mut turned = vec![Complex32::ZERO; field.len()];
    for left in (0..width).step_by(COLUMNS) {
        let right = (left + COLUMNS).min(width);
        for (y, row) in field.chunks_exact(width).enumerate() {
            for x in left..right {
                turned[x * height + y] = row[x];
            }
        }
    }
    turned
}

/// The next even length whose factors are 2, 3 and 5.
fn quick_length(least: usize) -> usize {
    let quick = |&length: &usize| {
        let mut rest = length;
        for factor in [2, 3, 5] {
            while rest.is_multiple_of(factor) {
                rest /= factor;
            }
        }
        rest == 1
    };
    let mut even = (least.max(2)..).filter(|length| length.is_multiple_of(2));
    even.find(quick).unwrap_or(least)
}

/// Frequency of each entry of a transform of this length, in cycles per pixel, -0.5 to 0.5.
pub(super) fn frequencies(length: usize) -> impl Iterator<Item = f64> {
    (0..length).map(move |index| {
        let signed = match 2 * index < length {
            true => index as f64,
            false => index as f64 - length as f64,
        };
        signed / length as f64
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_wave_is_one_entry_and_comes_back() {
        let transform = Transform::at_least(11, 7);
        assert_eq!((transform.width, transform.height), (12, 8));
        // Two waves across, three down.
        let wave = |index: usize| {
            let (x, y) = ((index % 12) as f32, (index / 12) as f32);
            let turn = std::f32::consts::TAU * (2.0 * x / 12.0 + 3.0 * y / 8.0);
            Complex32::new(turn.cos(), turn.sin())
        };
        let field: Vec<Complex32> = (0..96).map(wave).collect();
        let spectrum = transform.forward(field.clone());
        for (index, value) in spectrum.iter().enumerate() {
            let expected = if index == 2 * 8 + 3 { 96.0 } else { 0.0 };
            assert!((value.norm() - expected).abs() < 1e-3, "{index}: {value}");
        }
        for (found, expected) in transform.inverse(spectrum).iter().zip(&field) {
            assert!((found / 96.0 - expected).norm() < 1e-5);
        }
        // Of any two spectra, not those of real fields, the same as one by one.
        let noise = |seed: usize| -> Vec<Complex32> {
            let value = |at: usize| ((at * 7919 + seed * 104_729) % 1013) as f32 / 1013.0 - 0.5;
            (0..96)
                .map(|at| Complex32::new(value(at), value(at + 500)))
                .collect()
        };
        let spectra = [noise(1), noise(2)];
        let both = transform.real_inverse(&spectra);
        for (found, spectrum) in both.iter().zip(&spectra) {
            let [alone, _] = transform.real_inverse(std::slice::from_ref(spectrum));
            assert_eq!(found.len(), alone.len());
            for (found, alone) in found.iter().zip(alone) {
                assert!((found - alone).abs() < 1e-4);
            }
        }
        let third = frequencies(12).nth(2).unwrap();
        assert!((third - 2.0 / 12.0).abs() < 1e-12);
        assert_eq!(frequencies(8).nth(6), Some(-0.25));
    }
}
