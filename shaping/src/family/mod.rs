//! The family of shapers for one mode.

mod extra_insensitive;
mod negative;
pub(crate) mod spaced;

use profiles::Mode;

use crate::error::ShaperError;
use crate::train::ImpulseTrain;

/// A way to quiet one mode with a train of impulses, before it is known which mode.
///
/// ```
/// use profiles::Mode;
/// use shaping::{ImpulseTrain, Shaper};
///
/// let mode = Mode::from_hz(40.0, 0.1)?;
/// // Two impulses half a period apart; three that keep below 5 % over a band of frequencies.
/// let zv: ImpulseTrain<2> = Shaper::ZV.train(mode)?;
/// let ei: ImpulseTrain<3> = Shaper::extra_insensitive(0.05).train(mode)?;
/// assert!(zv.residual(mode) < 1e-15);
/// assert!((ei.residual(mode) - 0.05).abs() < 1e-13);
/// assert!(ei.insensitivity(mode, 0.0501).is_some_and(|band| band.upper > 0.24));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
#[non_exhaustive]
pub enum Shaper {
    /// A zero of this order on the mode: `order + 1` positive impulses half a damped period apart, with the amplitudes
    /// `C(order, k) K^k` over their sum, `K = e^(-pi z / sqrt(1 - z^2))`.
    ///
    /// # References
    /// N. C. Singer, W. P. Seering, Preshaping command inputs to reduce system vibration, Journal of Dynamic Systems,
    /// Measurement, and Control 112 (1990) 76-82, [doi:10.1115/1.2894142](https://doi.org/10.1115/1.2894142).
    ZeroVibration {
        /// Order of the zero: 1 for ZV, 2 for ZVD, 3 for ZVDD.
        order: usize,
    },
    /// MZV(n, t): positive impulses spread evenly over a part of a damped period, whose zeros go evenly from the mode up to
    /// its alias. Three impulses are a [`DelayFilter`](crate::DelayFilter) with a delay of `span / 2` damped periods.
    EquallySpaced {
        /// Number of impulses, 3 or more.
        impulses: usize,
        /// Time from the first to the last, damped periods.
        span: f64,
    },
    /// EI and its relatives with two and three humps: the vibration of the mode is not zero but within a tolerance, and so
    /// is that of every frequency in a band as wide as can be. Between `humps + 1` frequencies of no vibration stand `humps`
    /// maxima as high as the tolerance, the middle one (or the middle zero) on the mode.
    ///
    /// Undamped amplitudes are those of a Chebyshev polynomial in `cos(w t / 2)`; with damping every one of these
    /// conditions is solved for, to rounding.
    ///
    /// # References
    /// W. E. Singhose, W. P. Seering, N. C. Singer, Residual vibration reduction using vector diagrams to generate
    /// shaped inputs, Journal of Mechanical Design 116 (1994) 654-659,
    /// [doi:10.1115/1.2919428](https://doi.org/10.1115/1.2919428).
    ExtraInsensitive {
        /// Number of humps: 1, 2 or 3.
        humps: usize,
        /// The tolerated vibration, as a part of that of a step.
        tolerance: f64,
    },
    /// Impulses of alternating sign that quiet the mode sooner. Their magnitudes add up to `demand`, by which they
    /// multiply acceleration and jerk at worst; the command itself is never exceeded, nor reversed.
    ///
    /// The amplitudes lie between those of the positive train (`demand` 1) and those of unity magnitude, 1, -1, 1 ...
    /// (`demand` 3, or 5 for order 2); undamped and of order 1 it is the specified-negative-amplitude shaper.
    ///
    /// # References
    /// W. E. Singhose, N. C. Singer, W. P. Seering, Time-optimal negative input shapers, Journal of Dynamic Systems,
    /// Measurement, and Control 119 (1997) 198-205,
    /// [doi:10.1115/1.2801233](https://doi.org/10.1115/1.2801233).
    Negative {
        /// Order of the zero on the mode: 1 or 2.
        order: usize,
        /// Sum of the magnitudes, from 1 to `2 order + 1`.
        demand: f64,
    },
}

impl Shaper {
    /// Zero vibration.
    pub const ZV: Self = Self::ZeroVibration { order: 1 };
    /// Zero vibration and derivative.
    pub const ZVD: Self = Self::ZeroVibration { order: 2 };
    /// Zero vibration and two derivatives.
    pub const ZVDD: Self = Self::ZeroVibration { order: 3 };
    /// Three impulses over three quarters of a damped period.
    pub const MZV: Self = Self::EquallySpaced { impulses: 3, span: 0.75 };
    /// Zero vibration by impulses 1, -1, 1.
    pub const UNITY_MAGNITUDE_ZV: Self = Self::Negative { order: 1, demand: 3.0 };
    /// Zero vibration and derivative by impulses 1, -1, 1, -1, 1.
    pub const UNITY_MAGNITUDE_ZVD: Self = Self::Negative { order: 2, demand: 5.0 };

    /// The extra-insensitive shaper with one hump.
    #[must_use]
    pub const fn extra_insensitive(tolerance: f64) -> Self {
        Self::ExtraInsensitive { humps: 1, tolerance }
    }

    /// The train for `mode`.
    ///
    /// # Errors
    /// A parameter outside its range, a train longer than `N`, an [`EquallySpaced`](Self::EquallySpaced) that would need
    /// a negative impulse, or a damping for which the shaper does not exist: a tolerance is met anyway, after a while,
    /// where vibration dies soon.
    pub fn train<const N: usize>(&self, mode: Mode) -> Result<ImpulseTrain<N>, ShaperError> {
        match *self {
            Self::ZeroVibration { order } => spaced::zero_vibration(mode, order),
            Self::EquallySpaced { impulses, span } => spaced::equally_spaced(mode, impulses, span),
            Self::ExtraInsensitive { humps, tolerance } => {
                extra_insensitive::extra_insensitive(mode, humps, tolerance)
            }
            Self::Negative { order, demand } => negative::negative(mode, order, demand),
        }
    }
}
