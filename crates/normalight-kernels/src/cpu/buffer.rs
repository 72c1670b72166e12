//! Memory that is used again: a training step asks for the same buffers as the one before it, and fresh pages from
//! the system would cost more than many of the operations that fill them.
use burn_std::{AccessError, AccessPolicy, AllocationController, AllocationProperty, Bytes};
use std::collections::BTreeMap;
use std::mem::MaybeUninit;
use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A cache line, so that vectors do not straddle two of them.
#[repr(C, align(64))]
#[derive(Clone, Copy)]
struct Line([f32; LINE]);

const LINE: usize = 16;

/// Most lines that lie unused unless a limit is set: a gigabyte, in the browser an eighth of one.
const KEPT: usize = if cfg!(target_family = "wasm") {
    1 << 21
} else {
    1 << 24
};

/// Sets how many bytes of buffers at most are kept for the next operation that needs such memory (by default 1 GiB, in
/// the browser 128 MiB), and gives back what is above. With 0, every buffer goes back to the system at once.
pub fn limit_kept_memory(bytes: usize) {
    let mut unused = unused();
    let limit = bytes / size_of::<Line>();
    unused.limit = limit;
    unused.shrink(limit);
}

/// Gives all memory back that is kept for later operations, which will ask the system for it again. The limit stays.
pub fn release_kept_memory() {
    unused().shrink(0);
}

/// Buffers given back.
struct Unused {
    /// By their number of lines; among equals the last one given back comes first, as it may still be in the cache.
    stacks: BTreeMap<usize, Vec<Vec<Line>>>,
    /// Lines of all buffers together.
    total: usize,
    /// Most lines that are kept.
    limit: usize,
}

static UNUSED: Mutex<Unused> = Mutex::new(Unused {
    stacks: BTreeMap::new(),
    total: 0,
    limit: KEPT,
});

/// The common store, also after a panic elsewhere: nothing in it is left half done.
fn unused() -> MutexGuard<'static, Unused> {
    UNUSED.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Unused {
    /// One of at least that many lines; a much larger one is better kept for those who need it.
    fn take(&mut self, needed: usize) -> Option<Vec<Line>> {
        let fitting = self.stacks.range_mut(needed..=2 * needed + 64);
        let lines = fitting.filter_map(|(_, stack)| stack.pop()).next()?;
        self.total -= lines.len();
        Some(lines)
    }

    fn put(&mut self, lines: Vec<Line>) {
        self.total += lines.len();
        self.stacks.entry(lines.len()).or_default().push(lines);
        self.shrink(self.limit);
    }

    /// Drops the largest until at most so many lines are left.
    fn shrink(&mut self, limit: usize) {
        while self.total > limit {
            match self.stacks.pop_last() {
                Some((size, stack)) => self.total -= size * stack.len(),
                None => break,
            }
        }
    }
}

/// Floats that go back to a common store when dropped.
pub(crate) struct Buffer {
    lines: Vec<Line>,
    length: usize,
}

impl Buffer {
    /// A buffer whose values are left from earlier use: every one must be written.
    pub(crate) fn recycled(length: usize) -> Self {
        let needed = length.div_ceil(LINE);
        let found = unused().take(needed);
        let lines = found.unwrap_or_else(|| vec![Line([0.0; LINE]); needed]);
        Self { lines, length }
    }

    /// A buffer of zeros.
    pub(crate) fn zeros(length: usize) -> Self {
        let mut buffer = Self::recycled(length);
        buffer.fill(0.0);
        buffer
    }

    /// The floats as a tensor's storage.
    pub(crate) fn into_bytes(self) -> Bytes {
        let bytes = size_of::<f32>() * self.length;
        #[expect(unsafe_code, reason = "the only way to storage of our own")]
        // SAFETY: all floats of a buffer are initialised.
        unsafe {
            Bytes::from_controller(Box::new(self), bytes)
        }
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        let lines = std::mem::take(&mut self.lines);
        if lines.is_empty() {
            return;
        }
        unused().put(lines);
    }
}

impl Deref for Buffer {
    type Target = [f32];

    fn deref(&self) -> &[f32] {
        #[expect(unsafe_code, reason = "lines are floats side by side")]
        // SAFETY: the lines hold at least `length` initialised floats without gaps (`repr(C)`).
        unsafe {
            std::slice::from_raw_parts(self.lines.as_ptr().cast(), self.length)
        }
    }
}

impl DerefMut for Buffer {
    fn deref_mut(&mut self) -> &mut [f32] {
        #[expect(unsafe_code, reason = "lines are floats side by side")]
        // SAFETY: as in `deref`, and the borrow is exclusive.
        unsafe {
            std::slice::from_raw_parts_mut(self.lines.as_mut_ptr().cast(), self.length)
        }
    }
}

impl AllocationController for Buffer {
    fn alloc_align(&self) -> usize {
        align_of::<Line>()
    }

    fn property(&self) -> AllocationProperty {
        AllocationProperty::Other
    }

    #[expect(unsafe_code, reason = "the trait's signature")]
    unsafe fn memory_mut(
        &mut self,
        _policy: AccessPolicy,
    ) -> Result<&mut [MaybeUninit<u8>], AccessError> {
        let floats: &mut [f32] = self;
        let bytes = size_of_val(floats);
        // SAFETY: the same memory; the caller writes only initialised bytes, and any bytes make floats.
        Ok(unsafe { std::slice::from_raw_parts_mut(floats.as_mut_ptr().cast(), bytes) })
    }

    fn memory(&self, _policy: AccessPolicy) -> Result<&[MaybeUninit<u8>], AccessError> {
        let floats: &[f32] = self;
        #[expect(unsafe_code, reason = "floats seen as bytes")]
        // SAFETY: the same memory, all of it initialised.
        Ok(unsafe { std::slice::from_raw_parts(floats.as_ptr().cast(), size_of_val(floats)) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(count: usize) -> Vec<Line> {
        vec![Line([0.0; LINE]); count]
    }

    /// A store of its own: the common one is used by other tests meanwhile.
    #[test]
    fn no_more_is_kept_than_the_limit_allows() {
        let mut unused = Unused {
            stacks: BTreeMap::new(),
            total: 0,
            limit: 100,
        };
        for count in [40, 10, 30, 10] {
            unused.put(lines(count));
        }
        assert_eq!(unused.total, 90);
        // The largest goes first.
        unused.put(lines(20));
        assert_eq!(unused.total, 70);
        assert_eq!(unused.take(25).map(|lines| lines.len()), Some(30));
        assert_eq!(unused.total, 40);
        unused.shrink(0);
        assert_eq!(unused.total, 0);
        assert!(unused.take(10).is_none());
        unused.limit = 0;
        unused.put(lines(5));
        assert_eq!(unused.total, 0);
    }
}
