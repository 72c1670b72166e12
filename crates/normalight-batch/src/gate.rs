//! Jobs side by side within a limit of memory.
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How often who waits looks whether waiting has an end.
const LOOK: Duration = Duration::from_millis(100);

/// Lets jobs in, in the order in which they come, as long as all inside take no more than a limit. Who is alone is always
/// let in.
pub(crate) struct Gate {
    limit: u64,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    /// Bytes of those inside, and how many they are.
    used: u64,
    inside: usize,
    /// The next number to be handed out, and the next to be let in: nobody waits for ever because smaller ones pass.
    next: u64,
    front: u64,
}

/// A job's place inside, until it is dropped.
pub(crate) struct Place<'a> {
    gate: &'a Gate,
    bytes: u64,
}

impl Gate {
    /// With a limit in bytes; `None` lets all in.
    pub(crate) fn new(limit: Option<u64>) -> Self {
        Self {
            limit: limit.unwrap_or(u64::MAX),
            state: Mutex::default(),
            changed: Condvar::new(),
        }
    }

    /// Waits for a place; `None` once `stop` is set.
    pub(crate) fn enter(&self, bytes: u64, stop: &AtomicBool) -> Option<Place<'_>> {
        let mut state = self.state();
        let number = state.next;
        state.next += 1;
        loop {
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            let fits = state.used.saturating_add(bytes) <= self.limit;
            if state.front == number && (fits || state.inside == 0) {
                state.front += 1;
                state.used = state.used.saturating_add(bytes);
                state.inside += 1;
                self.changed.notify_all();
                return Some(Place { gate: self, bytes });
            }
            let waited = self.changed.wait_timeout(state, LOOK);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // The numbers are right even after a panic elsewhere.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        let mut state = self.gate.state();
        state.used = state.used.saturating_sub(self.bytes);
        state.inside -= 1;
        self.gate.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicU64;
    use std::thread;

    #[test]
    fn never_more_than_the_limit_inside_but_one_alone() {
        let (gate, stop) = (Gate::new(Some(10)), AtomicBool::new(false));
        let (used, inside, alone) = (AtomicU64::new(0), AtomicU64::new(0), AtomicU64::new(0));
        thread::scope(|scope| {
            for bytes in [4, 4, 30, 2, 7, 9, 1, 3, 12, 5] {
                let (gate, stop, used, inside, alone) = (&gate, &stop, &used, &inside, &alone);
                scope.spawn(move || {
                    let _place = gate.enter(bytes, stop).unwrap();
                    let all = used.fetch_add(bytes, Ordering::SeqCst) + bytes;
                    let count = inside.fetch_add(1, Ordering::SeqCst) + 1;
                    assert!(all <= 10 || count == 1, "{all} bytes in {count} jobs");
                    alone.fetch_add(u64::from(bytes > 10), Ordering::SeqCst);
                    thread::yield_now();
                    inside.fetch_sub(1, Ordering::SeqCst);
                    used.fetch_sub(bytes, Ordering::SeqCst);
                });
            }
        });
        assert_eq!(alone.into_inner(), 2);
    }

    #[test]
    fn who_waits_is_sent_away_at_the_end() {
        let (gate, stop) = (Gate::new(Some(1)), AtomicBool::new(false));
        let _inside = gate.enter(1, &stop).unwrap();
        thread::scope(|scope| {
            let waiting = scope.spawn(|| gate.enter(1, &stop).is_none());
            stop.store(true, Ordering::Relaxed);
            assert!(waiting.join().unwrap());
        });
    }
}
