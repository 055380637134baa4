//! An incremental or absolute encoder.

use profiles::Real;

use crate::error::ModelError;

/// An encoder that rounds a position to the nearest count, halves away from zero.
///
/// ```
/// use plants::Encoder;
///
/// let scale = Encoder::new(0.5e-6)?;
/// assert_eq!(scale.counts(1.3e-6), 3);
/// assert_eq!(scale.quantise(1.3e-6), 1.5e-6);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedEncoder"))]
pub struct Encoder {
    resolution: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedEncoder {
    resolution: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedEncoder> for Encoder {
    type Error = ModelError;
    fn try_from(encoder: UncheckedEncoder) -> Result<Self, ModelError> {
        Self::new(encoder.resolution)
    }
}

impl Encoder {
    /// An encoder from its resolution in m or rad per count.
    ///
    /// # Errors
    /// A resolution that is not positive and finite.
    pub fn new(resolution: f64) -> Result<Self, ModelError> {
        if resolution > 0.0 && resolution.is_finite() {
            Ok(Self { resolution })
        } else {
            Err(ModelError::Parameter {
                parameter: "the resolution in m or rad",
                range: "positive and finite",
                value: resolution,
            })
        }
    }

    /// An encoder from its counts (pulses, after whatever its electronics multiply) per rad or per m.
    ///
    /// ```
    /// use plants::Encoder;
    ///
    /// let tail = Encoder::from_counts_per_unit(22_800.0)?; // pulses/rad
    /// assert_eq!(tail.counts(2.0), 45_600);
    /// assert_eq!(tail.counts_per_unit(), 22_800.0);
    /// # Ok::<(), plants::ModelError>(())
    /// ```
    ///
    /// # Errors
    /// A number that is not positive and finite, or whose reciprocal is not.
    pub fn from_counts_per_unit(counts: f64) -> Result<Self, ModelError> {
        let resolution = 1.0 / counts;
        if resolution > 0.0 && resolution.is_finite() {
            Ok(Self { resolution })
        } else {
            Err(ModelError::Parameter {
                parameter: "the counts per m or rad",
                range: "positive and finite",
                value: counts,
            })
        }
    }

    /// Counts per m or rad.
    #[must_use]
    pub fn counts_per_unit(&self) -> f64 {
        1.0 / self.resolution
    }

    /// The resolution, m or rad per count.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// The counts nearest to a position in m or rad, held within the range of `i64`; zero for NaN.
    #[must_use]
    pub fn counts(&self, position: f64) -> i64 {
        // A cast from float to integer saturates, and gives zero for NaN.
        Real::round(position / self.resolution) as i64
    }

    /// The position that the counts stand for, m or rad: within half a resolution of the position given.
    #[must_use]
    pub fn quantise(&self, position: f64) -> f64 {
        self.counts(position) as f64 * self.resolution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_round_away_from_zero() {
        let encoder = Encoder::new(0.25).expect("valid");
        let counts: Vec<i64> =
            [-0.375, -0.374, -0.1, 0.0, 0.124, 0.125, 0.375].map(|x| encoder.counts(x)).to_vec();
        assert_eq!(counts, [-2, -1, 0, 0, 0, 1, 2]);
    }

    #[test]
    fn the_ends_of_the_range_hold() {
        let encoder = Encoder::new(1e-9).expect("valid");
        assert_eq!(encoder.counts(1e30), i64::MAX);
        assert_eq!(encoder.counts(f64::NEG_INFINITY), i64::MIN);
        assert_eq!(encoder.counts(f64::NAN), 0);
        for resolution in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Encoder::new(resolution).is_err());
            assert!(Encoder::from_counts_per_unit(resolution).is_err());
        }
    }
}
