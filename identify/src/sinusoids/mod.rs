//! Modes of a free decay, with the uncertainty of every number.

mod basis;
mod fit;
mod order;
mod pencil;

use profiles::{Mode, Real};

use crate::error::{SignalError, SinusoidError};
use crate::signal::Signal;
use basis::{Pole, order as order_of};
use fit::Fit;
use order::Problem;

/// What a fit of damped sinusoids may contain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SinusoidOptions {
    /// The largest order tried, 2 to 24: a mode counts two, a decay without oscillation one.
    pub largest_order: usize,
    /// Whether the signal may end off zero.
    pub offset: bool,
}

impl Default for SinusoidOptions {
    /// An order of at most ten and an offset.
    fn default() -> Self {
        Self { largest_order: 10, offset: true }
    }
}

/// A mode of a free decay: `amplitude e^(-z w t) cos(w_d t + phase)`, time from the first sample.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModeEstimate {
    /// Undamped angular frequency in rad/s and damping ratio.
    pub mode: Mode,
    /// Amplitude at the first sample, in the unit of the signal.
    pub amplitude: f64,
    /// Phase at the first sample, rad.
    pub phase: f64,
    /// Standard deviation of the undamped angular frequency, rad/s.
    pub frequency_deviation: f64,
    /// Standard deviation of the damping ratio.
    pub damping_deviation: f64,
}

/// A part that decays without oscillation: `amplitude e^(-rate t)`, time from the first sample.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DecayEstimate {
    /// Rate, 1/s.
    pub rate: f64,
    /// Standard deviation of the rate, 1/s.
    pub rate_deviation: f64,
    /// Amplitude at the first sample, in the unit of the signal.
    pub amplitude: f64,
}

/// A free decay as a sum of modes, decays and a constant.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DampedSinusoids {
    /// The modes, at least one, the largest amplitude first.
    pub modes: Vec<ModeEstimate>,
    /// The decays without oscillation, the largest amplitude first.
    pub decays: Vec<DecayEstimate>,
    /// The constant, in the unit of the signal; zero where none was asked for.
    pub offset: f64,
    /// Fit, percent: `100 (1 - |residual| / |signal - its mean|)`.
    pub fit: f64,
    /// Standard deviation of what the fit leaves, in the unit of the signal.
    pub noise: f64,
}

impl DampedSinusoids {
    /// The order chosen: two for every mode, one for every decay.
    #[must_use]
    pub fn order(&self) -> usize {
        2 * self.modes.len() + self.decays.len()
    }

    /// The mode that swings longest for its size: the one with the largest area under its envelope, amplitude over decay
    /// rate. The mode with the largest amplitude may be gone after half a swing.
    ///
    /// ```
    /// use identify::{SinusoidOptions, fit_damped_sinusoids};
    ///
    /// let decay = |a: f64, s: f64, w: f64| move |t: f64| a * (-s * t).exp() * (w * t).cos();
    /// let (short, long) = (decay(3.0, 160.0, 200.0), decay(1.0, 30.0, 470.0));
    /// let values: Vec<f64> = (0..2000).map(|n| f64::from(n) * 1e-4).map(|t| short(t) + long(t)).collect();
    /// let found = fit_damped_sinusoids(&values, 1e-4, &SinusoidOptions::default())?;
    /// assert!((found.modes[0].amplitude - 3.0).abs() < 1e-9);
    /// let lasting = found.lasting_mode().ok_or("no mode")?;
    /// assert!((lasting.mode.damped_angular_frequency() - 470.0).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn lasting_mode(&self) -> Option<&ModeEstimate> {
        let area = |estimate: &ModeEstimate| estimate.amplitude / -estimate.mode.pole().re;
        self.modes.iter().max_by(|a, b| area(a).total_cmp(&area(b)))
    }
}

