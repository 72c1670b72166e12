//! What things are made of and how it shines.
mod brdf;
mod material;
mod measured;
mod pattern;
mod surface;
mod surfaces;

pub(crate) use brdf::shade;
pub(crate) use material::Material;
pub(crate) use measured::Measured;
pub(crate) use surfaces::Surfaces;

#[cfg(test)]
pub(crate) fn surface_for_tests(albedo: f32) -> surface::Surface {
    surface::Surface {
        albedo: glam::Vec3::splat(albedo),
        ..surface::Surface::MATTE
    }
}
