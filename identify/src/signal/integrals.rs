//! Integral figures of merit of a recorded error.

use profiles::Interval;

use super::Signal;
use crate::error::SignalError;

/// Integrals of an error `e`, time from the start of the window, or of the record where there is none:
///
/// ```text
/// ISE = int e^2 dt    IAE = int |e| dt    ITSE = int t e^2 dt    ITAE = int t |e| dt
/// ```
///
/// each by the trapezoid rule on the samples. The ends of a window that lie between samples are taken on the straight
/// line. A record of one sample, and a window of no length, have integrals of zero.
impl Signal<'_> {
    /// Integral of the squared error, the square of the signal's unit times s.
    ///
    /// # Errors
    /// A window that is not finite, reversed, or not inside the record; an integral out of range.
    pub fn integral_square_error(&self, window: Option<Interval>) -> Result<f64, SignalError> {
        self.integral(window, |_, e| e * e)
    }

    /// Integral of the absolute error, the signal's unit times s.
    ///
    /// # Errors
    /// As for the squared error.
    pub fn integral_absolute_error(&self, window: Option<Interval>) -> Result<f64, SignalError> {
        self.integral(window, |_, e| e.abs())
    }

    /// Integral of time times the squared error, the square of the signal's unit times s^2.
    ///
    /// # Errors
    /// As for the squared error.
    pub fn integral_time_square_error(&self, window: Option<Interval>) -> Result<f64, SignalError> {
        self.integral(window, |t, e| t * e * e)
    }

    /// Integral of time times the absolute error, the signal's unit times s^2.
    ///
    /// # Errors
    /// As for the squared error.
    pub fn integral_time_absolute_error(&self, window: Option<Interval>) -> Result<f64, SignalError> {
        self.integral(window, |t, e| t * e.abs())
    }

    /// A window inside the record; the whole record where there is none.
    pub(super) fn window(&self, window: Option<Interval>) -> Result<Interval, SignalError> {
        let (first, last) = (self.time(0), self.end());
        let Interval { lower, upper } = window.unwrap_or(Interval { lower: first, upper: last });
        if first <= lower && lower <= upper && upper <= last {
            Ok(Interval { lower, upper })
        } else {
            Err(SignalError::Window { lower, upper, first, last })
        }
    }

    fn integral(&self, window: Option<Interval>, f: impl Fn(f64, f64) -> f64) -> Result<f64, SignalError> {
        let Interval { lower, upper } = self.window(window)?;
        let mut sum = 0.0;
        let mut before: Option<(f64, f64)> = None;
        for (time, value) in self.samples() {
            if let Some((t0, y0)) = before {
                let (from, to) = (lower.max(t0), upper.min(time));
                if from < to {
                    // Weights of both ends, so that the difference of large values cannot overflow.
                    let at = |t: f64| {
                        let part = (t - t0) / (time - t0);
                        (1.0 - part) * y0 + part * value
                    };
                    sum += 0.5 * (to - from) * f(from - lower, at(from))
                        + 0.5 * (to - from) * f(to - lower, at(to));
                }
            }
            before = Some((time, value));
        }
        if sum.is_finite() {
            Ok(sum)
        } else {
            Err(SignalError::Number { quantity: "the integral", range: "finite", value: sum })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: f64 = 1e-3;

    /// `e^(-t) cos(3 t)` for eight seconds, after a second of nothing.
    fn error() -> (Vec<f64>, Vec<f64>) {
        (0..=8000).map(|n| f64::from(n) * PERIOD).map(|t| (t, (-t).exp() * (3.0 * t).cos())).unzip()
    }

    #[test]
    fn closed_forms() {
        let (_, values) = error();
        let signal = Signal::sampled(&values, PERIOD).expect("valid");
        // e^2 = e^(-2t) (1 + cos 6t) / 2, whose transforms at 2 are 1/2, 2/(4 + 36) and, with t, 1/4, (4 - 36)/40^2.
        let square = 0.5 * (0.5 + 2.0 / 40.0);
        let time_square = 0.5 * (0.25 - 32.0 / 1600.0);
        // h^2/12 times the change of the slope, which is of the order of one.
        let tolerance = PERIOD * PERIOD;
        assert!((signal.integral_square_error(None).expect("finite") - square).abs() < tolerance);
        assert!((signal.integral_time_square_error(None).expect("finite") - time_square).abs() < tolerance);
        // Scaled by ten: 100 and 10 times as much.
        let tenfold: Vec<f64> = values.iter().map(|e| -10.0 * e).collect();
        let tenfold = Signal::sampled(&tenfold, PERIOD).expect("valid");
        assert!(
            (tenfold.integral_square_error(None).expect("finite") - 100.0 * square).abs() < 100.0 * tolerance
        );
        let absolute = |s: &Signal<'_>| s.integral_absolute_error(None).expect("finite");
        assert!((absolute(&tenfold) - 10.0 * absolute(&signal)).abs() < 1e-12);
    }

    #[test]
    fn an_error_that_keeps_its_sign() {
        let values: Vec<f64> = (0..=20_000).map(|n| -2.0 * (-f64::from(n) * PERIOD).exp()).collect();
        let signal = Signal::sampled(&values, PERIOD).expect("valid");
        let tolerance = PERIOD * PERIOD;
        assert!((signal.integral_absolute_error(None).expect("finite") - 2.0).abs() < tolerance);
        assert!((signal.integral_time_absolute_error(None).expect("finite") - 2.0).abs() < tolerance);
        // From one second on, time counted from there: the same curve, e times lower.
        let window = Some(Interval { lower: 1.0, upper: 20.0 });
        let e = std::f64::consts::E;
        assert!((signal.integral_time_absolute_error(window).expect("finite") - 2.0 / e).abs() < tolerance);
        assert!((signal.integral_square_error(window).expect("finite") - 2.0 / (e * e)).abs() < tolerance);
    }

    #[test]
    fn windows_add_up_and_cut_between_samples() {
        let signal = Signal::new(&[0.0, 1.0, 3.0], &[0.0, 2.0, -2.0]).expect("valid");
        let absolute = |lower, upper| signal.integral_absolute_error(Some(Interval { lower, upper }));
        // The line is at 1 at 0.5 s, at 0 at 2 s: trapezoids of 0.75 and 1.0.
        assert!((absolute(0.5, 1.0).expect("finite") - 0.75).abs() < 1e-15);
        assert!((absolute(1.0, 2.0).expect("finite") - 1.0).abs() < 1e-15);
        // The whole second interval has two ends of the same size: the rule does not see the crossing.
        assert!((absolute(1.0, 3.0).expect("finite") - 4.0).abs() < 1e-15);
        assert!(absolute(2.0, 2.0).expect("finite").abs() <= 0.0);
        for (lower, upper) in [(-0.1, 1.0), (1.0, 3.1), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            assert!(matches!(absolute(lower, upper), Err(SignalError::Window { .. })));
        }
        let large = Signal::sampled(&[1e200, 1e200], 1.0).expect("valid");
        assert!(matches!(large.integral_square_error(None), Err(SignalError::Number { .. })));
        let one = Signal::sampled(&[5.0], 1.0).expect("valid");
        assert!(one.integral_square_error(None).expect("finite").abs() <= 0.0);
    }
}
