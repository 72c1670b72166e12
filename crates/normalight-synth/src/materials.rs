//! What things are made of and how it shines.
mod brdf;
mod material;
mod measured;
mod pattern;
mod surfaces;

pub(crate) use brdf::shade;
pub(crate) use material::Material;
pub(crate) use measured::Measured;
pub(crate) use surfaces::Surfaces;

#[cfg(test)]
pub(crate) fn surface_for_tests(albedo: f32) -> surfaces::Surface {
    surfaces::Surface {
        albedo: glam::Vec3::splat(albedo),
        ..surfaces::Surface::MATTE
    }
}
