//! A signal that arrives late.

use profiles::Real;

use crate::error::ModelError;

/// A delay so close to a whole number of periods is taken as that.
const WHOLE: f64 = 1e-9;
const LONGEST: f64 = 1e7;

/// A held, sampled signal delayed by any time: `y(t) = u(t - tau)`, `G(s) = e^(-tau s)`.
///
/// A signal that is held over every period, from the sample at its start, is delayed exactly: over a period it is one
/// held value up to an instant within, and the next after. A delay within 1e-9 of a whole number of periods is taken as
/// that, and a sample that is not finite arrives like any other. An update allocates nothing.
///
/// ```
/// use plants::TransportDelay;
///
/// let mut line = TransportDelay::new(2.25e-3, 1e-3)?; // two periods and a quarter
/// let outputs = [1.0, 2.0, 3.0, 4.0].map(|sample| line.update(sample));
/// // Of the period after the fourth sample, a quarter still belongs to the first.
/// assert_eq!((outputs[3].before, outputs[3].after), (1.0, 2.0));
/// assert!((outputs[3].fraction - 0.25).abs() < 1e-12);
/// assert!((outputs[3].mean() - 1.75).abs() < 1e-12);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TransportDelay {
    delay: f64,
    period: f64,
    fraction: f64,
    // The samples still on their way, in a circle; at least the two that a period can show.
    samples: Vec<f64>,
    next: usize,
}

/// What a delayed signal is over the period that begins with a sample.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DelayedHold {
    /// The value over the first `fraction` of the period.
    pub before: f64,
    /// The value over the rest of the period.
    pub after: f64,
    /// The part of the period, in [0, 1), that the first value lasts.
    pub fraction: f64,
}

impl DelayedHold {
    /// The value at the start of the period, from the right.
    #[inline]
    #[must_use]
    pub fn start(&self) -> f64 {
        if self.fraction > 0.0 { self.before } else { self.after }
    }

    /// The mean over the period: what an integrator sees.
    #[inline]
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.after + (self.before - self.after) * self.fraction
    }
}

impl TransportDelay {
    /// A line of a delay and a sample period, both in s, on which nothing but zero was sent.
    ///
    /// # Errors
    /// A period that is not positive and finite, or a delay that is negative or of more than 1e7 periods.
    pub fn new(delay: f64, period: f64) -> Result<Self, ModelError> {
        if !(period > 0.0 && period.is_finite()) {
            return Err(ModelError::Parameter {
                parameter: "the period in s",
                range: "positive and finite",
                value: period,
            });
        }
        let periods = delay / period;
        if !(delay >= 0.0 && periods <= LONGEST) {
            return Err(ModelError::Parameter {
                parameter: "the delay in s",
                range: "not negative and at most 1e7 periods",
                value: delay,
            });
        }
        let nearest = Real::round(periods);
        let (whole, fraction) = if (periods - nearest).abs() <= WHOLE {
            (nearest, 0.0)
        } else {
            let whole = Real::floor(periods);
            (whole, periods - whole)
        };
        Ok(Self { delay, period, fraction, samples: vec![0.0; whole as usize + 2], next: 0 })
    }

    /// The delay `tau`, s.
    #[must_use]
    pub fn delay(&self) -> f64 {
        self.delay
    }

    /// The sample period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Sends a sample, and returns what arrives over the period that begins with it.
    #[inline]
    pub fn update(&mut self, sample: f64) -> DelayedHold {
        let length = self.samples.len();
        let wrapped = |place: usize| if place >= length { place - length } else { place };
        if let Some(slot) = self.samples.get_mut(self.next) {
            *slot = sample;
        }
        let oldest = wrapped(self.next + 1);
        let at = |place: usize| self.samples.get(place).copied().unwrap_or(sample);
        let hold =
            DelayedHold { before: at(oldest), after: at(wrapped(oldest + 1)), fraction: self.fraction };
        self.next = oldest;
        hold
    }

    /// Forgets what is on its way, as if nothing but `value` had been sent.
    pub fn reset(&mut self, value: f64) {
        self.samples.fill(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The samples `1, 2, 3 ...` held from time zero on, zero before.
    fn held(time: f64, period: f64) -> f64 {
        Real::max(Real::floor(time / period) + 1.0, 0.0)
    }

    #[test]
    fn the_held_signal_arrives_late() {
        for delay in [0.0, 0.3, 0.999, 1.0, 1.5, 2.0, 7.123, 40.0] {
            let period = 0.25;
            let mut line = TransportDelay::new(delay * period, period).expect("valid");
            for k in 0..60 {
                let hold = line.update(f64::from(k) + 1.0);
                let mut sum = 0.0;
                for part in 0..1000 {
                    let within = (f64::from(part) + 0.5) / 1000.0;
                    let expected = held((f64::from(k) + within - delay) * period, period);
                    let value = if within < hold.fraction { hold.before } else { hold.after };
                    assert!((value - expected).abs() <= 0.0, "{value} {expected} {delay} {k} {within}");
                    sum += value;
                }
                // The delays are whole thousandths of a period, rounded at forty of them.
                assert!((1000.0 * hold.mean() - sum).abs() <= 1e-11, "{} {sum}", hold.mean());
                assert!((hold.start() - held((f64::from(k) - delay + 1e-9) * period, period)).abs() <= 0.0);
            }
        }
    }

    #[test]
    fn a_whole_number_of_periods_is_whole() {
        // 0.003 / 0.001 is a little above three.
        let mut line = TransportDelay::new(0.003, 0.001).expect("valid");
        let arrived: Vec<f64> = (1..=6).map(|k| line.update(f64::from(k)).start()).collect();
        assert_eq!(arrived, [0.0, 0.0, 0.0, 1.0, 2.0, 3.0]);
        let mut direct = TransportDelay::new(0.0, 0.001).expect("valid");
        assert!((direct.update(5.0).start() - 5.0).abs() <= 0.0);
    }

    #[test]
    fn a_reset_line_is_full_of_its_value() {
        let mut line = TransportDelay::new(0.0035, 0.001).expect("valid");
        line.update(9.0);
        line.reset(4.0);
        for _ in 0..3 {
            assert_eq!(line.update(1.0), DelayedHold { before: 4.0, after: 4.0, fraction: line.fraction });
        }
        let hold = line.update(1.0);
        assert_eq!((hold.before, hold.after), (4.0, 1.0));
    }

    #[test]
    fn bad_numbers_are_named() {
        for (delay, period) in [(1.0, 0.0), (1.0, f64::NAN), (-1.0, 1.0), (f64::NAN, 1.0), (1.1e7, 1.0)] {
            assert!(matches!(TransportDelay::new(delay, period), Err(ModelError::Parameter { .. })));
        }
        let error = ModelError::Parameter {
            parameter: "the delay in s",
            range: "not negative and at most 1e7 periods",
            value: -0.5,
        };
        assert_eq!(TransportDelay::new(-0.5, 1.0), Err(error));
    }
}
