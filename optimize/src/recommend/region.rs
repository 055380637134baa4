//! A mode that is known to some deviation, and the worst of a response over all it may be.

use profiles::{Complex, Interval, Mode, Real};
use shaping::ModeRange;

use super::error::{RecommendError, not_negative};

/// A mode with its uncertainty, as an estimate gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedMode"))]
pub struct UncertainMode {
    mode: Mode,
    frequency_deviation: f64,
    damping_deviation: f64,
    participation: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedMode {
    mode: Mode,
    frequency_deviation: f64,
    damping_deviation: f64,
    participation: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedMode> for UncertainMode {
    type Error = RecommendError;
    fn try_from(mode: UncheckedMode) -> Result<Self, RecommendError> {
        Self::new(mode.mode, mode.frequency_deviation, mode.damping_deviation)?
            .with_participation(mode.participation)
    }
}

impl UncertainMode {
    /// A mode with the standard deviations of its undamped angular frequency in rad/s and of its damping ratio, and a
    /// participation of one.
    ///
    /// # Errors
    /// A deviation that is negative or not finite.
    pub fn new(mode: Mode, frequency_deviation: f64, damping_deviation: f64) -> Result<Self, RecommendError> {
        not_negative("the deviation of a frequency", frequency_deviation)?;
        not_negative("the deviation of a damping ratio", damping_deviation)?;
        Ok(Self { mode, frequency_deviation, damping_deviation, participation: 1.0 })
    }

    /// How far the response swings where a load on a spring swings by one: in units of the response over those of the
    /// command.
    ///
    /// # Errors
    /// A number that is negative or not finite.
    pub fn with_participation(self, participation: f64) -> Result<Self, RecommendError> {
        Ok(Self { participation: not_negative("a participation", participation)?, ..self })
    }

    /// The estimate.
    #[must_use]
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Standard deviation of the undamped angular frequency, rad/s.
    #[must_use]
    pub fn frequency_deviation(&self) -> f64 {
        self.frequency_deviation
    }

    /// Standard deviation of the damping ratio.
    #[must_use]
    pub fn damping_deviation(&self) -> f64 {
        self.damping_deviation
    }

    /// How far the response swings where a load on a spring swings by one.
    #[must_use]
    pub fn participation(&self) -> f64 {
        self.participation
    }
}

/// All a mode may be: so many standard deviations of frequency and of damping either way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Region {
    modes: ModeRange,
}

impl Region {
    pub(super) fn of(mode: &UncertainMode, deviations: f64) -> Result<Self, RecommendError> {
        /// Below this part of its frequency a mode is none.
        const LEAST: f64 = 0.2;
        /// A mode still swings with this damping ratio.
        const MOST: f64 = 0.95;
        let (w, z) = (mode.mode.angular_frequency(), mode.mode.damping_ratio());
        let margin = deviations * mode.frequency_deviation;
        let vague = RecommendError::Vague { angular_frequency: w, margin };
        if margin.is_nan() || w - margin < LEAST * w {
            return Err(vague);
        }
        let about = deviations * mode.damping_deviation;
        let dampings = Interval::new((z - about).max(0.0), (z + about).min(MOST.max(z)));
        let modes = ModeRange::new(Interval::new(w - margin, w + margin), dampings).map_err(|_| vague)?;
        Ok(Self { modes })
    }

    pub(super) fn modes(&self) -> &ModeRange {
        &self.modes
    }

    /// The slowest decay, 1/s.
    pub(super) fn slowest_decay(&self) -> f64 {
        let lowest = self.modes.lowest();
        lowest.angular_frequency() * lowest.damping_ratio()
    }

    /// The lowest damped angular frequency, rad/s.
    pub(super) fn lowest_damped(&self) -> f64 {
        let z = self.modes.damping_ratio().upper;
        self.modes.angular_frequency().lower * Real::sqrt((1.0 - z) * (1.0 + z))
    }

