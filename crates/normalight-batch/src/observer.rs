use crate::{Capture, Found, Row};
use std::time::{Duration, Instant};

/// Hears how a batch goes on, in the thread that called [`run_batch`](crate::run_batch).
pub trait BatchObserver {
    /// The tree was walked; `mine` of its captures are this shard's.
    fn found(&mut self, _found: &Found, _mine: usize) {}
    /// A capture is estimated now. Those whose results are current are finished without this.
    fn started(&mut self, _capture: &Capture) {}
    /// A capture is finished, one way or another.
    fn finished(&mut self, _row: &Row, _progress: &Progress) {}
    /// Something about the whole batch that a person should know.
    fn noticed(&mut self, _words: &str) {}
}

/// Nobody hears.
impl BatchObserver for () {}

/// How far a batch is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Captures finished, one way or another.
    pub done: usize,
    /// Captures of this shard.
    pub total: usize,
    /// Of those finished, those that failed.
    pub failed: usize,
    /// Since the beginning.
    pub elapsed: Duration,
    /// Time left if all other captures have to be estimated and take as long for each photograph as those before; `None`
    /// before the first was estimated.
    pub left: Option<Duration>,
}

/// Counts what is done.
pub(crate) struct Count {
    start: Instant,
    done: usize,
    failed: usize,
    total: usize,
    /// When the first capture had to be estimated.
    first: Option<Instant>,
    /// Photographs of captures that were estimated, and of those that are not finished.
    estimated: f64,
    open: f64,
}

impl Count {
    /// Of captures with so many photographs each.
    pub(crate) fn new(weights: &[f64]) -> Self {
        Self {
            start: Instant::now(),
            done: 0,
            failed: 0,
            total: weights.len(),
            first: None,
            estimated: 0.0,
            open: weights.iter().sum(),
        }
    }

    pub(crate) fn started(&mut self) {
        self.first.get_or_insert_with(Instant::now);
    }

    /// A capture of so many photographs is finished.
    pub(crate) fn finished(&mut self, weight: f64, was_estimated: bool, has_failed: bool) {
        self.done += 1;
        self.failed += usize::from(has_failed);
        self.open -= weight;
        if was_estimated {
            self.estimated += weight;
        }
    }

    pub(crate) fn progress(&self) -> Progress {
        let seconds = |first: Instant| {
            let each = first.elapsed().as_secs_f64() / self.estimated;
            Duration::try_from_secs_f64(each * self.open.max(0.0)).ok()
        };
        Progress {
            done: self.done,
            total: self.total,
            failed: self.failed,
            elapsed: self.start.elapsed(),
            left: self
                .first
                .filter(|_| self.estimated > 0.0)
                .and_then(seconds),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_left_is_known_after_the_first_and_none_at_the_end() {
        let mut count = Count::new(&[10.0, 10.0, 20.0]);
        count.finished(10.0, false, false);
        assert_eq!(count.progress().left, None);
        count.started();
        count.finished(10.0, true, true);
        let progress = count.progress();
        assert_eq!((progress.done, progress.failed, progress.total), (2, 1, 3));
        assert!(progress.left.is_some());
        count.finished(20.0, true, false);
        assert_eq!(count.progress().left, Some(Duration::ZERO));
    }
}
