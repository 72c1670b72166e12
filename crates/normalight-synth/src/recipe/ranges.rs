//! Checks of single numbers of a recipe.
use crate::SynthError;

/// A file that a positive weight asks for.
pub(super) fn needs_file(
    field: &'static str,
    weight: f32,
    given: bool,
    expected: &'static str,
) -> Result<(), SynthError> {
    if given || weight <= 0.0 {
        return Ok(());
    }
    Err(SynthError::OutOfRange {
        field,
        found: "nothing".to_owned(),
        expected,
    })
}

/// A share in 0..=1.
pub(super) fn share(field: &'static str, found: f32) -> Result<(), SynthError> {
    number(field, found, 0.0, 1.0, "0..=1")
}

/// A number in `low..=high`. Written so that NaN fails too.
pub(super) fn number(
    field: &'static str,
    found: f32,
    low: f32,
    high: f32,
    expected: &'static str,
) -> Result<(), SynthError> {
    if (low..=high).contains(&found) {
        return Ok(());
    }
    Err(SynthError::OutOfRange {
        field,
        found: found.to_string(),
        expected,
    })
}

/// `[low, high]` within these limits and in this order.
pub(super) fn range(
    field: &'static str,
    found: [f32; 2],
    low: f32,
    high: f32,
    expected: &'static str,
) -> Result<(), SynthError> {
    if low <= found[0] && found[0] <= found[1] && found[1] <= high {
        return Ok(());
    }
    Err(SynthError::OutOfRange {
        field,
        found: format!("[{}, {}]", found[0], found[1]),
        expected,
    })
}

/// Weights of which at least one is positive.
pub(super) fn weights(
    field: &'static str,
    weights: &[(&'static str, f32)],
) -> Result<(), SynthError> {
    for &(name, weight) in weights {
        number(name, weight, 0.0, 1e6, "a weight in 0..=1000000")?;
    }
    if weights.iter().all(|&(_, weight)| weight == 0.0) {
        return Err(SynthError::NoWeight { field });
    }
    Ok(())
}
