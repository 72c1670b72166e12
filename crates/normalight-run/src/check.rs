use crate::RunError;

/// Checks that a number of a recipe lies in its range, both ends included. `expected`: the range in words.
///
/// # Errors
/// [`RunError::Value`].
pub fn check<T: PartialOrd + std::fmt::Display>(
    field: &'static str,
    found: T,
    range: std::ops::RangeInclusive<T>,
    expected: &'static str,
) -> Result<(), RunError> {
    // NaN compares false and is refused.
    if range.contains(&found) {
        return Ok(());
    }
    Err(RunError::Value {
        field,
        found: found.to_string(),
        expected,
    })
}