/// Fits damped sinusoids to a free decay sampled every `period` s.
///
/// A matrix pencil proposes poles for every order; nonlinear least squares on all samples refine them; Schwarz's
/// criterion chooses the order. Standard deviations are those of the Fisher information with the noise that the fit
/// leaves: they hold for white noise, and for quantisation while the signal moves over several counts.
///
/// A damping ratio that comes out negative by less than three standard deviations is given as zero.
///
/// ```
/// use identify::{SinusoidOptions, fit_damped_sinusoids};
///
/// let values: Vec<f64> = (0..500).map(|n| n as f64 * 1e-3).map(|t| 2.0 + (-6.0 * t).exp() * (80.0 * t).cos()).collect();
/// let decay = fit_damped_sinusoids(&values, 1e-3, &SinusoidOptions::default())?;
/// assert_eq!(decay.order(), 2);
/// assert!((decay.modes[0].mode.damped_angular_frequency() - 80.0).abs() < 1e-10);
/// assert!((decay.offset - 2.0).abs() < 1e-12);
/// # Ok::<(), identify::SinusoidError>(())
/// ```
///
/// # Errors
/// A signal or options out of range, too few samples, no mode above the noise, a mode that grows.
pub fn fit_damped_sinusoids(
    values: &[f64],
    period: f64,
    options: &SinusoidOptions,
) -> Result<DampedSinusoids, SinusoidError> {
    const LARGEST: usize = 24;
    const FEWEST: usize = 16;
    Signal::sampled(values, period)?;
    if !(2..=LARGEST).contains(&options.largest_order) {
        return Err(SinusoidError::Order { given: options.largest_order, most: LARGEST });
    }
    if values.len() < FEWEST {
        return Err(SinusoidError::TooShort { samples: values.len(), needed: FEWEST });
    }
    // About the end of the record and in units of the largest value: neither unit nor offset costs digits.
    let tail = &values[values.len() - values.len() / 4..];
    let rest = if options.offset { tail.iter().map(|y| y / tail.len() as f64).sum() } else { 0.0 };
    let scale = values.iter().fold(0.0_f64, |scale, y| scale.max((y - rest).abs()));
    // Poles that nearly coincide have amplitudes far above the signal: keep them in range.
    if scale > 1e150 {
        return Err(SignalError::Number {
            quantity: "the range of the values",
            range: "at most 1e150",
            value: scale,
        }
        .into());
    }
    // Data of zeros have no scale; subnormal ones no inverse.
    if scale < f64::MIN_POSITIVE {
        return Err(SinusoidError::NoMode { noise: 0.0, decays: 0 });
    }
    let y: Vec<f64> = values.iter().map(|y| (y - rest) / scale).collect();
    let samples = y.len() as f64;
    let rounding = 1e-14 * (1.0 + rest.abs() / scale);
    let problem = Problem {
        y: &y,
        offset: options.offset,
        // Four samples to a parameter at least.
        largest_order: options.largest_order.min(y.len() / 8),
        floor: samples * rounding * rounding,
    };
    let found = problem.search().ok_or(SinusoidError::NoMode { noise: scale, decays: 0 })?;
    let parameters = 2 * order_of(&found.poles) + usize::from(options.offset);
    let variance = found.square / (samples - parameters as f64);
    let noise = scale * variance.sqrt();
    let covariance = found.inverse_curvature(options.offset, &y);
    let covariance = |i: usize, j: usize| covariance.as_ref().map_or(f64::INFINITY, |c| variance * c[(i, j)]);
    let mut result = described(&found, covariance, period, scale)?;
    let mean = y.iter().sum::<f64>() / samples;
    let spread: f64 = y.iter().map(|y| (y - mean) * (y - mean)).sum();
    if result.modes.is_empty() {
        return Err(SinusoidError::NoMode { noise, decays: result.decays.len() });
    }
    if options.offset {
        result.offset = rest + scale * found.amplitudes.last().copied().unwrap_or(0.0);
    }
    (result.noise, result.fit) = (noise, 100.0 * (1.0 - (found.square / spread).sqrt()));
    Ok(result)
}

/// The poles in units of time and of the signal.
fn described(
    found: &Fit,
    covariance: impl Fn(usize, usize) -> f64,
    period: f64,
    scale: f64,
) -> Result<DampedSinusoids, SinusoidError> {
    let mut result =
        DampedSinusoids { modes: Vec::new(), decays: Vec::new(), offset: 0.0, fit: 0.0, noise: 0.0 };
    let mut at = 0;
    for pole in &found.poles {
        let amplitude = |k: usize| found.amplitudes.get(at + k).copied().unwrap_or(0.0);
        match *pole {
            Pole::Real { decay } => result.decays.push(DecayEstimate {
                rate: decay / period,
                rate_deviation: covariance(at, at).sqrt() / period,
                amplitude: scale * amplitude(0),
            }),
            Pole::Pair { decay, turn } => {
                let radius = Real::sqrt(decay * decay + turn * turn);
                let (z, cos) = (decay / radius, turn / radius);
                let (vd, vt, vdt) = (covariance(at, at), covariance(at + 1, at + 1), covariance(at, at + 1));
                // Gradients of the radius, (z, cos), and of z, (cos^2, -z cos) over the radius.
                let deviation =
                    |d: f64, t: f64| (d * d * vd + t * t * vt + 2.0 * d * t * vdt).max(0.0).sqrt();
                let (frequency, damping) = (deviation(z, cos), deviation(cos * cos, -z * cos) / radius);
                let (c, s) = (amplitude(0), amplitude(1));
                // What rounding alone may do to the damping of an undamped sinusoid.
                if z < -(3.0 * damping).max(1e-10) {
                    return Err(SinusoidError::Unstable {
                        angular_frequency: radius / period,
                        damping_ratio: z,
                        deviation: damping,
                    });
                }
                if let Ok(mode) = Mode::new(radius / period, z.max(0.0)) {
                    result.modes.push(ModeEstimate {
                        mode,
                        amplitude: scale * Real::sqrt(c * c + s * s),
                        phase: Real::atan2(-s, c),
                        frequency_deviation: frequency / period,
                        damping_deviation: damping,
                    });
                }
            }
        }
        at += pole.order();
    }
    result.modes.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    result.decays.sort_by(|a, b| b.amplitude.abs().total_cmp(&a.amplitude.abs()));
    Ok(result)
}
