//! Amplitude spectrum of a record.

mod peak;
mod window;

use core::f64::consts::TAU;

use profiles::{Complex, Real};
use realfft::RealFftPlanner;

use crate::error::SignalError;
use crate::signal::Signal;
pub use peak::SpectralPeak;
pub use window::Window;

/// How a spectrum is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpectrumOptions {
    /// The weights of the samples.
    pub window: Window,
    /// Whether the mean is taken off first.
    pub remove_mean: bool,
    /// Zeros are added up to this number of samples: finer bins, no finer resolution. None are taken away.
    pub least_length: usize,
}

impl Default for SpectrumOptions {
    /// Hann's window, without the mean and without zeros added.
    fn default() -> Self {
        Self { window: Window::Hann, remove_mean: true, least_length: 0 }
    }
}

/// A single-sided amplitude spectrum: a sinusoid on a bin shows its amplitude, a constant its absolute value.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Spectrum {
    window: Window,
    samples: usize,
    length: usize,
    period: f64,
    amplitudes: Vec<f64>,
    #[cfg_attr(feature = "serde", serde(skip))]
    transform: Vec<Complex<f64>>,
}

/// The amplitude spectrum of a record sampled every `period` s.
///
/// With weights `w` and the discrete Fourier transform `X` of `w x`, `L` samples long with the zeros added,
///
/// ```text
/// amplitude[k] = 2 |X[k]| / sum(w)   at   2 pi k / (L period),   k = 0 ..= L / 2
/// ```
///
/// and half of that for the bins that have no counterpart at a negative frequency: `k = 0`, and `k = L / 2` of an
/// even `L`. In these amplitudes Parseval's theorem is
/// `L sum((w x)^2) / sum(w)^2 = A[0]^2 + sum(A[k]^2) / 2 + A[L / 2]^2`.
///
/// ```
/// use identify::{SpectrumOptions, amplitude_spectrum};
/// use profiles::Interval;
///
/// let record: Vec<f64> = (0..400).map(|n| 3.0 + 0.5 * (7.4 * 0.01 * f64::from(n)).cos()).collect();
/// let spectrum = amplitude_spectrum(&record, 0.01, &SpectrumOptions::default())?;
/// let peak = spectrum.peak(Interval::UNBOUNDED)?;
/// assert!((peak.angular_frequency - 7.4).abs() < 0.01);
/// assert!((peak.amplitude - 0.5).abs() < 0.005);
/// # Ok::<(), identify::SignalError>(())
/// ```
///
/// # Errors
/// Fewer than eight samples, values that are not finite, a period that is not positive and finite, a transform of more
/// than 2^28 samples.
///
/// # References
/// F. J. Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proceedings of the
/// IEEE 66 (1978), doi:10.1109/PROC.1978.10837.
pub fn amplitude_spectrum(
    values: &[f64],
    period: f64,
    options: &SpectrumOptions,
) -> Result<Spectrum, SignalError> {
    const FEWEST: usize = 8;
    const LONGEST: usize = 1 << 28;
    Signal::sampled(values, period)?;
    let samples = values.len();
    let length = samples.max(options.least_length);
    if samples < FEWEST {
        let quantity = "a record for a spectrum";
        return Err(SignalError::Length { quantity, range: "at least 8", length: samples });
    }
    if length > LONGEST {
        return Err(SignalError::Length { quantity: "a transform", range: "at most 2^28", length });
    }
    let spacing = TAU / (length as f64 * period);
    if !(spacing > 0.0 && (spacing * length as f64).is_finite()) {
        return Err(SignalError::Period(period));
    }
    // In units of the largest value sums do not overflow.
    let scale = values.iter().fold(f64::MIN_POSITIVE, |scale, y| scale.max(y.abs()));
    let count = samples as f64;
    let mean = if options.remove_mean { values.iter().map(|y| y / scale / count).sum() } else { 0.0 };
    let weights = options.window.weights(samples);
    let mut record: Vec<f64> = values.iter().zip(weights).map(|(y, w)| w * (y / scale - mean)).collect();
    record.resize(length, 0.0);
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(length);
    let mut bins = transform.make_output_vec();
    transform.process(&mut record, &mut bins).map_err(|_| SignalError::Length {
        quantity: "a transform",
        range: "at most 2^28",
        length,
    })?;
    let unit = scale / (count * options.window.coherent_gain());
    let amplitude = |(k, bin): (usize, &Complex<f64>)| {
        let sides = if k == 0 || 2 * k == length { 1.0 } else { 2.0 };
        sides * unit * Real::sqrt(bin.norm_sqr())
    };
    let amplitudes: Vec<f64> = bins.iter().enumerate().map(amplitude).collect();
    crate::signal::check(&amplitudes)?;
    Ok(Spectrum { window: options.window, samples, length, period, amplitudes, transform: bins })
}

impl Spectrum {
    /// The amplitudes, in the unit of the record, from frequency zero up to half the sample rate.
    #[must_use]
    pub fn amplitudes(&self) -> &[f64] {
        &self.amplitudes
    }

