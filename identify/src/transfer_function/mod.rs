//! A transfer function from samples of an input and an output.

mod chain;
mod estimate;
mod fit;
mod roots;
mod start;

use profiles::{Complex, Real};

use crate::error::{SignalError, TransferFunctionError};
use crate::signal::Signal;
use fit::{Model, Problem};

/// What the input does between samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Hold {
    /// It stays at its sample until the next: the output of a digital controller.
    #[default]
    Zero,
    /// It runs straight to the next sample: a slow input, or one that was averaged over each sample period, as
    /// counts per sample are. Averages of an input that changes at samples only are exactly that; what jumps between
    /// samples misplaces the poles by a part of the order of `(w period)^2 / 12`.
    First,
}

/// What a fit of a transfer function looks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TransferFunctionOptions {
    /// Number of poles, 1 to 8.
    pub poles: usize,
    /// Number of zeros, at most as many as poles.
    pub zeros: usize,
    /// What the input does between samples.
    pub hold: Hold,
    /// Whether the system may be in motion at the first sample; it is at rest otherwise.
    pub initial_state: bool,
    /// Whether the output may be off by a constant.
    pub offset: bool,
    /// Number of lags over which what the fit leaves may be correlated, for the standard deviations: zero for white
    /// noise, up to a quarter of the samples. After a filter take four times its length: deviations are then low by a
    /// fifth at most.
    pub noise_lags: usize,
}

impl TransferFunctionOptions {
    /// So many poles and zeros; an input held between samples, a start at rest, no offset, white noise.
    #[must_use]
    pub const fn new(poles: usize, zeros: usize) -> Self {
        Self { poles, zeros, hold: Hold::Zero, initial_state: false, offset: false, noise_lags: 0 }
    }
}

/// A pole or a zero with its standard deviations, infinite for a double one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RootEstimate {
    /// Real part, rad/s.
    pub real: f64,
    /// Imaginary part, rad/s.
    pub imaginary: f64,
    /// Standard deviation of the real part, rad/s.
    pub real_deviation: f64,
    /// Standard deviation of the imaginary part, rad/s.
    pub imaginary_deviation: f64,
    /// Standard deviation of the undamped angular frequency, rad/s.
    pub frequency_deviation: f64,
    /// Standard deviation of the damping ratio.
    pub damping_deviation: f64,
}

impl RootEstimate {
    /// The root, rad/s.
    #[must_use]
    pub fn value(&self) -> Complex<f64> {
        Complex::new(self.real, self.imaginary)
    }

    /// Undamped angular frequency, the distance from the origin, rad/s.
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        let scale = Real::max(self.real.abs(), self.imaginary.abs());
        if scale > 0.0 {
            let (re, im) = (self.real / scale, self.imaginary / scale);
            scale * Real::sqrt(re * re + im * im)
        } else {
            0.0
        }
    }

    /// Damping ratio: minus the real part over the undamped angular frequency; one for a real root on the left, and
    /// for one at the origin.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        let radius = self.angular_frequency();
        if radius > 0.0 { -self.real / radius } else { 1.0 }
    }
}

/// A transfer function `(b[0] s^m + ... + b[m]) / (s^n + a[1] s^(n-1) + ... + a[n])`, all poles in the left half
/// plane, s in rad/s.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TransferFunctionFit {
    /// Numerator, the highest power of s first.
    pub numerator: Vec<f64>,
    /// Standard deviations of the numerator.
    pub numerator_deviations: Vec<f64>,
    /// Denominator, the highest power of s first, whose coefficient is one.
    pub denominator: Vec<f64>,
    /// Standard deviations of the denominator; zero for the first.
    pub denominator_deviations: Vec<f64>,
    /// Covariance of the numerator and, behind it, the denominator without its first, row by row.
    pub covariance: Vec<Vec<f64>>,
    /// The poles, the slowest first, the upper one of a pair first.
    pub poles: Vec<RootEstimate>,
    /// The zeros, the slowest first, the upper one of a pair first.
    pub zeros: Vec<RootEstimate>,
    /// Gain at frequency zero, output over input.
    pub dc_gain: f64,
    /// Standard deviation of the gain at frequency zero.
    pub dc_gain_deviation: f64,
    /// The constant added to the output; zero where none was asked for.
    pub offset: f64,
    /// Output of the model under the input given, from the fitted initial state, with the offset.
    pub output: Vec<f64>,
    /// Fit, percent: [`fit_percentage`](crate::fit_percentage).
    pub fit: f64,
    /// Standard deviation of what the fit leaves, in the unit of the output.
    pub residual_deviation: f64,
}

impl TransferFunctionFit {
    /// Gain of the zero-pole-gain form: the first coefficient of the numerator.
    #[must_use]
    pub fn gain(&self) -> f64 {
        self.numerator.first().copied().unwrap_or(0.0)
    }

