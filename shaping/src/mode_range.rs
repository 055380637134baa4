//! What a mode may turn out to be.

use profiles::{Interval, Mode, ModeError};

use crate::error::ModeRangeError;

/// A box of modes: every undamped angular frequency and damping ratio within two intervals.
///
/// ```
/// use profiles::Mode;
/// use shaping::ModeRange;
///
/// // 10 % either way in frequency, 0.01 to 0.03 of damping
/// let range = ModeRange::around(Mode::from_hz(40.0, 0.02)?, 0.1, 0.01)?;
/// assert!((range.damping_ratio().upper - 0.03).abs() < 1e-15);
/// assert!(range.contains(Mode::from_hz(43.9, 0.011)?) && !range.contains(Mode::from_hz(44.1, 0.02)?));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "WrittenRange", into = "WrittenRange"))]
pub struct ModeRange {
    /// Slowest and least damped, fastest and most damped.
    lowest: Mode,
    highest: Mode,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenRange {
    angular_frequency: Interval,
    damping_ratio: Interval,
}

#[cfg(feature = "serde")]
impl TryFrom<WrittenRange> for ModeRange {
    type Error = ModeRangeError;
    fn try_from(range: WrittenRange) -> Result<Self, ModeRangeError> {
        Self::new(range.angular_frequency, range.damping_ratio)
    }
}

#[cfg(feature = "serde")]
impl From<ModeRange> for WrittenRange {
    fn from(range: ModeRange) -> Self {
        Self { angular_frequency: range.angular_frequency(), damping_ratio: range.damping_ratio() }
    }
}

impl ModeRange {
    /// The modes with an undamped angular frequency in rad/s and a damping ratio within these intervals.
    ///
    /// # Errors
    /// Ends out of order, a frequency that is not positive and finite, or a damping ratio outside `[0, 1)`.
    pub fn new(angular_frequency: Interval, damping_ratio: Interval) -> Result<Self, ModeRangeError> {
        let (w, z) = (angular_frequency, damping_ratio);
        let frequency = ModeRangeError::Frequency { lower: w.lower, upper: w.upper };
        let damping = ModeRangeError::DampingRatio { lower: z.lower, upper: z.upper };
        if !w.contains(w.lower) {
            return Err(frequency);
        }
        if !z.contains(z.lower) {
            return Err(damping);
        }
        let corner = |w: f64, z: f64| {
            Mode::new(w, z).map_err(|error| match error {
                ModeError::DampingRatio(_) => damping,
                _ => frequency,
            })
        };
        Ok(Self { lowest: corner(w.lower, z.lower)?, highest: corner(w.upper, z.upper)? })
    }

    /// The modes whose frequency is off that of `mode` by at most the part `frequency_error` of it, and whose damping ratio
    /// by at most `damping_error`, as far as there is one.
    ///
    /// # Errors
    /// Errors that are negative or NaN, a frequency error of one or more, or a damping ratio that would reach one.
    pub fn around(mode: Mode, frequency_error: f64, damping_error: f64) -> Result<Self, ModeRangeError> {
        let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
        let frequency = Interval::new(w * (1.0 - frequency_error), w * (1.0 + frequency_error));
        // A negative error must not pass for a damping that is cut off at zero.
        let lower = if damping_error >= 0.0 { (z - damping_error).max(0.0) } else { f64::NAN };
        Self::new(frequency, Interval::new(lower, z + damping_error))
    }

    /// Undamped angular frequencies, rad/s.
    #[must_use]
    pub fn angular_frequency(&self) -> Interval {
        Interval::new(self.lowest.angular_frequency(), self.highest.angular_frequency())
    }

    /// Damping ratios.
    #[must_use]
    pub fn damping_ratio(&self) -> Interval {
        Interval::new(self.lowest.damping_ratio(), self.highest.damping_ratio())
    }

    /// The mode with the lowest frequency and damping ratio.
    #[must_use]
    pub fn lowest(&self) -> Mode {
        self.lowest
    }

    /// The mode with the highest frequency and damping ratio.
    #[must_use]
    pub fn highest(&self) -> Mode {
        self.highest
    }

    /// Whether `mode` is one of them.
    #[must_use]
    pub fn contains(&self, mode: Mode) -> bool {
        self.angular_frequency().contains(mode.angular_frequency())
            && self.damping_ratio().contains(mode.damping_ratio())
    }
}

impl From<Mode> for ModeRange {
    /// One mode, known exactly.
    fn from(mode: Mode) -> Self {
        Self { lowest: mode, highest: mode }
    }
}
