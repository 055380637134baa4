//! Peaks of a spectrum between its bins.

use core::f64::consts::TAU;

use profiles::Interval;

use super::Spectrum;
use crate::error::SignalError;

/// A sinusoid by the peak it makes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpectralPeak {
    /// Angular frequency, rad/s.
    pub angular_frequency: f64,
    /// Amplitude, in the unit of the record.
    pub amplitude: f64,
}

impl SpectralPeak {
    /// Frequency, Hz.
    #[must_use]
    pub fn hz(&self) -> f64 {
        self.angular_frequency / TAU
    }
}

impl Spectrum {
    /// The largest peak within a band in rad/s: a bin above its two neighbours, set between bins.
    ///
    /// The ratio of the bin to a neighbour gives the distance from the bin by the window's own transform, which is exact
    /// for a sinusoid alone; the side is the one whose sinusoid explains both neighbours, phases included. What its image
    /// at the negative frequency adds falls with the distance of the peak from both ends of the spectrum, all the faster
    /// for the smoother windows.
    ///
    /// # Errors
    /// No peak in the band, or a band that is NaN.
    pub fn peak(&self, band: Interval) -> Result<SpectralPeak, SignalError> {
        let none = SignalError::NoPeak { lower: band.lower, upper: band.upper };
        let (at, [before, top, after]) = self
            .amplitudes()
            .windows(3)
            .enumerate()
            .filter_map(|(k, three)| Some((k + 1, <[f64; 3]>::try_from(three).ok()?)))
            .filter(|(k, [before, top, after])| {
                let w = self.angular_frequency(*k);
                band.lower <= w && w <= band.upper && before < top && top >= after
            })
            .max_by(|(_, [_, a, _]), (_, [_, b, _])| a.total_cmp(b))
            .ok_or(none)?;
        let right = self.distance(after / top);
        let left = -self.distance(before / top);
        let offset = if self.mismatch(at, right) <= self.mismatch(at, left) { right } else { left };
        let spacing = TAU / self.length as f64;
        let lost = self.window.shape(offset * spacing, self.samples).norm() / self.window.coherent_gain();
        let angular_frequency = (at as f64 + offset) * self.spacing();
        Ok(SpectralPeak { angular_frequency, amplitude: top / lost })
    }

    /// How far the neighbours of a bin are from those of a sinusoid `offset` bins above it.
    fn mismatch(&self, at: usize, offset: f64) -> f64 {
        let spacing = TAU / self.length as f64;
        let shape = |bins: f64| self.window.shape(bins * spacing, self.samples);
        let bin = |k: usize| self.transform.get(k).copied().unwrap_or_default();
        let (top, middle) = (bin(at), shape(-offset));
        [(at - 1, -1.0), (at + 1, 1.0)]
            .map(|(k, side)| (bin(k) / top - shape(side - offset) / middle).norm_sqr())
            .iter()
            .sum()
    }

    /// The distance in bins, up to a half, at which a sinusoid gives two neighbours this ratio.
    fn distance(&self, ratio: f64) -> f64 {
        const HALVINGS: u32 = 50;
        let spacing = TAU / self.length as f64;
        let shape = |bins: f64| self.window.shape(bins * spacing, self.samples).norm_sqr();
        let (mut near, mut far) = (0.0, 0.5);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            // Within a peak the further bin is the lower, and rises as the peak moves towards it.
            if shape(1.0 - middle) < ratio * ratio * shape(middle) {
                near = middle;
            } else {
                far = middle;
            }
        }
        0.5 * (near + far)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{SpectrumOptions, Window, amplitude_spectrum};
    use super::*;

