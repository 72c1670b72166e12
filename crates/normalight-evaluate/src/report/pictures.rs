//! Pictures of what was found.
use crate::{EvaluateError, Method};
use normalight_core::{Mask, NormalMap, angle_to_truth};
use normalight_io::{NormalFormat, normals_rgba};
use std::io::Cursor;

/// Errors from here on have the last colour of error maps, in degrees.
pub(super) const MOST_DEGREES: f32 = 45.0;

/// Pictures of one object, PNG and SVG files as bytes.
#[derive(Debug, Clone, Default)]
pub struct ObjectPictures {
    /// The object's name.
    pub object: String,
    /// Its true normals; empty where they are not known.
    pub truth: Vec<u8>,
    /// What each method found.
    pub methods: Vec<MethodPictures>,
}

/// What a method found of an object, as pictures.
#[derive(Debug, Clone)]
pub struct MethodPictures {
    /// The method.
    pub method: Method,
    /// The normals.
    pub normals: Vec<u8>,
    /// The errors of the normals; empty where the true ones are not known.
    pub errors: Vec<u8>,
    /// The lights, with the true ones where these are known; empty where they were given.
    pub lights: Vec<u8>,
}

/// A normal map as PNG, y up, transparent outside the object.
///
/// # Errors
/// [`EvaluateError::Report`] for a map without pixels.
pub fn normals_picture(map: &NormalMap) -> Result<Vec<u8>, EvaluateError> {
    png(
        &normals_rgba(map, NormalFormat::OpenGl),
        map.width(),
        map.height(),
    )
}

/// The angles between found and true normals as PNG: violet for none, yellow for 45 degrees and more, transparent where
/// there is no true normal.
///
/// # Errors
/// [`EvaluateError::Report`] for maps without pixels.
pub fn errors_picture(
    found: &NormalMap,
    truth: &NormalMap,
    mask: &Mask,
) -> Result<Vec<u8>, EvaluateError> {
    let pairs = found.normals().iter().zip(truth.normals());
    let pixels = pairs
        .zip(mask.inside())
        .flat_map(|((&found, &truth), &inside)| {
            let angle = angle_to_truth(found, truth).filter(|_| inside);
            let Some(degrees) = angle.map(f32::to_degrees) else {
                return [0; 4];
            };
            let colour = colour(f64::from(degrees / MOST_DEGREES));
            [colour.r, colour.g, colour.b, 255]
        });
    png(&pixels.collect::<Vec<u8>>(), truth.width(), truth.height())
}

/// The colour of an error, 0..1.
pub(super) fn colour(share: f64) -> colorous::Color {
    colorous::VIRIDIS.eval_continuous(share.clamp(0.0, 1.0))
}

fn png(rgba: &[u8], width: usize, height: usize) -> Result<Vec<u8>, EvaluateError> {
    let failed = |reason: String| EvaluateError::Report(reason);
    let side = |side: usize| u32::try_from(side).map_err(|error| failed(error.to_string()));
    let mut bytes = Cursor::new(Vec::new());
    image::write_buffer_with_format(
        &mut bytes,
        rgba,
        side(width)?,
        side(height)?,
        image::ExtendedColorType::Rgba8,
        image::ImageFormat::Png,
    )
    .map_err(|error| failed(error.to_string()))?;
    Ok(bytes.into_inner())
}
