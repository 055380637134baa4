//! How much of a recorded signal a model reproduces.

use crate::error::SignalError;
use crate::signal::check;

/// The fit of a model's output to a measured one, percent:
///
/// ```text
/// 100 (1 - |measured - modelled| / |measured - mean(measured)|)
/// ```
///
/// with Euclidean norms: one less the normalised root mean square error. 100 is a perfect fit, zero one no better than
/// a constant, and a worse one is negative.
///
/// ```
/// let measured = [0.0, 1.0, 2.0, 3.0];
/// assert_eq!(identify::fit_percentage(&measured, &measured)?, 100.0);
/// assert_eq!(identify::fit_percentage(&measured, &[1.5; 4])?, 0.0);
/// # Ok::<(), identify::SignalError>(())
/// ```
///
/// # Errors
/// Signals of different lengths, without samples, with values that are not finite; a measured signal that is constant.
pub fn fit_percentage(measured: &[f64], modelled: &[f64]) -> Result<f64, SignalError> {
    if measured.len() != modelled.len() {
        return Err(SignalError::Lengths { times: measured.len(), values: modelled.len() });
    }
    check(measured)?;
    check(modelled)?;
    // In units of the largest value no square overflows.
    let scale = measured.iter().fold(f64::MIN_POSITIVE, |scale, y| scale.max(y.abs()));
    let count = measured.len() as f64;
    let mean: f64 = measured.iter().map(|y| y / scale / count).sum();
    let norm = |part: &dyn Fn(f64, f64) -> f64| -> f64 {
        measured.iter().zip(modelled).map(|(y, m)| part(*y, *m).powi(2)).sum::<f64>().sqrt()
    };
    let spread = norm(&|y, _| y / scale - mean);
    // What rounding of the mean leaves of a constant.
    if spread <= 1e-14 * count.sqrt() * mean.abs() {
        return Err(SignalError::Constant(measured[0]));
    }
    let percentage = 100.0 * (1.0 - norm(&|y, m| y / scale - m / scale) / spread);
    if percentage.is_finite() {
        Ok(percentage)
    } else {
        Err(SignalError::Number { quantity: "the fit", range: "finite", value: percentage })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        // Errors of one in each of four samples over a spread of the square root of five.
        let measured = [0.0, 1.0, 2.0, 3.0];
        let fit = fit_percentage(&measured, &[1.0, 0.0, 3.0, 2.0]).expect("valid");
        assert!((fit - 100.0 * (1.0 - 2.0 / 5_f64.sqrt())).abs() < 1e-12);
        // Neither unit nor offset matters.
        let big = |x: &[f64]| x.iter().map(|y| 1e300 * (y + 4.0)).collect::<Vec<f64>>();
        let same = fit_percentage(&big(&measured), &big(&[1.0, 0.0, 3.0, 2.0])).expect("valid");
        assert!((fit - same).abs() < 1e-10);
        // Worse than the mean.
        assert!(fit_percentage(&measured, &[3.0, 2.0, 1.0, 0.0]).expect("valid") < 0.0);
    }

    #[test]
    fn what_has_no_fit_is_named() {
        assert_eq!(fit_percentage(&[1.0], &[]), Err(SignalError::Lengths { times: 1, values: 0 }));
        assert_eq!(fit_percentage(&[], &[]), Err(SignalError::Empty));
        assert_eq!(fit_percentage(&[0.1; 3], &[0.0; 3]), Err(SignalError::Constant(0.1)));
        assert_eq!(fit_percentage(&[0.0; 3], &[0.0; 3]), Err(SignalError::Constant(0.0)));
        assert!(matches!(
            fit_percentage(&[0.0, 1.0], &[0.0, f64::NAN]),
            Err(SignalError::Value { index: 1, .. })
        ));
        assert!(matches!(fit_percentage(&[0.0, 1e-300], &[1e300; 2]), Err(SignalError::Number { .. })));
    }
}
