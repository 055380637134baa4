//! Whether a parameter lies in its range.

use profiles::Real;

/// A parameter out of its range, for the error of whoever asked.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OutOfRange {
    pub(crate) which: &'static str,
    pub(crate) range: &'static str,
    pub(crate) value: f64,
}

/// Positive and finite.
pub(crate) fn positive<F: Real>(which: &'static str, value: F) -> Result<(), OutOfRange> {
    in_range(which, "positive", value, value > F::ZERO)
}

/// Not negative and finite.
pub(crate) fn not_negative<F: Real>(which: &'static str, value: F) -> Result<(), OutOfRange> {
    in_range(which, "not negative", value, value >= F::ZERO)
}

/// Finite, and `inside` what the range says.
pub(crate) fn in_range<F: Real>(
    which: &'static str,
    range: &'static str,
    value: F,
    inside: bool,
) -> Result<(), OutOfRange> {
    if inside && value.is_finite() { Ok(()) } else { Err(OutOfRange { which, range, value: value.to_f64() }) }
}
