//! One network on several devices: each computes the gradients of a part of the batch.
//!
//! This is Burn's data-parallel strategy with a main device (`MultiDevice` of its own training
//! loop), made of the same pieces: the network is forked to every device, and the gradients of the
//! replicas move to the main device and are added up. In Burn's other strategy the devices reduce
//! the gradients among themselves; it knows CUDA only, so no test of ours could run it, and our
//! networks are small enough to travel at every step.

mod parts;

use crate::batch::Batch;
use crate::task::Task;
use burn::module::{Module, ModuleVisitor, Param};
use burn::optim::GradientsParams;
use burn::tensor::{Device, Gradients, Tensor};
use normalight_run::scalar;
use parts::{divided, shares};
use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

/// Several devices that compute the gradients of one network together.
///
/// Batch normalisation sees a part of the batch at a time, and the statistics that stay are those of
/// the main device's parts.
pub(crate) struct Replicas<T: Task> {
    task: T,
    main: Device,
    workers: Vec<Worker<T::Network>>,
}

/// A device besides the main one, with a thread as long as the run: GPU streams and their memory
/// belong to threads.
struct Worker<N> {
    jobs: Sender<ReplicaJob<N>>,
    results: Receiver<PartResult>,
    thread: JoinHandle<()>,
}

struct ReplicaJob<N> {
    network: N,
    part: Batch,
    share: f32,
}

struct PartResult {
    loss: f32,
    /// On the main device.
    gradients: GradientsParams,
}

impl<T: Task> Replicas<T> {
    /// Starts a thread for each of `others`. The network lives on `main`, which the calling thread
    /// keeps busy. Gradients must be switched on on every device.
    pub(crate) fn new(task: &T, main: &Device, others: &[Device]) -> Self {
        let start = |device: &Device| start(task.clone(), main.clone(), device.clone());
        Self {
            task: task.clone(),
            main: main.clone(),
            workers: others.iter().map(start).collect(),
        }
    }

    /// Loss of a batch and its gradients for `network`: those that the main device would have found
    /// alone, up to rounding. Sums are taken in the order of the devices, whoever is done first.
    ///
    /// # Panics
    /// When the computation on a device does, like one on the main device.
    pub(crate) fn gradients(&mut self, network: &T::Network, batch: &Batch) -> (f32, Gradients) {
        let mut parts = shares::<T>(divided(batch, self.workers.len() + 1)).into_iter();
        let Some((own, share)) = parts.next() else {
            unreachable!("recipes with empty batches are refused");
        };
        let busy = parts.len();
        for (worker, (part, share)) in self.workers.iter().zip(parts) {
            // A clone would share the running statistics of batch normalisation, and forking it
            // would move them away from the main device; a validation snapshot has its own.
            let network = network.valid();
            // A thread that is gone is noticed when its result is wanted.
            let _ = worker.jobs.send(ReplicaJob {
                network,
                part,
                share,
            });
        }
        let loss = self.task.loss(network, &own, &self.main) * share;
        let mut gradients = loss.backward();
        let mut loss = scalar(loss);
        for index in 0..busy {
            let Ok(result) = self.workers[index].results.recv() else {
                panic_like(self.workers.swap_remove(index));
            };
            loss += result.loss;
            network.visit(&mut Adder {
                sum: &mut gradients,
                part: result.gradients,
            });
        }
        (loss, gradients)
    }
}

/// Computes on a device until nobody has jobs for it any more.
fn start<T: Task>(task: T, main: Device, device: Device) -> Worker<T::Network> {
    let (jobs, todo) = channel::<ReplicaJob<T::Network>>();
    let (done, results) = channel();
    let thread = std::thread::spawn(move || {
        for spec in todo {
            let replica = spec.network.fork(&device).train();
            let loss = task.loss(&replica, &spec.part, &device) * spec.share;
            let gradients = GradientsParams::from_grads(loss.backward(), &replica);
            let result = PartResult {
                loss: scalar(loss),
                gradients: gradients.to_device(&main, &replica),
            };
            if done.send(result).is_err() {
                return;
            }
        }
    });
    Worker {
        jobs,
        results,
        thread,
    }
}

/// Continues the panic of a thread that ended before its result.
fn panic_like<N>(worker: Worker<N>) -> ! {
    match worker.thread.join() {
        Err(panic) => resume_unwind(panic),
        Ok(()) => unreachable!("the thread ends only without jobs or with a panic"),
    }
}

/// Adds the gradients of a part to the sum.
struct Adder<'a> {
    sum: &'a mut Gradients,
    part: GradientsParams,
}

impl ModuleVisitor for Adder<'_> {
    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        let Some(part) = self.part.remove::<D>(param.id) else {
            return;
        };
        let weights = param.val();
        let sum = match weights.grad(self.sum) {
            Some(sum) => sum + part,
            None => part,
        };
        weights.grad_replace(self.sum, sum);
    }
}

#[cfg(test)]
mod tests;
