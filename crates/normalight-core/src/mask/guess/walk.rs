//! Labels that agree with their neighbours where nothing parts them: the random walker with prior
//! models (Grady 2005), the minimum of sum w (x_p - x_q)^2 + sum pull (x_p - target_p)^2.

/// Steps of the solver; 0.5 is far from both labels, so that a rough solution does.
const STEPS: usize = 300;
const TOLERANCE: f64 = 1e-6;

/// What joins two places, and how strongly.
pub(super) struct Joint {
    pub(super) ends: [usize; 2],
    pub(super) weight: f32,
}

/// Where a place wants to be, and how strongly.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pull {
    pub(super) target: f32,
    pub(super) weight: f32,
}

/// The minimum, by conjugate gradients with the diagonal as preconditioner.
pub(super) fn walk(joints: &[Joint], pulls: &[Pull]) -> Vec<f32> {
    let mut diagonal: Vec<f32> = pulls.iter().map(|pull| pull.weight).collect();
    for joint in joints {
        for end in joint.ends {
            diagonal[end] += joint.weight;
        }
    }
    let product = |x: &[f32], out: &mut [f32]| {
        for ((out, x), pull) in out.iter_mut().zip(x).zip(pulls) {
            *out = pull.weight * x;
        }
        for Joint {
            ends: [a, b],
            weight,
        } in joints
        {
            let flow = weight * (x[*a] - x[*b]);
            out[*a] += flow;
            out[*b] -= flow;
        }
    };
    let mut found: Vec<f32> = pulls.iter().map(|pull| pull.target).collect();
    let mut image = vec![0.0; found.len()];
    product(&found, &mut image);
    let wanted = pulls.iter().map(|pull| pull.weight * pull.target);
    let mut rest: Vec<f32> = wanted
        .zip(&image)
        .map(|(wanted, &has)| wanted - has)
        .collect();
    let mut ahead: Vec<f32> = rest.iter().zip(&diagonal).map(|(r, d)| r / d).collect();
    let mut direction = ahead.clone();
    let mut length = dot(&rest, &ahead);
    let enough = TOLERANCE * length;
    for _ in 0..STEPS {
        if length <= enough {
            break;
        }
        product(&direction, &mut image);
        let step = (length / dot(&direction, &image)) as f32;
        for k in 0..found.len() {
            found[k] += step * direction[k];
            rest[k] -= step * image[k];
            ahead[k] = rest[k] / diagonal[k];
        }
        let next = dot(&rest, &ahead);
        let turn = (next / length) as f32;
        length = next;
        for (direction, ahead) in direction.iter_mut().zip(&ahead) {
            *direction = ahead + turn * *direction;
        }
    }
    found
}

fn dot(a: &[f32], b: &[f32]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| f64::from(*a) * f64::from(*b))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without a pull between two fixed ends, a chain falls evenly from one to the other.
    #[test]
    fn a_chain_between_two_ends_falls_evenly() {
        let joint = |a: usize| Joint {
            ends: [a, a + 1],
            weight: 0.7,
        };
        let joints: Vec<Joint> = (0..10).map(joint).collect();
        let pull = |k: usize| Pull {
            target: if k == 0 { 1.0 } else { 0.0 },
            weight: if k.is_multiple_of(10) { 1e5 } else { 0.0 },
        };
        let pulls: Vec<Pull> = (0..11).map(pull).collect();
        for (k, found) in walk(&joints, &pulls).into_iter().enumerate() {
            assert!(
                (found - (1.0 - k as f32 / 10.0)).abs() < 1e-3,
                "{k}: {found}"
            );
        }
    }
}