    /// Distance between bins, rad/s.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        TAU / (self.length as f64 * self.period)
    }

    /// The angular frequency of a bin, rad/s.
    #[must_use]
    pub fn angular_frequency(&self, bin: usize) -> f64 {
        bin as f64 * self.spacing()
    }

    /// The frequency of a bin, Hz.
    #[must_use]
    pub fn hz(&self, bin: usize) -> f64 {
        bin as f64 / (self.length as f64 * self.period)
    }

    /// Angular frequencies in rad/s and amplitudes.
    pub fn bins(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        self.amplitudes.iter().enumerate().map(|(k, amplitude)| (self.angular_frequency(k), *amplitude))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Window; 5] =
        [Window::Rectangular, Window::Hann, Window::Hamming, Window::Blackman, Window::FlatTop];

    fn record(samples: usize) -> Vec<f64> {
        (0..samples).map(|n| n as f64).map(|n| 1.0 + (0.3 * n).sin() + (0.01 * n * n).cos()).collect()
    }

    #[test]
    fn parseval() {
        for window in ALL {
            for (samples, least_length) in [(64, 0), (75, 0), (75, 128), (64, 301)] {
                let options = SpectrumOptions { window, remove_mean: false, least_length };
                let values = record(samples);
                let spectrum = amplitude_spectrum(&values, 0.01, &options).expect("valid");
                let length = samples.max(least_length);
                let weights = window.weights(samples);
                let square: f64 = values.iter().zip(&weights).map(|(x, w)| (x * w).powi(2)).sum();
                let sum: f64 = weights.iter().sum();
                let single = |k: usize| k == 0 || 2 * k == length;
                let energy: f64 = spectrum
                    .amplitudes()
                    .iter()
                    .enumerate()
                    .map(|(k, a)| if single(k) { a * a } else { 0.5 * a * a })
                    .sum();
                let expected = length as f64 * square / (sum * sum);
                assert!((energy / expected - 1.0).abs() < 1e-13, "{window:?} {samples} {least_length}");
            }
        }
    }

    #[test]
    fn the_transform_by_its_definition() {
        let values = record(50);
        let options = SpectrumOptions { window: Window::Blackman, remove_mean: true, least_length: 61 };
        let spectrum = amplitude_spectrum(&values, 0.02, &options).expect("valid");
        let mean = values.iter().sum::<f64>() / 50.0;
        for (w, amplitude) in spectrum.bins() {
            let part = |f: fn(f64) -> f64| -> f64 {
                let weights = Window::Blackman.weights(50);
                (0..50).map(|n| weights[n] * (values[n] - mean) * f(w * 0.02 * n as f64)).sum()
            };
            let sides = if w > 0.0 { 2.0 } else { 1.0 };
            let expected = sides * part(f64::cos).hypot(part(f64::sin)) / (50.0 * 0.42);
            assert!((amplitude - expected).abs() < 1e-14, "{w}");
        }
        assert_eq!(spectrum.amplitudes().len(), 31);
        assert!((spectrum.hz(3) * TAU - spectrum.angular_frequency(3)).abs() < 1e-12);
        assert!((spectrum.spacing() * 0.02 * 61.0 - TAU).abs() < 1e-12);
    }

    #[test]
    fn on_a_bin_the_amplitude_is_the_amplitude() {
        for window in ALL {
            // Constant, tenth bin and half the sample rate.
            let value = |n: usize| {
                let n = n as f64;
                -3.0 + 0.7 * (TAU * 20.0 * n / 100.0 + 0.4).cos() + 0.2 * (TAU * 50.0 * n / 100.0).cos()
            };
            let values: Vec<f64> = (0..100).map(value).collect();
            let options = SpectrumOptions { window, remove_mean: false, least_length: 0 };
            let spectrum = amplitude_spectrum(&values, 1.0, &options).expect("valid");
            for (bin, expected) in [(0, 3.0), (20, 0.7), (50, 0.2), (35, 0.0)] {
                assert!((spectrum.amplitudes()[bin] - expected).abs() < 1e-13, "{window:?} {bin}");
            }
        }
    }

    #[test]
    fn bad_records_are_named() {
        let options = SpectrumOptions::default();
        assert_eq!(amplitude_spectrum(&[], 1.0, &options), Err(SignalError::Empty));
        assert!(matches!(
            amplitude_spectrum(&[1.0; 7], 1.0, &options),
            Err(SignalError::Length { length: 7, .. })
        ));
        assert!(matches!(
            amplitude_spectrum(&[f64::NAN; 9], 1.0, &options),
            Err(SignalError::Value { index: 0, .. })
        ));
        assert_eq!(amplitude_spectrum(&[1.0; 9], -1.0, &options), Err(SignalError::Period(-1.0)));
        assert!(matches!(amplitude_spectrum(&[1.0; 9], 1e-310, &options), Err(SignalError::Period(_))));
        let long = SpectrumOptions { least_length: usize::MAX, ..options };
        assert!(matches!(amplitude_spectrum(&[1.0; 9], 1.0, &long), Err(SignalError::Length { .. })));
        let largest =
            amplitude_spectrum(&[1e308; 9], 1.0, &SpectrumOptions { remove_mean: false, ..options });
        assert!((largest.expect("finite").amplitudes()[0] / 1e308 - 1.0).abs() < 1e-14);
    }
}
