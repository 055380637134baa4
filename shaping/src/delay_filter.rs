//! The delay filter with three impulses.

use core::f64::consts::TAU;

use profiles::{Mode, Real};

use crate::error::DelayFilterError;
use crate::family::spaced::Spaced;
use crate::train::ImpulseTrain;

/// Impulses beyond this would amplify the rounding of a command to a visible part of it.
const LARGEST: f64 = 1e6;

/// Three impulses at 0, `T` and `2 T` that leave nothing of a mode, for any delay `T`.
///
/// With the pole `p = -z w + i w_d` of the mode the filter is
///
/// `H(s) = (1 - e^(p T) e^(-s T)) (1 - e^(p* T) e^(-s T)) / |1 - e^(p T)|^2`
///
/// so that both of its first zeros lie on the pole pair. Its amplitudes are `1`, `-2 c k` and `k^2` over their sum, with
/// `c = cos(w_d T)` and `k = e^(-z w T)`. The delay of half a damped period gives the ZVD shaper.
///
/// ```
/// use profiles::Mode;
/// use shaping::DelayFilter;
///
/// let mode = Mode::new(439.92, 0.0722)?; // rad/s
/// let filter = DelayFilter::positive(mode, 0.006)?; // s
/// let [first, second, third] = filter.amplitudes();
/// assert!((first - 0.3198).abs() < 1e-4 && (second - 0.4617).abs() < 1e-4 && (third - 0.2185).abs() < 1e-4);
/// assert!(filter.train().residual(mode) < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DelayFilter {
    delay: f64,
    train: ImpulseTrain<3>,
}

impl DelayFilter {
    /// A filter for `mode` with impulses `delay` s apart, the middle one negative where the delay asks for it.
    ///
    /// # Errors
    /// A delay that is not positive and finite, or so nearly whole periods of an almost undamped mode that an impulse
    /// would exceed a million.
    pub fn new(mode: Mode, delay: f64) -> Result<Self, DelayFilterError> {
        if !(delay > 0.0 && delay.is_finite()) {
            return Err(DelayFilterError::Delay(delay));
        }
        let pole = mode.pole();
        let angle = pole.im * delay;
        let filter = Spaced::<3>::one().with_pair(Real::exp(pole.re * delay), angle);
        let largest = filter.largest();
        let too_large = || DelayFilterError::WholePeriods { delay, turns: angle / TAU, largest };
        if largest.is_nan() || largest > LARGEST {
            return Err(too_large());
        }
        let train = filter.train(delay).map_err(|_| too_large())?;
        Ok(Self { delay, train })
    }

    /// As [`DelayFilter::new`], with positive impulses only: no command is ever exceeded.
    ///
    /// # Errors
    /// As there, and a delay outside 1/4 to 3/4 of a damped period beyond whole ones.
    pub fn positive(mode: Mode, delay: f64) -> Result<Self, DelayFilterError> {
        let filter = Self::new(mode, delay)?;
        if filter.amplitudes().iter().any(|amplitude| *amplitude < 0.0) {
            let turns = delay / mode.damped_period();
            return Err(DelayFilterError::Negative { delay, turns });
        }
        Ok(filter)
    }

    /// The filter with half a damped period between its impulses: zero vibration and zero derivative (ZVD).
    ///
    /// # Errors
    /// A mode so slow that the delay is beyond the range of double precision.
    pub fn zvd(mode: Mode) -> Result<Self, DelayFilterError> {
        Self::new(mode, 0.5 * mode.damped_period())
    }

    /// Time between two impulses, s.
    #[must_use]
    pub fn delay(&self) -> f64 {
        self.delay
    }

    /// The three amplitudes, which add up to one.
    #[must_use]
    pub fn amplitudes(&self) -> [f64; 3] {
        let mut amplitudes = [0.0; 3];
        for (amplitude, impulse) in amplitudes.iter_mut().zip(self.train.impulses()) {
            *amplitude = impulse.amplitude;
        }
        amplitudes
    }

    /// The filter as a train.
    #[must_use]
    pub fn train(&self) -> &ImpulseTrain<3> {
        &self.train
    }
}
