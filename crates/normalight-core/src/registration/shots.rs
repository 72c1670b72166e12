//! Edges of some shots as whitened spectra, to be laid over each other.
use super::edges::edges;
use super::spectrum::{Transform, frequencies};
use super::view::Picture;
use crate::on_all_cores;
use rustfft::num_complex::Complex32;

/// Shifts up to this share of a picture's shorter side are looked for; larger than the first only where the fit stands out
/// by so many deviations more, since what the light does to edges never goes that far.
const NEAR: usize = 6;
const FAR: usize = 3;
const STANDS_OUT: f32 = 10.0;

/// Width of the Gaussian that keeps the finest frequencies small, in pixels.
const BLUR: f64 = 0.7;
/// Spectra smaller than this hold nothing.
const NOTHING: f32 = 1e-12;

/// Share of clear edges below which a picture shows little but noise.
const VAGUE: f32 = 0.01;
/// Places between the pixels at which a fit is evaluated, along each axis, and the distance between
/// them in pixels.
const FINE: usize = 7;
/// Those of one axis side by side, a whole number of registers.
const LANES: usize = 8;
const SPACING: f32 = 0.125;

/// Whitened spectra of the edges of shots of one size, each of unit energy or zero.
pub(super) struct Spectra {
    transform: Transform,
    /// Largest shift that is looked for, in pixels, and the largest of those that are usual.
    range: usize,
    near: i64,
    spectra: Vec<Vec<Complex32>>,
    /// Share of each shot's pixels that are clear edges.
    clear: Vec<f32>,
}

/// How well one spectrum fits another over all shifts.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Fit {
    /// The best shift: right, down; in pixels, to a fraction.
    pub(super) shift: [f32; 2],
    /// How far the fit at the best shift stands out, in deviations of the fit over all shifts.
    pub(super) best: f32,
    /// The same without a shift.
    pub(super) unmoved: f32,
}

