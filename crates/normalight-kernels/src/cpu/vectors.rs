//! Vectors of the widest instruction set that the processor has, chosen at run time.
use pulp::{Arch, MemMask, Simd, WithSimd};

/// Runs an operation with the widest vectors.
pub(crate) fn run<T: WithSimd>(operation: T) -> T::Output {
    #[cfg(test)]
    match tests::LEVEL.get() {
        tests::Level::Widest => {}
        tests::Level::Plain => return operation.with_simd(pulp::Scalar),
        #[cfg(target_arch = "x86_64")]
        tests::Level::Avx2 => {
            if let Some(simd) = pulp::x86::V3::try_new() {
                return Simd::vectorize(simd, operation);
            }
        }
    }
    Arch::new().dispatch(operation)
}

/// Floats of the widest vectors; all others divide them.
pub(crate) const WIDEST: usize = 16;

/// Floats after which values repeated every `channels` floats begin again at the start of a vector: rows of narrow
/// feature maps fill vectors, too.
pub(crate) fn period(channels: usize) -> usize {
    let mut period = channels;
    while !period.is_multiple_of(WIDEST) {
        period += channels;
    }
    period
}

/// Loads and stores of whole vectors and of the rest of a row.
///
/// Everything here is unsafe in the same way: the pointer must be good for the lanes in use.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S: Simd> {
    pub(crate) simd: S,
    mask: MemMask<S::m32s>,
    whole: bool,
}

#[expect(unsafe_code, reason = "vectors are read and written through pointers")]
impl<S: Simd> Lanes<S> {
    /// Access to all lanes, known to the compiler.
    #[inline(always)]
    pub(crate) fn all(simd: S) -> Self {
        const { assert!(WIDEST.is_multiple_of(S::F32_LANES)) };
        Self {
            simd,
            mask: simd.mask_between_m32s(0, S::F32_LANES as u32),
            whole: true,
        }
    }

    /// Access to the first `count` lanes; all of them when there are more.
    #[inline(always)]
    pub(crate) fn new(simd: S, count: usize) -> Self {
        const { assert!(WIDEST.is_multiple_of(S::F32_LANES)) };
        Self {
            simd,
            mask: simd.mask_between_m32s(0, count.min(S::F32_LANES) as u32),
            whole: count >= S::F32_LANES,
        }
    }

    /// # Safety
    /// The lanes in use must lie inside the allocation that `from` points to.
    #[inline(always)]
    pub(crate) unsafe fn load(self, from: *const f32) -> S::f32s {
        // SAFETY: the caller answers for the lanes in use; any bits make floats, and neither way asks for alignment.
        unsafe {
            if self.whole {
                from.cast::<S::f32s>().read_unaligned()
            } else {
                self.simd.mask_load_ptr_f32s(self.mask, from)
            }
        }
    }

    /// # Safety
    /// The lanes in use must lie inside the allocation that `to` points to, which must be writable and not be read or
    /// written by anyone else meanwhile.
    #[inline(always)]
    pub(crate) unsafe fn store(self, to: *mut f32, value: S::f32s) {
        // SAFETY: as in `load`, and the caller answers for exclusive access.
        unsafe {
            if self.whole {
                to.cast::<S::f32s>().write_unaligned(value);
            } else {
                self.simd.mask_store_ptr_f32s(self.mask, to, value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::cpu::convolution;
    use crate::cpu::depthwise::Depthwise;
    use crate::cpu::geometry::Geometry;
    use std::cell::Cell;

    #[derive(Debug, Clone, Copy, PartialEq)]
    pub(super) enum Level {
        Widest,
        #[cfg(target_arch = "x86_64")]
        Avx2,
        Plain,
    }

    thread_local! {
        /// Vectors that this thread uses.
        pub(super) static LEVEL: Cell<Level> = const { Cell::new(Level::Widest) };
    }

    fn wave(count: usize, pace: f32) -> Vec<f32> {
        (0..count).map(|k| (k as f32 * pace).sin()).collect()
    }

    /// Output and gradients of a convolution by Winograd, a strided one and a depthwise one.
    fn everything(level: Level) -> Vec<f32> {
        LEVEL.set(level);
        let mut all = Vec::new();
        for (stride, channels_in, channels_out) in [(1, 20, 9), (2, 5, 19)] {
            let geometry = Geometry {
                batch: 2,
                channels_in,
                channels_out,
                stored_height: 9,
                stored_width: 7,
                zoom: 1,
                size: 3,
                stride,
                origin: -1,
            };
            let input = wave(2 * geometry.image_in(), 0.7);
            let weight = wave(channels_out * geometry.taps(), 0.3);
            let bias = wave(channels_out, 1.1);
            let output = convolution::forward(&geometry, &input, &weight, &bias, 0.1);
            let gradient = wave(output.len(), 0.9);
            let found = convolution::Backward {
                geometry: &geometry,
                input: &input,
                weight: &weight,
                output: &output,
                gradient: &gradient,
                slope: 0.1,
                wants_input: true,
                wants_weight: true,
                wants_bias: true,
            }
            .gradients();
            for part in [output, found.bias] {
                all.extend_from_slice(&part);
            }
            let asked_for = found.input.iter().chain(&found.weight);
            all.extend(asked_for.flat_map(|values| values.iter()));
        }
        let depthwise = Depthwise {
            batch: 2,
            height: 9,
            width: 7,
            channels: 20,
            size: 5,
            stride: 2,
        };
        let (input, weight) = (wave(2 * depthwise.image_in(), 0.7), wave(20 * 25, 0.3));
        let output = depthwise.forward(&input, &weight);
        let gradient = wave(output.len(), 0.9);
        let (grad_input, grad_weight) = depthwise.backward(&input, &weight, &gradient, true);
        for part in [output, grad_input, grad_weight] {
            all.extend_from_slice(&part);
        }
        LEVEL.set(Level::Widest);
        all
    }

    #[test]
    fn every_instruction_set_gives_the_same_numbers() {
        // The level belongs to a thread, so all work is done on one.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        pool.unwrap().install(|| {
            let widest = everything(Level::Widest);
            let mut others = vec![Level::Plain];
            #[cfg(target_arch = "x86_64")]
            others.push(Level::Avx2);
            for level in others {
                let found = everything(level);
                assert_eq!(found.len(), widest.len());
                for (found, expected) in found.into_iter().zip(&widest) {
                    let close = (found - expected).abs() < 1e-4 * expected.abs().max(1.0);
                    assert!(close, "{level:?}: {found} {expected}");
                }
            }
        });
    }
}
