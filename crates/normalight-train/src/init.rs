//! Runs that start from weights instead of random numbers.
use crate::TrainError;
use normalight_model::Weights;

/// Whether a network may start from a weights file.
///
/// # Errors
/// Cells, whose normalisation the file no longer has; another architecture than the recipe's.
pub(crate) fn check_start(weights: &Weights, plain: bool, same: bool) -> Result<(), TrainError> {
    if !plain {
        let reason = "its batch normalisation is folded into the convolutions, which training needs \
                      apart: only plain networks can start from weights";
        return Err(init_error(weights, reason.to_owned()));
    }
    check_same(weights, same)
}

/// Whether the architecture of a weights file is the recipe's.
pub(crate) fn check_same(weights: &Weights, same: bool) -> Result<(), TrainError> {
    if same {
        return Ok(());
    }
    Err(init_error(
        weights,
        "its architecture is not the recipe's".to_owned(),
    ))
}

pub(crate) fn init_error(weights: &Weights, reason: String) -> TrainError {
    TrainError::Init {
        name: weights.name().to_owned(),
        reason,
    }
}