    /// Largest errors in bins and in parts of the amplitude, over frequencies and phases, of sinusoids some bins from
    /// both ends of the spectrum.
    fn errors(window: Window, margin: f64, least_length: usize) -> (f64, f64) {
        let samples = 256;
        let mut worst = (0.0_f64, 0.0_f64);
        for step in 0..200 {
            let bin = margin + f64::from(step) * (samples as f64 / 2.0 - 2.0 * margin) / 199.0;
            for phase in [0.0, 0.8, 1.6, 2.4, 3.2, 4.0, 4.8, 5.6] {
                let values: Vec<f64> = (0..samples)
                    .map(|n| 2.5 * (TAU * bin * f64::from(n) / f64::from(samples) + phase).cos())
                    .collect();
                let options = SpectrumOptions { window, remove_mean: false, least_length };
                let spectrum = amplitude_spectrum(&values, 0.01, &options).expect("valid");
                let peak = spectrum.peak(Interval::UNBOUNDED).expect("a peak");
                let found = peak.angular_frequency * 0.01 * f64::from(samples) / TAU;
                worst = (worst.0.max((found - bin).abs()), worst.1.max((peak.amplitude / 2.5 - 1.0).abs()));
            }
        }
        worst
    }

    #[test]
    fn off_the_bins_frequency_and_amplitude_stay_within_bounds() {
        // Images make the errors: those found, rounded up. The README names some.
        for (window, margin, least_length, bins, amplitude) in [
            (Window::Rectangular, 5.0, 0, 0.022, 0.008),
            (Window::Hann, 5.0, 0, 4e-4, 7e-5),
            (Window::Hamming, 5.0, 0, 0.006, 0.0012),
            (Window::Blackman, 5.0, 0, 2e-4, 3e-5),
            (Window::FlatTop, 6.0, 0, 0.0015, 2e-5),
            (Window::Rectangular, 20.0, 0, 0.006, 0.0022),
            (Window::Hann, 20.0, 0, 8e-6, 1.3e-6),
            (Window::Hamming, 20.0, 0, 0.0016, 4e-4),
            (Window::Blackman, 20.0, 0, 5e-6, 6e-7),
            (Window::FlatTop, 20.0, 0, 9e-4, 1.2e-5),
            (Window::Hann, 5.0, 1024, 8e-4, 1.5e-4),
        ] {
            let found = errors(window, margin, least_length);
            assert!(found.0 < bins && found.1 < amplitude, "{window:?} {margin} {least_length}: {found:?}");
        }
    }

    #[test]
    fn a_band_holds_its_own_peak_and_noise_does_not_move_it_far() {
        let value =
            |n: f64| (0.31 * n).cos() + 0.3 * (0.9 * n + 1.0).cos() + 0.2 * ((n * n * 7.13).sin() - 0.1);
        let values: Vec<f64> = (0..512).map(|n| value(f64::from(n))).collect();
        let spectrum = amplitude_spectrum(&values, 1.0, &SpectrumOptions::default()).expect("valid");
        let peak = |lower, upper| spectrum.peak(Interval { lower, upper });
        // A bin is 0.012 rad/s; the pseudo-random part has an eighth of the amplitude per sample, 1 % per bin.
        let largest = peak(0.0, 3.0).expect("a peak");
        assert!((largest.angular_frequency - 0.31).abs() < 0.001 && (largest.amplitude - 1.0).abs() < 0.03);
        let second = peak(0.6, 1.2).expect("a peak");
        assert!((second.angular_frequency - 0.9).abs() < 0.001 && (second.amplitude - 0.3).abs() < 0.03);
        assert!((second.hz() * TAU - second.angular_frequency).abs() < 1e-15);
        // The skirt of a peak is none.
        assert_eq!(peak(0.33, 0.331), Err(SignalError::NoPeak { lower: 0.33, upper: 0.331 }));
        assert!(matches!(peak(f64::NAN, 1.0), Err(SignalError::NoPeak { .. })));
        let silent = amplitude_spectrum(&[0.0; 64], 1.0, &SpectrumOptions::default()).expect("valid");
        assert!(silent.peak(Interval::UNBOUNDED).is_err());
    }
}