impl Spectra {
    /// Of `count` pictures of one size.
    pub(super) fn new(
        (count, picture): (usize, impl Fn(usize) -> Picture + Sync + Send),
        size: [usize; 2],
    ) -> Self {
        let [width, height] = size;
        let range = (width.min(height) / FAR).max(4);
        let near = (width.min(height) / NEAR).max(4);
        // The empty border keeps usual shifts from meeting the other side; of larger ones a part does, as noise.
        let transform = Transform::at_least(width + near, height + near);
        let of_shot = |shot: usize| {
            let picture = picture(shot);
            let edges = edges(&picture);
            let clear = edges.iter().filter(|edge| edge.norm_sqr() > 0.25).count();
            let share = clear as f32 / edges.len() as f32;
            (whitened(&transform, &edges, picture.width), share)
        };
        let (spectra, clear) = on_all_cores(count, of_shot).into_iter().unzip();
        Self {
            transform,
            range,
            near: near as i64,
            spectra,
            clear,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.spectra.len()
    }

    /// Whether a shot has no edge at all.
    pub(super) fn is_empty(&self, shot: usize) -> bool {
        self.spectra[shot]
            .iter()
            .all(|value| *value == Complex32::ZERO)
    }

    /// Whether a shot has too few clear edges to say what it shows.
    pub(super) fn is_vague(&self, shot: usize) -> bool {
        self.clear[shot] < VAGUE
    }

    pub(super) fn zeros(&self) -> Vec<Complex32> {
        vec![Complex32::ZERO; self.transform.len()]
    }

    /// Adds `sign` times a shot, moved back by its shift, to a sum.
    pub(super) fn add(&self, sum: &mut [Complex32], shot: usize, shift: [f32; 2], sign: f32) {
        let height = self.transform.height;
        let across = turn(self.transform.width, shift[0]);
        let down = turn(height, shift[1]);
        let lines = sum
            .chunks_exact_mut(height)
            .zip(self.spectra[shot].chunks_exact(height));
        for ((sums, values), across) in lines.zip(across) {
            let across = across * sign;
            for ((sum, value), down) in sums.iter_mut().zip(values).zip(&down) {
                *sum += value * across * down;
            }
        }
    }

    /// How a shot fits a sum of others.
    pub(super) fn fit(&self, reference: &[Complex32], shot: usize) -> Fit {
        let product = [self.product(reference, shot)];
        let [surface, _] = self.transform.real_inverse(&product);
        self.fit_of(&product[0], &surface)
    }

    /// How one or two shots fit a sum in which each lies itself, moved back by its shift: without its own part.
    pub(super) fn fits_to_others(
        &self,
        sum: &[Complex32],
        shots: &[usize],
        shifts: &[[f32; 2]],
    ) -> Vec<Fit> {
        let products = shots
            .iter()
            .map(|&shot| self.product_with_others(sum, shot, shifts[shot]));
        let products: Vec<Vec<Complex32>> = products.collect();
        let surfaces = self.transform.real_inverse(&products);
        let pairs = products.iter().zip(&surfaces);
        pairs
            .map(|(product, surface)| self.fit_of(product, surface))
            .collect()
    }

    fn product_with_others(
        &self,
        sum: &[Complex32],
        shot: usize,
        shift: [f32; 2],
    ) -> Vec<Complex32> {
        let height = self.transform.height;
        let across = turn(self.transform.width, shift[0]);
        let down = turn(height, shift[1]);
        let lines = sum
            .chunks_exact(height)
            .zip(self.spectra[shot].chunks_exact(height));
        let mut product = Vec::with_capacity(sum.len());
        for ((sums, values), across) in lines.zip(across) {
            let entries = sums.iter().zip(values).zip(&down);
            product.extend(
                entries.map(|((sum, value), down)| (sum - value * across * down).conj() * value),
            );
        }
        product
    }

    /// The best fit by the product of two spectra and its value at each shift.
    fn fit_of(&self, product: &[Complex32], surface: &[f32]) -> Fit {
        let deviation = deviation(surface);
        if deviation <= NOTHING {
            return Fit::default();
        }
        let (width, height) = (self.transform.width, self.transform.height);
        let at = |x: i64, y: i64| {
            let (x, y) = (x.rem_euclid(width as i64), y.rem_euclid(height as i64));
            surface[y as usize * width + x as usize]
        };
        let (mut best, mut place) = (at(0, 0), (0, 0));
        let mut far = (best, place);
        let range = self.range as i64;
        for y in -range..=range {
            let row = y.rem_euclid(height as i64) as usize * width;
            let row = &surface[row..row + width];
            // Shifts to the left stand at the end of a row.
            let ends = [(-range, width - self.range..width), (0, 0..self.range + 1)];
            for (first, part) in ends {
                for (x, &value) in (first..).zip(&row[part]) {
                    let is_near = x.abs().max(y.abs()) <= self.near;
                    if is_near && value > best {
                        (best, place) = (value, (x, y));
                    }
                    if value > far.0 {
                        far = (value, (x, y));
                    }
                }
            }
        }
        if far.0 > best + STANDS_OUT * deviation {
            (best, place) = far;
        }
        let (x, y) = place;
        let near = [
            x as f32 + summit(at(x - 1, y), best, at(x + 1, y)),
            y as f32 + summit(at(x, y - 1), best, at(x, y + 1)),
        ];
        Fit {
            shift: self.refined(product, near),
            best: best / deviation,
            unmoved: at(0, 0) / deviation,
        }
    }

    /// How far the best fit of each of one or two pairs of shots stands out over all shifts, however large, and how many
    /// pixels away it is.
    pub(super) fn likenesses(&self, pairs: &[[usize; 2]]) -> Vec<(f32, f32)> {
        let products = pairs
            .iter()
            .map(|&[a, b]| self.product(&self.spectra[a], b));
        let surfaces = self.transform.real_inverse(&products.collect::<Vec<_>>());
        let surfaces = surfaces.iter().take(pairs.len());
        surfaces.map(|surface| self.likeness_of(surface)).collect()
    }

    fn likeness_of(&self, surface: &[f32]) -> (f32, f32) {
        let (mut best, mut place) = (0.0, 0);
        for (at, &value) in surface.iter().enumerate() {
            if value > best {
                (best, place) = (value, at);
            }
        }
        let around = |place: usize, length: usize| place.min(length - place) as f32;
        let width = self.transform.width;
        let away = around(place % width, width).hypot(around(place / width, self.transform.height));
        match deviation(surface) {
            deviation if deviation > NOTHING => (best / deviation, away),
            _ => (0.0, 0.0),
        }
    }

    fn product(&self, reference: &[Complex32], shot: usize) -> Vec<Complex32> {
        let pairs = reference.iter().zip(&self.spectra[shot]);
        pairs.map(|(a, b)| a.conj() * b).collect()
    }

    /// The best shift near another, from the fit at places between the pixels (Guizar-Sicairos,
    /// Thurman and Fienup 2008): a parabola through whole pixels alone is drawn to them.
    fn refined(&self, product: &[Complex32], near: [f32; 2]) -> [f32; 2] {
        let (width, height) = (self.transform.width, self.transform.height);
        let offset = |place: usize| (place as f32 - (FINE / 2) as f32) * SPACING;
        // All places beside each other, so that they are summed side by side.
        let turns = |axis: usize, length: usize| -> Vec<[[f32; LANES]; 2]> {
            let mut all = vec![[[0.0; LANES]; 2]; length];
            for place in 0..FINE {
                let turns = turn(length, near[axis] + offset(place));
                for (lanes, turn) in all.iter_mut().zip(turns) {
                    (lanes[0][place], lanes[1][place]) = (turn.re, turn.im);
                }
            }
            all
        };
        let (across, down) = (turns(0, width), turns(1, height));
        let mut fine = [[0.0f32; LANES]; FINE];
        for (line, [across_re, across_im]) in product.chunks_exact(height).zip(&across) {
            let (mut re, mut im) = ([0.0f32; LANES], [0.0f32; LANES]);
            for (value, [down_re, down_im]) in line.iter().zip(&down) {
                for lane in 0..LANES {
                    re[lane] += value.re * down_re[lane] - value.im * down_im[lane];
                    im[lane] += value.re * down_im[lane] + value.im * down_re[lane];
                }
            }
            for (y, row) in fine.iter_mut().enumerate() {
                for (lane, value) in row.iter_mut().enumerate() {
                    *value += re[y] * across_re[lane] - im[y] * across_im[lane];
                }
            }
        }
        let places = (0..FINE * FINE).map(|at| (at % FINE, at / FINE));
        let highest = places.max_by(|a, b| fine[a.1][a.0].total_cmp(&fine[b.1][b.0]));
        let (x, y) = highest.unwrap_or_default();
        let along = |place: usize, at: &dyn Fn(usize) -> f32| match place {
            0 => 0.0,
            last if last == FINE - 1 => 0.0,
            _ => summit(at(place - 1), at(place), at(place + 1)) * SPACING,
        };
        [
            near[0] + offset(x) + along(x, &|x| fine[y][x]),
            near[1] + offset(y) + along(y, &|y| fine[y][x]),
        ]
    }
}

/// The factors of a spectrum's entries along one axis that undo a shift.
fn turn(length: usize, shift: f32) -> Vec<Complex32> {
    let turns = frequencies(length).map(|frequency| {
        let (sine, cosine) = libm::sincos(std::f64::consts::TAU * frequency * f64::from(shift));
        Complex32::new(cosine as f32, sine as f32)
    });
    turns.collect()
}

/// Standard deviation of a correlation over all shifts.
fn deviation(surface: &[f32]) -> f32 {
    let count = surface.len() as f64;
    let sum: f64 = surface.iter().map(|&value| f64::from(value)).sum();
    let squares: f64 = surface.iter().map(|&value| f64::from(value).powi(2)).sum();
    (squares / count - (sum / count).powi(2)).max(0.0).sqrt() as f32
}

/// Where the parabola through three neighbours is highest, from the middle one, -0.5 to 0.5.
fn summit(before: f32, here: f32, after: f32) -> f32 {
    let bend = before - 2.0 * here + after;
    match bend < 0.0 {
        true => (0.5 * (before - after) / bend).clamp(-0.5, 0.5),
        false => 0.0,
    }
}

/// The spectrum of edges with its amplitudes nearly levelled (to their power of 1/4: all
/// of phase correlation's sharpness would be all of the noise, too), of unit energy.
fn whitened(transform: &Transform, edges: &[Complex32], width: usize) -> Vec<Complex32> {
    let mut field = vec![Complex32::ZERO; transform.len()];
    let lines = field.chunks_exact_mut(transform.width);
    for (line, row) in lines.zip(edges.chunks_exact(width)) {
        line[..width].copy_from_slice(row);
    }
    let mut spectrum = transform.forward(field);
    // Half of the Gaussian on each of the two spectra of a product.
    let gauss = |frequency: f64| {
        let exponent = (std::f64::consts::PI * BLUR * frequency).powi(2);
        libm::exp(-exponent) as f32
    };
    let across: Vec<f32> = frequencies(transform.width).map(gauss).collect();
    let down: Vec<f32> = frequencies(transform.height).map(gauss).collect();
    let mut energy = 0.0;
    for (line, across) in spectrum.chunks_exact_mut(transform.height).zip(across) {
        for (value, down) in line.iter_mut().zip(&down) {
            let root = value.norm().sqrt();
            // Length to the power of 3/4.
            let levelled = root * root.sqrt();
            *value *= across * down / levelled.max(NOTHING);
            energy += f64::from(value.norm_sqr());
        }
    }
    if energy <= f64::from(NOTHING) {
        return vec![Complex32::ZERO; transform.len()];
    }
    let scale = (1.0 / energy.sqrt()) as f32;
    spectrum.iter_mut().for_each(|value| *value *= scale);
    spectrum
}
