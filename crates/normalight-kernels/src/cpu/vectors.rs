//! Vectors of the widest instruction set that the processor has, chosen at run time.
use pulp::{Arch, MemMask, Simd, WithSimd};

/// Runs an operation with the widest vectors.
pub(crate) fn run<T: WithSimd>(operation: T) -> T::Output {
    #[cfg(test)]
    if tests::PLAIN.get() {
        return operation.with_simd(pulp::Scalar);
    }
    Arch::new().dispatch(operation)
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
        Self {
            simd,
            mask: simd.mask_between_m32s(0, S::F32_LANES as u32),
            whole: true,
        }
    }

    /// Access to the first `count` lanes; all of them when there are more.
    #[inline(always)]
    pub(crate) fn new(simd: S, count: usize) -> Self {
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
        unsafe {
            if self.whole {
                from.cast::<S::f32s>().read_unaligned()
            } else {
                self.simd.mask_load_ptr_f32s(self.mask, from)
            }
        }
    }

    /// # Safety
    /// As [`Self::load`].
    #[inline(always)]
    pub(crate) unsafe fn store(self, to: *mut f32, value: S::f32s) {
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
pub(crate) mod tests {
    use std::cell::Cell;

    thread_local! {
        /// Whether this thread does without vector instructions.
        pub(crate) static PLAIN: Cell<bool> = const { Cell::new(false) };
    }
}
