use crate::noise::Lattice;
use crate::random::Random;
use glam::{Mat3, Vec3};

/// A solid texture: a number in 0..=1 at every point of space.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    kind: PatternKind,
    to_noise: Mat3,
    offset: Vec3,
}

#[derive(Debug, Clone, Copy)]
enum PatternKind {
    Clouds,
    /// Wavy stripes, with the sharpness of their borders.
    Stripes(f32),
    /// Cells of different brightness with distorted walls.
    Cells,
    /// Year rings around an axis, with fine grain along it.
    Wood,
    /// Flat shapes with sharp outlines in rows, as printed: discs, bars and their mirror images.
    Print,
    /// Small grains, as in granite.
    Speckles,
}

impl Pattern {
    pub(crate) fn draw(random: &mut Random) -> Self {
        let kind = match random.below(6) {
            0 => PatternKind::Clouds,
            1 => PatternKind::Stripes(random.log_range(1.0, 12.0)),
            2 => PatternKind::Cells,
            3 => PatternKind::Wood,
            4 => PatternKind::Print,
            _ => PatternKind::Speckles,
        };
        let frequency = match kind {
            PatternKind::Speckles => random.log_range(8.0, 24.0),
            PatternKind::Wood => random.log_range(1.5, 5.0),
            _ => random.log_range(1.5, 14.0),
        };
        Self {
            kind,
            to_noise: random.rotation() * frequency,
            offset: random.vector(16.0),
        }
    }

    pub(crate) fn at(&self, lattice: &Lattice, point: Vec3) -> f32 {
        let place = self.to_noise * point + self.offset;
        match self.kind {
            PatternKind::Clouds => {
                let fine = lattice.at(place * 2.3);
                smooth_step(0.8 * lattice.at(place) + 0.4 * fine + 0.5)
            }
            PatternKind::Stripes(sharpness) => {
                let along = place.x + 0.8 * lattice.at(place * 0.4);
                let wave = (along - along.floor() - 0.5).abs() * 4.0 - 1.0;
                smooth_step(wave * sharpness + 0.5)
            }
            PatternKind::Cells => {
                let warp = 0.4 * lattice.at(place * 0.7);
                0.5 + 0.5 * lattice.cell(place + Vec3::splat(warp))
            }
            PatternKind::Wood => {
                let out = (place.x * place.x + place.y * place.y).sqrt();
                let ring = 2.0 * out + 0.7 * lattice.at(place * Vec3::new(0.6, 0.6, 0.15));
                // Late wood darkens slowly and ends suddenly.
                let year = ring - ring.floor();
                let grain = lattice.at(place * Vec3::new(9.0, 9.0, 0.8));
                (year * year * 0.85 + 0.15 * grain + 0.1).clamp(0.0, 1.0)
            }
            PatternKind::Print => print(lattice, place),
            PatternKind::Speckles => smooth_step(3.0 * lattice.at(place) - 0.6),
        }
    }
}

/// Ink on the plane x, y, unit cells each with a shape of its own.
fn print(lattice: &Lattice, place: Vec3) -> f32 {
    let cell = Vec3::new(place.x.floor(), place.y.floor(), 0.0);
    let inside = place - cell - Vec3::new(0.5, 0.5, 0.0);
    let choice = lattice.cell(cell);
    let size = 0.28 + 0.18 * lattice.cell(cell + Vec3::new(7.0, 3.0, 0.0));
    let (x, y) = (inside.x.abs(), inside.y.abs());
    let distance = if choice < -0.4 {
        (x * x + y * y).sqrt() - size
    } else if choice < 0.1 {
        (x - 0.3 * size).max(y - 0.48)
    } else if choice < 0.5 {
        ((x * x + y * y).sqrt() - size).abs() - 0.1
    } else {
        return 0.0;
    };
    smooth_step(0.5 - distance * 30.0)
}

pub(crate) fn smooth_step(value: f32) -> f32 {
    let t = value.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Stream;

    #[test]
    fn every_pattern_uses_its_range() {
        let mut random = Random::new(11, Stream::Material);
        for _ in 0..60 {
            let pattern = Pattern::draw(&mut random);
            let (mut low, mut high) = (1.0f32, 0.0f32);
            for _ in 0..3000 {
                let value = pattern.at(Lattice::shared(), random.vector(1.0));
                assert!((0.0..=1.0).contains(&value), "{pattern:?}: {value}");
                low = low.min(value);
                high = high.max(value);
            }
            assert!(high - low > 0.4, "{pattern:?}: {low}..{high}");
        }
    }
}
