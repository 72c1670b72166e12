use crate::SynthError;
use crate::lanes::{LANES, Lanes, exp};
use glam::Vec3;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use std::sync::Arc;
use zip::ZipArchive;

/// Neurons of a hidden layer.
const HIDDEN: usize = 21;
/// Numbers of one material's network: 6 -> 21 -> 21 -> 3 with biases.
const NUMBERS: usize = 6 * HIDDEN + HIDDEN + HIDDEN * HIDDEN + HIDDEN + HIDDEN * 3 + 3;

/// Most materials of one file, and the bytes they take.
const MOST: u64 = 4096;
const MAX_BYTES: u64 = 4 * NUMBERS as u64 * MOST + 4096;

/// A measured isotropic material, as a small network that was fitted to it (Sztrajman et al. 2021).
///
/// Input: the half and the difference vector of Rusinkiewicz (1998); output: `exp(y) - 1` is the
/// reflectance function for red, green and blue.
#[derive(Debug, Clone)]
pub(crate) struct Measured {
    network: Arc<Network>,
    scattered: Vec3,
}

#[derive(Debug)]
struct Network {
    first: [[f32; HIDDEN]; 6],
    first_bias: [f32; HIDDEN],
    second: [[f32; HIDDEN]; HIDDEN],
    second_bias: [f32; HIDDEN],
    third: [[f32; 3]; HIDDEN],
    third_bias: [f32; 3],
}

impl Measured {
    /// Reads all materials of an `.npz` file with `W`, `[materials, 675]` f32.
    ///
    /// # Errors
    /// The file cannot be read, or holds something else.
    pub(crate) fn read(file: &Path) -> Result<Vec<Self>, SynthError> {
        let failed = |reason| SynthError::File {
            file: file.to_owned(),
            reason,
        };
        let wrong = |found: String| SynthError::Measured {
            file: file.to_owned(),
            found,
            expected: "an .npz file with W, [materials, 675] numbers of 32 bits,",
        };
        let reader = BufReader::new(File::open(file).map_err(failed)?);
        let mut archive =
            ZipArchive::new(reader).map_err(|error| wrong(format!("no archive ({error})")))?;
        let entry = archive
            .by_name("W.npy")
            .map_err(|error| wrong(format!("no readable W ({error})")))?;
        let array = npyz::NpyFile::new(entry.take(MAX_BYTES))
            .map_err(|error| wrong(format!("an unreadable W ({error})")))?;
        let shape = array.shape().to_vec();
        if shape.len() != 2 || shape[1] != NUMBERS as u64 || !(1..=MOST).contains(&shape[0]) {
            return Err(wrong(format!("W of shape {shape:?}")));
        }
        if array.order() != npyz::Order::C {
            return Err(wrong("W in the order of Fortran".to_owned()));
        }
        let numbers: Vec<f32> = array
            .data()
            .map_err(|error| wrong(format!("W with other numbers ({error})")))?
            .collect::<Result<_, _>>()
            .map_err(failed)?;
        if let Some(bad) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(wrong(format!("{bad} in W")));
        }
        Ok(numbers.chunks_exact(NUMBERS).map(Self::new).collect())
    }

    /// From the 675 numbers of a network, layer after layer.
    fn new(numbers: &[f32]) -> Self {
        let mut numbers = numbers.iter().copied();
        let mut next = || numbers.next().unwrap_or(0.0);
        let network = Network {
            first: std::array::from_fn(|_| std::array::from_fn(|_| next())),
            first_bias: std::array::from_fn(|_| next()),
            second: std::array::from_fn(|_| std::array::from_fn(|_| next())),
            second_bias: std::array::from_fn(|_| next()),
            third: std::array::from_fn(|_| std::array::from_fn(|_| next())),
            third_bias: std::array::from_fn(|_| next()),
        };
        // Seen from the front with the lamp at 50 degrees, where most highlights are over.
        let (sin, cos) = (0.766, 0.643f32);
        let half = (0.5 + 0.5 * cos).sqrt();
        let geometry = Geometry {
            to_lamp: [cos; LANES],
            to_half: [half; LANES],
            lamp_to_half: [half; LANES],
            side: [0.0 * sin; LANES],
        };
        let values = network.reflectance(&geometry);
        let scattered = Vec3::from_array(values.map(|lanes| lanes[0] * std::f32::consts::PI));
        Self {
            network: Arc::new(network),
            scattered: scattered.clamp(Vec3::ZERO, Vec3::ONE),
        }
    }

    /// A material of moderate numbers, as fitted networks have them.
    #[cfg(test)]
    pub(crate) fn for_tests(seed: u64) -> Self {
        Self::new(&tests::numbers(seed))
    }

    /// Share of light from all around that is scattered, roughly.
    pub(crate) fn scattered(&self) -> Vec3 {
        self.scattered
    }

    /// The reflectance function in red, green and blue, per steradian.
    #[inline(always)]
    pub(crate) fn reflectance(&self, geometry: &Geometry) -> [Lanes; 3] {
        self.network.reflectance(geometry)
    }
}

