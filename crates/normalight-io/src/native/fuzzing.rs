//! Parsers that are otherwise reached through paths only, for the fuzz targets.
use super::published::fuzzing as published;
use crate::IoError;
use crate::matlab;
use normalight_core::Light;

/// Size and values of an array of a MATLAB 5 file; at most `limit` bytes are unpacked.
pub fn matlab_array(bytes: &[u8], wanted: &str, limit: u64) -> Option<(Vec<u32>, Vec<f64>)> {
    let array = matlab::find_array(bytes, wanted, limit)?;
    Some((array.size, array.values))
}

/// The images and lights of an object in the published layout.
///
/// # Errors
/// [`IoError::LightFormat`].
pub fn published_lights(name: &str, text: &str) -> Result<Vec<(String, Light)>, IoError> {
    published::lights(name, text)
}