    /// The response at an angular frequency, rad/s: output over input.
    #[must_use]
    pub fn frequency_response(&self, angular_frequency: f64) -> Complex<f64> {
        let s = Complex::new(0.0, angular_frequency);
        let at = |c: &[f64]| roots::value(c.iter().rev().copied(), s);
        at(&self.numerator) / at(&self.denominator)
    }
}

/// Fits a continuous-time transfer function to an input and an output, both sampled every `period` s.
///
/// Least squares on filtered data and an instrumental variable give a start for every bandwidth the record can hold.
/// From the best of them Levenberg and Marquardt's method minimises the output error, the difference between the
/// output and that of the model under the input alone, with exact derivatives: model and sensitivities are stepped
/// exactly for an input that is held or straight between samples. The output error forgives a noisy output; the
/// input must be known.
///
/// Standard deviations are those of the linearised least squares with the noise that the fit leaves.
///
/// ```
/// use identify::{TransferFunctionOptions, fit_transfer_function};
///
/// // 3 / (s + 2) under a step, sampled every 50 ms.
/// let input = [1.0; 60];
/// let output: Vec<f64> = (0..60).map(|n| 1.5 * (1.0 - (-0.1 * f64::from(n)).exp())).collect();
/// let found = fit_transfer_function(&input, &output, 0.05, &TransferFunctionOptions::new(1, 0))?;
/// assert!((found.numerator[0] - 3.0).abs() < 1e-9 && (found.poles[0].real + 2.0).abs() < 1e-9);
/// assert!((found.dc_gain - 1.5).abs() < 1e-9 && found.fit > 99.999);
/// # Ok::<(), identify::TransferFunctionError>(())
/// ```
///
/// # Errors
/// Data that cannot be or do not fit each other, orders out of range, too few samples, an input or output without
/// content, an output that does not follow the input, more parameters than the data tell apart, and a model whose
/// poles are not all in the left half plane.
///
/// # References
/// L. Ljung, "System Identification: Theory for the User", 2nd ed., Prentice Hall, 1999, sections 4.2, 9.4 and 10.2.
pub fn fit_transfer_function(
    input: &[f64],
    output: &[f64],
    period: f64,
    options: &TransferFunctionOptions,
) -> Result<TransferFunctionFit, TransferFunctionError> {
    const MOST: usize = 8;
    const TRIED: usize = 4;
    const TRIAL: usize = 6;
    const TO_THE_END: usize = 100;
    if input.len() != output.len() {
        return Err(TransferFunctionError::Lengths { input: input.len(), output: output.len() });
    }
    Signal::sampled(input, period)?;
    Signal::sampled(output, period)?;
    if !(1..=MOST).contains(&options.poles) || options.zeros > options.poles {
        let (poles, zeros) = (options.poles, options.zeros);
        return Err(TransferFunctionError::Order { poles, zeros, most: MOST });
    }
    let unscaled = Problem { input, output, options, floor: 0.0 };
    // Two samples to a parameter at least.
    let needed = 2 * (unscaled.linear_parameters() + options.poles).max(4);
    if output.len() < needed {
        return Err(TransferFunctionError::TooShort { samples: output.len(), needed });
    }
    let input_scale = scale("the input", input)?;
    let output_scale = scale("the output", output)?;
    let scaled = |data: &[f64], scale: f64| data.iter().map(|x| x / scale).collect::<Vec<f64>>();
    let (u, y) = (scaled(input, input_scale), scaled(output, output_scale));
    let floor = y.len() as f64 * 1e-28;
    let problem = Problem { input: &u, output: &y, floor, ..unscaled };

    let best = start::starts(&problem)
        .into_iter()
        .take(TRIED)
        .map(|model| problem.refined(model, TRIAL))
        .min_by(|a, b| a.square.total_cmp(&b.square))
        .ok_or(TransferFunctionError::Undetermined { condition: f64::INFINITY })?;
    let best = problem.refined(rescaled(&problem, best), TO_THE_END);
    estimate::described(&problem, &best, estimate::Units { input_scale, output_scale, period })
}

/// The largest absolute value.
fn scale(quantity: &'static str, data: &[f64]) -> Result<f64, TransferFunctionError> {
    let scale = data.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
    if scale > 1e150 {
        return Err(SignalError::Number { quantity, range: "at most 1e150", value: scale }.into());
    }
    // Data of zeros have no scale; those near the smallest numbers no digits.
    if scale < 1e-150 {
        return Err(TransferFunctionError::NoExcitation { quantity, largest: scale });
    }
    Ok(scale)
}

/// The model in a unit of time in which its poles are about one.
fn rescaled(problem: &Problem<'_>, model: Model) -> Model {
    let n = model.a.len();
    let lowest = model.a.first().map_or(1.0, |a| a.abs());
    let unit = Real::powf(lowest, 1.0 / n as f64);
    if !(unit > 1e-3 && unit < 1e3) {
        return model;
    }
    let a = model.a.iter().enumerate().map(|(k, a)| a / unit.powi((n - k) as i32)).collect();
    problem.model(a, model.step * unit).unwrap_or(model)
}
