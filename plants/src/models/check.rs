//! Ranges of parameters.

use crate::error::ModelError;

/// A positive number with a finite reciprocal.
pub(super) fn positive(parameter: &'static str, value: f64) -> Result<(), ModelError> {
    if value >= f64::MIN_POSITIVE && value.is_finite() {
        Ok(())
    } else {
        Err(ModelError::Parameter { parameter, range: "positive and finite", value })
    }
}

pub(super) fn not_negative(parameter: &'static str, value: f64) -> Result<(), ModelError> {
    if value >= 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(ModelError::Parameter { parameter, range: "finite and not negative", value })
    }
}
