//! A recorded signal, checked once.

mod chatter;
mod figures;
mod integrals;

use crate::error::SignalError;

/// A recorded signal: finite values at finite times that increase.
///
/// ```
/// use identify::Signal;
///
/// let time: Vec<f64> = (0..2000).map(|n| n as f64 * 1e-3).collect();
/// let position: Vec<f64> = time.iter().map(|t| 1.0 - (-5.0 * t).exp() * (30.0 * t).cos()).collect();
/// let signal = Signal::new(&time, &position)?;
/// assert!((signal.overshoot(0.0, 1.0)? - 0.6).abs() < 0.01);
/// // The envelope enters the band of 2 % at ln(50)/5 s, the oscillation a little before.
/// let settled = signal.settling_time(1.0, 0.02)?;
/// assert!(settled < 50_f64.ln() / 5.0 && settled > 50_f64.ln() / 5.0 - 0.11);
/// # Ok::<(), identify::SignalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Signal<'a> {
    axis: Axis<'a>,
    values: &'a [f64],
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Axis<'a> {
    Times(&'a [f64]),
    Period(f64),
}

impl<'a> Signal<'a> {
    /// A signal from its times in s and its values.
    ///
    /// # Errors
    /// No samples, slices of different lengths, a value that is not finite, times that do not increase.
    pub fn new(times: &'a [f64], values: &'a [f64]) -> Result<Self, SignalError> {
        if times.len() != values.len() {
            return Err(SignalError::Lengths { times: times.len(), values: values.len() });
        }
        check(values)?;
        let mut before = f64::NEG_INFINITY;
        for (index, &time) in times.iter().enumerate() {
            if !(time > before && time.is_finite()) {
                return Err(SignalError::Time { index, time });
            }
            before = time;
        }
        Ok(Self { axis: Axis::Times(times), values })
    }

    /// A signal sampled every `period` s, the first sample at time zero.
    ///
    /// # Errors
    /// No samples, a value that is not finite, a period that is not positive and finite, or so long that the last
    /// time is not finite.
    pub fn sampled(values: &'a [f64], period: f64) -> Result<Self, SignalError> {
        check(values)?;
        if !(period > 0.0 && (period * values.len() as f64).is_finite()) {
            return Err(SignalError::Period(period));
        }
        Ok(Self { axis: Axis::Period(period), values })
    }

    /// The values.
    #[must_use]
    pub fn values(&self) -> &'a [f64] {
        self.values
    }

    /// Times and values in order.
    pub fn samples(&self) -> impl DoubleEndedIterator<Item = (f64, f64)> + ExactSizeIterator + '_ {
        self.values.iter().enumerate().map(|(index, &value)| (self.time(index), value))
    }

    /// The time of a sample, s.
    pub(crate) fn time(&self, index: usize) -> f64 {
        match self.axis {
            Axis::Times(times) => times.get(index).copied().unwrap_or(f64::INFINITY),
            Axis::Period(period) => index as f64 * period,
        }
    }

    /// The time of the last sample, s.
    pub(crate) fn end(&self) -> f64 {
        self.time(self.values.len() - 1)
    }
}

/// At least one value, all finite.
pub(crate) fn check(values: &[f64]) -> Result<(), SignalError> {
    if values.is_empty() {
        return Err(SignalError::Empty);
    }
    match values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, &value)) => Err(SignalError::Value { index, value }),
        None => Ok(()),
    }
}

/// A number that must be finite.
pub(crate) fn finite(quantity: &'static str, value: f64) -> Result<f64, SignalError> {
    if value.is_finite() { Ok(value) } else { Err(SignalError::Number { quantity, range: "finite", value }) }
}

/// A number that must be finite and not negative.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<f64, SignalError> {
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(SignalError::Number { quantity, range: "finite and not negative", value })
    }
}

/// The signed length of a move between two finite ends.
pub(crate) fn length(from: f64, to: f64) -> Result<f64, SignalError> {
    let length = finite("the end of a move", to)? - finite("the start of a move", from)?;
    // Subtraction of different numbers gives zero never, but may overflow.
    if length.abs() > 0.0 { finite("the length of a move", length) } else { Err(SignalError::NoMove(to)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_signals_are_named() {
        assert_eq!(Signal::new(&[], &[]), Err(SignalError::Empty));
        assert_eq!(Signal::new(&[0.0], &[]), Err(SignalError::Lengths { times: 1, values: 0 }));
        assert_eq!(Signal::new(&[0.0, 0.0], &[1.0, 2.0]), Err(SignalError::Time { index: 1, time: 0.0 }));
        assert!(matches!(
            Signal::sampled(&[0.0, f64::NAN], 1.0),
            Err(SignalError::Value { index: 1, value }) if value.is_nan()
        ));
        for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Signal::sampled(&[0.0], period), Err(SignalError::Period(_))));
        }
        assert!(matches!(
            Signal::new(&[0.0, f64::INFINITY], &[1.0, 2.0]),
            Err(SignalError::Time { index: 1, .. })
        ));
    }

    #[test]
    fn both_axes_agree() {
        let values = [1.0, 3.0, 2.0];
        let uniform = Signal::sampled(&values, 0.5).expect("valid");
        let listed = Signal::new(&[0.0, 0.5, 1.0], &values).expect("valid");
        assert!(uniform.samples().eq(listed.samples()));
        assert!((uniform.end() - 1.0).abs() <= 0.0);
    }
}
