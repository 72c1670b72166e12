//! Arithmetic on sixteen numbers at a time, in loops that the compiler turns into vector instructions.
//!
//! Nothing here is reordered or fused, so that the results are the same bits with any instruction set.

/// Numbers handled together.
pub(crate) const LANES: usize = 16;

pub(crate) type Lanes = [f32; LANES];

/// Runs loops with the widest vector instructions the processor has. Whatever `work` calls must be marked
/// `#[inline(always)]` to be part of it.
#[inline(always)]
pub(crate) fn vectorised<T>(work: impl FnOnce() -> T) -> T {
    #[cfg(test)]
    if tests::PLAIN.get() {
        return work();
    }
    pulp::Arch::new().dispatch(work)
}

/// `count` rounded up to whole lanes.
pub(crate) fn padded(count: usize) -> usize {
    count.next_multiple_of(LANES)
}

/// The lanes of a padded plane that begin at `start`.
#[inline(always)]
pub(crate) fn lanes(plane: &[f32], start: usize) -> &Lanes {
    let (chunk, _) = plane[start..].as_chunks();
    &chunk[0]
}

#[inline(always)]
pub(crate) fn lanes_mut(plane: &mut [f32], start: usize) -> &mut Lanes {
    let (chunk, _) = plane[start..].as_chunks_mut();
    &mut chunk[0]
}

/// e to the power of `x` within 2e-7 of itself, by arithmetic alone; `x` is limited to -80..80.
#[inline(always)]
pub(crate) fn exp(x: f32) -> f32 {
    let x = x.clamp(-80.0, 80.0);
    // x = whole * ln 2 + rest, with ln 2 in two parts so that the product is exact.
    let whole = (x * std::f32::consts::LOG2_E + 128.5) as i32 - 128;
    let count = whole as f32;
    let rest = x - count * 0.693_359_4 + count * 2.121_944_4e-4;
    // Taylor to the seventh power; |rest| <= 0.35.
    let mut power = 1.0 / 5040.0;
    for factor in [
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        0.5,
        1.0,
        1.0,
    ] {
        power = power * rest + factor;
    }
    power * f32::from_bits(((whole + 127) << 23) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Framing, Preset, Renderer};
    use std::cell::Cell;

    thread_local! {
        /// Whether this thread does without special instructions.
        pub(super) static PLAIN: Cell<bool> = const { Cell::new(false) };
    }

    #[test]
    fn vector_instructions_change_no_bit() {
        let renderer = Renderer::new(Preset::World.recipe()).unwrap();
        for number in 0..30 {
            let samples = [false, true].map(|plain| {
                PLAIN.set(plain);
                let samples = [Framing::WholeObject, Framing::Crop]
                    .map(|framing| renderer.sample(number, 4, 40, framing).images);
                PLAIN.set(false);
                samples.map(|images| images.into_iter().map(f32::to_bits).collect::<Vec<_>>())
            });
            assert!(samples[0] == samples[1], "sample {number}");
        }
    }

    #[test]
    fn exponential_is_that_of_the_library() {
        for step in -7900..7900 {
            let x = step as f32 * 0.01 + 0.003;
            let expected = f64::from(x).exp();
            let relative = (f64::from(exp(x)) / expected - 1.0).abs();
            assert!(relative < 3e-7, "exp({x}): {relative}");
        }
    }
}