    /// A bound of `|f(p)|` for every pole of the region, within `slack` above the largest.
    ///
    /// `f` is analytic, so that its modulus is largest on the boundary: two rays of equal damping and two arcs of equal
    /// frequency. Between samples `h` apart it is above the larger of both by at most `h^2 / 8` times the largest second
    /// derivative along the curve, `|f''|` on a ray and `|f''| + |f'| / w` on an arc; `slopes` bounds `|f'|` and `|f''|`.
    pub(super) fn bound(
        &self,
        f: impl Fn(Complex<f64>) -> Complex<f64>,
        slopes: [f64; 2],
        slack: f64,
    ) -> f64 {
        const MOST: f64 = 4000.0;
        let Interval { lower: low, upper: high } = self.modes.angular_frequency();
        let curvature = slopes[1] + slopes[0] / low;
        let finest = Real::sqrt(8.0 * slack / curvature);
        let pole = |w: f64, z: f64| Complex::new(-z * w, w * Real::sqrt((1.0 - z) * (1.0 + z)));
        let along = |length: f64, at: &dyn Fn(f64) -> Complex<f64>| {
            let pieces = (length / finest).ceil().clamp(1.0, MOST);
            let step = length / pieces;
            let largest = (0..=pieces as usize).map(|k| f(at(k as f64 / pieces)).norm()).fold(0.0, f64::max);
            largest + step * step / 8.0 * curvature
        };
        let ray = |z: f64| along(high - low, &|x| pole(low + x * (high - low), z));
        let angle = |z: f64| Real::atan2(z, Real::sqrt((1.0 - z) * (1.0 + z)));
        let Interval { lower: thin, upper: thick } = self.modes.damping_ratio();
        let [first, last] = [thin, thick].map(angle);
        let arc = |w: f64| {
            along(w * (last - first), &|x| {
                let (sine, cosine) = Real::sin_cos(first + x * (last - first));
                Complex::new(-w * sine, w * cosine)
            })
        };
        ray(thin).max(ray(thick)).max(arc(low)).max(arc(high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_holds_inside_and_is_tight() {
        let mode = Mode::new(50.0, 0.04).expect("valid");
        let region = Region::of(&UncertainMode::new(mode, 1.0, 0.005).expect("valid"), 3.0).expect("known");
        // Two impulses a half period apart: |f'| <= 0.0628, |f''| <= 0.0628^2.
        let t = 0.0628_f64;
        let f = |p: Complex<f64>| (Complex::new(1.0, 0.0) + (p * t).exp()) * 0.5;
        let bound = region.bound(f, [t, t * t], 1e-4);
        let mut largest: f64 = 0.0;
        for i in 0..=60 {
            for k in 0..=60 {
                let w = 47.0 + 6.0 * f64::from(i) / 60.0;
                let z = 0.025 + 0.03 * f64::from(k) / 60.0;
                largest = largest.max(f(Mode::new(w, z).expect("valid").pole()).norm());
            }
        }
        assert!(bound >= largest && bound < largest + 1.1e-4, "{bound} {largest}");
        // Nothing is uncertain: the bound is the value.
        let point = Region::of(&UncertainMode::new(mode, 0.0, 0.0).expect("valid"), 3.0).expect("known");
        assert!((point.bound(f, [t, t * t], 1e-4) - f(mode.pole()).norm()).abs() < 1e-15);
    }

    #[test]
    fn what_is_too_vague_is_refused() {
        let mode = Mode::new(50.0, 0.04).expect("valid");
        assert!(UncertainMode::new(mode, f64::NAN, 0.0).is_err());
        assert!(UncertainMode::new(mode, 0.0, -1.0).is_err());
        let vague = UncertainMode::new(mode, 20.0, 0.0).expect("valid");
        assert_eq!(
            Region::of(&vague, 3.0).expect_err("vague"),
            RecommendError::Vague { angular_frequency: 50.0, margin: 60.0 }
        );
        assert!(vague.with_participation(f64::INFINITY).is_err());
    }
}
