//! Batches made ahead on threads of their own.
use crate::{Failure, RunError};
use std::sync::mpsc::{Receiver, sync_channel};

/// Batches made ahead, at least.
const AHEAD: usize = 6;

/// Makes the batches of a run, each from the number of its step alone: batch `k` is the same whatever
/// was made before, so that a resumed run sees the samples that an uninterrupted one would have seen.
pub trait BatchMaker: Send + 'static {
    /// What the learner takes in at one step.
    type Batch: Send + 'static;

    /// What can go wrong with it.
    type Error: Failure;

    /// One like this for another thread.
    fn for_thread(&self) -> Self;

    /// Steps in a row that share costly work and are best made by one thread.
    fn together(&self) -> usize;

    /// The batch of a step, from 0.
    ///
    /// # Errors
    /// Files that cannot be read, objects that do not fit the recipe.
    fn make(&mut self, step: usize) -> Result<Self::Batch, Self::Error>;
}

/// The batches of a run in their order.
///
/// Groups of steps go round the threads; each has a bounded queue of its own, so neither the order nor
/// the batches depend on how many threads there are or how fast.
pub struct Batches<B, E> {
    queues: Vec<Receiver<Result<B, E>>>,
    together: usize,
    step: usize,
}

impl<B: Send + 'static, E: Failure> Batches<B, E> {
    /// Starts to make the batches of the steps from `first` to before `end`; the first error ends a
    /// thread.
    pub fn start<M>(maker: &M, threads: usize, first: usize, end: usize) -> Self
    where
        M: BatchMaker<Batch = B, Error = E>,
    {
        let together = maker.together().max(1);
        let queues = (0..threads)
            .map(|thread| {
                let (sender, receiver) = sync_channel(together.max(AHEAD.div_ceil(threads)));
                let mut maker = maker.for_thread();
                std::thread::spawn(move || {
                    for step in (first..end).filter(|step| step / together % threads == thread) {
                        let batch = maker.make(step);
                        let failed = batch.is_err();
                        // The receiver is gone when training stopped: nothing left to do.
                        if sender.send(batch).is_err() || failed {
                            return;
                        }
                    }
                });
                receiver
            })
            .collect();
        Self {
            queues,
            together,
            step: first,
        }
    }

    /// The batch of the next step.
    ///
    /// # Errors
    /// What the maker met, or [`RunError::Loader`] when its thread is gone.
    pub fn take_next(&mut self) -> Result<B, E> {
        let thread = self.step / self.together % self.queues.len();
        self.step += 1;
        self.queues[thread].recv().map_err(|_| RunError::Loader)?
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;
    use std::sync::{Arc, Mutex};
    use std::thread::{ThreadId, current};

    /// Remembers which thread made which group; the first steps take longest.
    #[derive(Clone, Default)]
    struct Squares(Arc<Mutex<HashMap<usize, ThreadId>>>);

    impl BatchMaker for Squares {
        type Batch = usize;
        type Error = RunError;

        fn for_thread(&self) -> Self {
            self.clone()
        }

        fn together(&self) -> usize {
            4
        }

        fn make(&mut self, step: usize) -> Result<usize, RunError> {
            if step < 12 {
                std::thread::sleep(std::time::Duration::from_millis(12 - step as u64));
            }
            let mut groups = self.0.lock().unwrap();
            assert_eq!(
                *groups.entry(step / 4).or_insert(current().id()),
                current().id()
            );
            if step == 90 {
                return Err(RunError::Plot("stop".into()));
            }
            Ok(step * step)
        }
    }

    #[test]
    fn order_and_batches_do_not_depend_on_the_threads() {
        for threads in [1, 2, 5, 40] {
            let maker = Squares::default();
            let mut batches = Batches::start(&maker, threads, 7, 100);
            for step in 7..90 {
                assert_eq!(batches.take_next().unwrap(), step * step);
            }
            assert_eq!(batches.take_next().unwrap_err().to_string(), "curves: stop");
            let groups = maker.0.lock().unwrap();
            let used: std::collections::HashSet<_> = groups.values().collect();
            assert_eq!(used.len(), threads.min(groups.len()));
        }
    }

    #[test]
    fn nothing_is_made_beyond_the_queues() {
        let maker = Squares::default();
        let mut batches = Batches::start(&maker, 2, 0, 1_000_000);
        batches.take_next().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(200));
        // Four or so waiting in each queue and one in the hands of each thread.
        assert!(maker.0.lock().unwrap().len() <= 4);
    }
}
