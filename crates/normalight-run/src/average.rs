//! The exponential moving average of a network's numbers.
use crate::named_tensors::NamedTensors;

/// Weights averaged over the last steps: they generalise better than those of any one step.
#[derive(Debug)]
pub struct Average {
    decay: f32,
    /// By name.
    pub values: NamedTensors,
}

impl Average {
    /// `decay`: share of the average that a step leaves; 0 gives none.
    pub fn new(decay: f32, values: NamedTensors) -> Option<Self> {
        (decay > 0.0).then_some(Self { decay, values })
    }

    /// Takes in the numbers after step `step` (from 1). The first steps count more than the decay
    /// says, so that the random start is forgotten quickly.
    pub fn add(&mut self, step: usize, now: &NamedTensors) {
        let share = (1.0 + step as f32) / (10.0 + step as f32);
        let kept = self.decay.min(share);
        for (name, average) in &mut self.values {
            let Some(now) = now.get(name) else { continue };
            for (average, now) in average.iter_mut().zip(now) {
                *average += (1.0 - kept) * (now - *average);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tensors(value: f32) -> NamedTensors {
        NamedTensors::from([("a".to_owned(), vec![value])])
    }

    #[test]
    fn it_follows_and_forgets_the_start() {
        assert!(Average::new(0.0, tensors(1.0)).is_none());
        let mut average = Average::new(0.999, tensors(100.0)).unwrap();
        for step in 1..=300 {
            average.add(step, &tensors(1.0));
        }
        let value = average.values["a"][0];
        assert!((value - 1.0).abs() < 1e-3, "{value}");
        // Later a step moves it by one part in a thousand.
        average.add(1_000_000, &tensors(2.0));
        let moved = average.values["a"][0] - value;
        assert!((moved - 1e-3).abs() < 1e-4, "{moved}");
    }
}
