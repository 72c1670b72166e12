use glam::{Mat3, Vec3};

/// A simple solid, one of those an object is joined from.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    centre: Vec3,
    /// Radius of a sphere around `centre` that holds the whole part.
    reach: f32,
    form: Form,
}

#[derive(Debug, Clone)]
enum Form {
    Ellipsoid {
        /// Takes a point relative to the centre to where the ellipsoid is the unit sphere.
        to_unit: Mat3,
        smallest: f32,
    },
    /// A rod between two ends with a radius at each.
    Capsule {
        start: Vec3,
        along: Vec3,
        inverse_length_squared: f32,
        radii: [f32; 2],
    },
    Ring {
        axis: Vec3,
        radius: f32,
        thickness: f32,
    },
}

impl Part {
    pub(crate) fn sphere(centre: Vec3, radius: f32) -> Self {
        Self::ellipsoid(centre, Vec3::splat(radius), Mat3::IDENTITY)
    }

    /// `axes`: the directions of the three radii.
    pub(crate) fn ellipsoid(centre: Vec3, radii: Vec3, axes: Mat3) -> Self {
        let inverse_radii = radii.recip();
        Self {
            centre,
            reach: radii.max_element(),
            form: Form::Ellipsoid {
                to_unit: Mat3::from_diagonal(inverse_radii) * axes.transpose(),
                smallest: radii.min_element(),
            },
        }
    }

    pub(crate) fn capsule(start: Vec3, end: Vec3, radii: [f32; 2]) -> Self {
        let along = end - start;
        Self {
            centre: (start + end) / 2.0,
            reach: along.length() / 2.0 + radii[0].max(radii[1]),
            form: Form::Capsule {
                start,
                along,
                inverse_length_squared: along.length_squared().max(1e-6).recip(),
                radii,
            },
        }
    }

    pub(crate) fn ring(centre: Vec3, axis: Vec3, radius: f32, thickness: f32) -> Self {
        Self {
            centre,
            reach: radius + thickness,
            form: Form::Ring {
                axis: axis.normalize_or(Vec3::Z),
                radius,
                thickness,
            },
        }
    }

    /// The part and its place, `size` times as large.
    pub(crate) fn scaled(&self, size: f32) -> Self {
        let form = match &self.form {
            Form::Ellipsoid { to_unit, smallest } => Form::Ellipsoid {
                to_unit: *to_unit * size.recip(),
                smallest: smallest * size,
            },
            Form::Capsule {
                start,
                along,
                inverse_length_squared,
                radii,
            } => Form::Capsule {
                start: *start * size,
                along: *along * size,
                inverse_length_squared: inverse_length_squared / (size * size),
                radii: radii.map(|radius| radius * size),
            },
            Form::Ring {
                axis,
                radius,
                thickness,
            } => Form::Ring {
                axis: *axis,
                radius: radius * size,
                thickness: thickness * size,
            },
        };
        Self {
            centre: self.centre * size,
            reach: self.reach * size,
            form,
        }
    }

    /// The part as it lies pressed into a plate at z = 0: its depth shrunk to `depth` of itself and
    /// its middle moved to the plate. Limbs become long ellipsoids, rings stay as they are.
    pub(crate) fn pressed(&self, depth: f32) -> Self {
        match &self.form {
            Form::Ellipsoid { to_unit, smallest } => Self {
                centre: Vec3::new(self.centre.x, self.centre.y, 0.5 * self.centre.z * depth),
                reach: self.reach,
                form: Form::Ellipsoid {
                    to_unit: *to_unit * Mat3::from_diagonal(Vec3::new(1.0, 1.0, 1.0 / depth)),
                    smallest: smallest * depth,
                },
            },
            Form::Capsule { along, radii, .. } => {
                let radius = 0.5 * (radii[0] + radii[1]);
                let length = along.length();
                let x = along.normalize_or(Vec3::X);
                let y = x.any_orthonormal_vector();
                let axes = Mat3::from_cols(x, y, x.cross(y));
                let radii = Vec3::new(0.5 * length + radius, radius, radius);
                Self::ellipsoid(self.centre, radii, axes).pressed(depth)
            }
            Form::Ring { .. } => self.clone(),
        }
    }

    pub(crate) fn centre(&self) -> Vec3 {
        self.centre
    }

    pub(crate) fn reach(&self) -> f32 {
        self.reach
    }

    /// The part turned about the origin.
    pub(crate) fn rotated(&self, rotation: Mat3) -> Self {
        let form = match self.form {
            Form::Ellipsoid { to_unit, smallest } => Form::Ellipsoid {
                to_unit: to_unit * rotation.transpose(),
                smallest,
            },
            Form::Capsule {
                start,
                along,
                inverse_length_squared,
                radii,
            } => Form::Capsule {
                start: rotation * start,
                along: rotation * along,
                inverse_length_squared,
                radii,
            },
            Form::Ring {
                axis,
                radius,
                thickness,
            } => Form::Ring {
                axis: rotation * axis,
                radius,
                thickness,
            },
        };
        Self {
            centre: rotation * self.centre,
            reach: self.reach,
            form,
        }
    }

    /// Signed distance, negative inside; for ellipsoids its first-order estimate, which is exact
    /// on the surface and for spheres.
    #[inline]
    pub(crate) fn distance(&self, point: Vec3) -> f32 {
        match &self.form {
            Form::Ellipsoid { to_unit, smallest } => {
                let unit = *to_unit * (point - self.centre);
                let length = unit.length();
                let gradient = to_unit.transpose_mul_vec3(unit).length();
                if gradient < 1e-6 {
                    return -smallest;
                }
                // f(p) = |M p| - 1 divided by the length of its gradient.
                length * (length - 1.0) / gradient
            }
            Form::Capsule {
                start,
                along,
                inverse_length_squared,
                radii,
            } => {
                let offset = point - *start;
                let share = (offset.dot(*along) * inverse_length_squared).clamp(0.0, 1.0);
                let radius = radii[0] + (radii[1] - radii[0]) * share;
                (offset - *along * share).length() - radius
            }
            Form::Ring {
                axis,
                radius,
                thickness,
            } => {
                let offset = point - self.centre;
                let height = offset.dot(*axis);
                let out = (offset - *axis * height).length() - radius;
                (out * out + height * height).sqrt() - thickness
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Random, Stream};

    #[test]
    fn sphere_distance_is_exact() {
        let part = Part::sphere(Vec3::new(0.2, -0.1, 0.3), 0.5);
        let point = Vec3::new(1.0, 1.0, -0.5);
        let expected = (point - Vec3::new(0.2, -0.1, 0.3)).length() - 0.5;
        assert!((part.distance(point) - expected).abs() < 1e-6);
    }

    #[test]
    fn ellipsoid_is_zero_on_its_surface_also_when_rotated() {
        let mut random = Random::new(3, Stream::Shape);
        for _ in 0..50 {
            let radii = Vec3::new(
                random.range(0.2, 1.0),
                random.range(0.2, 1.0),
                random.range(0.2, 1.0),
            );
            let axes = random.rotation();
            let centre = random.vector(0.5);
            let turn = random.rotation();
            let part = Part::ellipsoid(centre, radii, axes).rotated(turn);
            let on_surface = turn * (centre + axes * (random.direction() * radii));
            assert!(part.distance(on_surface).abs() < 1e-5);
        }
    }
}