/// Where lamp and camera stand relative to the surface.
pub(crate) struct Geometry {
    /// Normal times direction to the lamp.
    pub(crate) to_lamp: Lanes,
    /// Normal times half vector.
    pub(crate) to_half: Lanes,
    /// Lamp times half vector.
    pub(crate) lamp_to_half: Lanes,
    /// Direction to the lamp times (normal x half vector).
    pub(crate) side: Lanes,
}

impl Geometry {
    /// The network's input: half vector (with azimuth 0) and difference vector.
    #[inline(always)]
    fn vectors(&self) -> [Lanes; 6] {
        let mut input = [[0.0; LANES]; 6];
        #[allow(clippy::needless_range_loop)]
        for lane in 0..LANES {
            let height = self.to_half[lane].clamp(-1.0, 1.0);
            let out = (1.0 - height * height).max(1e-8).sqrt();
            let along = self.lamp_to_half[lane].clamp(-1.0, 1.0);
            // The difference vector is the lamp's direction in a frame whose pole is the half vector.
            let x = (along * height - self.to_lamp[lane]) / out;
            let y = self.side[lane] / out;
            // Lamp and camera may change places: then x and y change sign. The networks were fitted with y >= 0.
            let sign = if y < 0.0 { -1.0 } else { 1.0 };
            input[0][lane] = out;
            input[2][lane] = height;
            input[3][lane] = x * sign;
            input[4][lane] = y * sign;
            input[5][lane] = along;
        }
        input
    }
}

impl Network {
    #[inline(always)]
    fn reflectance(&self, geometry: &Geometry) -> [Lanes; 3] {
        let input = geometry.vectors();
        let hidden = layer(&self.first, &self.first_bias, &input);
        let hidden = layer(&self.second, &self.second_bias, &rectified(hidden));
        let output = layer(&self.third, &self.third_bias, &rectified(hidden));
        let mut result = [[0.0; LANES]; 3];
        for (result, output) in result.iter_mut().zip(&output) {
            for lane in 0..LANES {
                result[lane] = (exp(output[lane]) - 1.0).max(0.0);
            }
        }
        result
    }
}

#[inline(always)]
fn layer<const IN: usize, const OUT: usize>(
    weights: &[[f32; OUT]; IN],
    bias: &[f32; OUT],
    input: &[Lanes; IN],
) -> [Lanes; OUT] {
    let mut output = [[0.0; LANES]; OUT];
    for (neuron, output) in output.iter_mut().enumerate() {
        let mut sum = [bias[neuron]; LANES];
        for (weights, input) in weights.iter().zip(input) {
            for lane in 0..LANES {
                sum[lane] += weights[neuron] * input[lane];
            }
        }
        *output = sum;
    }
    output
}

#[inline(always)]
fn rectified(mut values: [Lanes; HIDDEN]) -> [Lanes; HIDDEN] {
    for lanes in &mut values {
        for value in lanes {
            *value = if *value > 0.0 { *value } else { 0.0 };
        }
    }
    values
}

#[cfg(test)]
mod tests;
