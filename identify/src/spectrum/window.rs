//! Windows that are sums of cosines.

use core::f64::consts::{PI, TAU};

use profiles::{Complex, Real};

/// What weighs the samples before the transform: `w[n] = c[0] - c[1] cos(2 pi n / N) + c[2] cos(4 pi n / N) - ...`,
/// the periodic form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Window {
    /// No weights: the narrowest peaks, on the highest skirts.
    Rectangular,
    /// Skirts that fall with the third power of the distance.
    #[default]
    Hann,
    /// The lowest first skirt that two terms can have.
    Hamming,
    /// Lower skirts, wider peaks.
    Blackman,
    /// Peaks five bins wide to either side whose top tells the amplitude between bins to 0.2 %.
    FlatTop,
}

impl Window {
    /// The weights of the cosines, ascending; their signs alternate.
    fn terms(self) -> &'static [f64] {
        match self {
            Self::Rectangular => &[1.0],
            Self::Hann => &[0.5, 0.5],
            Self::Hamming => &[0.54, 0.46],
            Self::Blackman => &[0.42, 0.5, 0.08],
            Self::FlatTop => &[0.215_578_95, 0.416_631_58, 0.277_263_158, 0.083_578_947, 0.006_947_368],
        }
    }

    /// Mean of the weights: what is left of the amplitude of a sinusoid.
    #[must_use]
    pub fn coherent_gain(self) -> f64 {
        self.terms().first().copied().unwrap_or(1.0)
    }

    /// Width in bins of the rectangle that lets through as much white noise: `N sum(w^2) / sum(w)^2`.
    #[must_use]
    pub fn noise_bandwidth(self) -> f64 {
        let gain = self.coherent_gain();
        let others: f64 = self.terms().iter().skip(1).map(|c| 0.5 * c * c).sum();
        1.0 + others / (gain * gain)
    }

    /// The weights for a record of so many samples.
    #[must_use]
    pub fn weights(self, samples: usize) -> Vec<f64> {
        let turn = TAU / samples as f64;
        (0..samples)
            .map(|n| {
                let term = |(j, c): (usize, &f64)| {
                    let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
                    // Whole turns are dropped before they cost digits.
                    sign * c * Real::cos(turn * ((j * n) % samples) as f64)
                };
                self.terms().iter().enumerate().map(term).sum()
            })
            .collect()
    }

    /// `sum over n of w[n] e^(-i turn n)` over `N`: the shape of a peak, `turn` rad per sample off its middle.
    pub(super) fn shape(self, turn: f64, samples: usize) -> Complex<f64> {
        let count = samples as f64;
        // Every cosine is two exponentials, each of them a geometric sum.
        let kernel = |x: f64| {
            let half = Real::sin(0.5 * x);
            if half.abs() < 1e-12 { 1.0 } else { Real::sin(0.5 * count * x) / (count * half) }
        };
        let sum = self.terms().iter().enumerate().fold(Complex::new(0.0, 0.0), |sum, (j, c)| {
            if j == 0 {
                return sum + c * kernel(turn);
            }
            let (shift, phase) = (TAU * j as f64 / count, PI * j as f64 / count);
            let (sin, cos) = Real::sin_cos(phase);
            let (above, below) = (kernel(turn + shift), kernel(turn - shift));
            sum + Complex::new(cos * (above + below), sin * (above - below)) * (0.5 * c)
        });
        let (sin, cos) = Real::sin_cos(0.5 * (count - 1.0) * turn);
        sum * Complex::new(cos, -sin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Window; 5] =
        [Window::Rectangular, Window::Hann, Window::Hamming, Window::Blackman, Window::FlatTop];

    #[test]
    fn the_shape_is_the_sum() {
        for window in ALL {
            for samples in [11, 64, 301_usize] {
                let weights = window.weights(samples);
                for turn in [0.0, 1e-13, 0.003, TAU / samples as f64, 0.1, 0.5, 3.0] {
                    let sum: Complex<f64> = weights
                        .iter()
                        .enumerate()
                        .map(|(n, w)| Complex::from_polar(*w, -turn * n as f64))
                        .sum();
                    let shape = window.shape(turn, samples);
                    assert!((sum / samples as f64 - shape).norm() < 1e-12, "{window:?} {samples} {turn}");
                }
            }
        }
    }

    #[test]
    fn gain_and_bandwidth() {
        for window in ALL {
            let weights = window.weights(100);
            let (sum, square): (f64, f64) = (weights.iter().sum(), weights.iter().map(|w| w * w).sum());
            assert!((window.coherent_gain() - sum / 100.0).abs() < 1e-14);
            assert!((window.noise_bandwidth() - 100.0 * square / (sum * sum)).abs() < 1e-12);
        }
        // As printed by F. J. Harris, 1978, table I (Blackman's rounded there).
        assert!((Window::Hann.noise_bandwidth() - 1.50).abs() < 0.005);
        assert!((Window::Hamming.noise_bandwidth() - 1.36).abs() < 0.005);
        assert!((Window::Blackman.noise_bandwidth() - 1.73).abs() < 0.005);
    }
}
