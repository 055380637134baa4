//! The motion laws.

mod cosine;
mod five_phase;
mod s_curve;
mod snap_limited;
mod trapezoid;

pub use cosine::Cosine;
pub use five_phase::FivePhase;
pub use s_curve::SCurve;
pub use snap_limited::SnapLimited;
pub use trapezoid::Trapezoid;

use crate::error::PlanError;
use crate::quantities::{Interval, Limits};

/// Makes a law that is a `Piecewise` inside answer like one.
macro_rules! polynomial_law {
    ($law:ident, $sections:literal) => {
        impl $law {
            /// The sections of the law.
            #[must_use]
            pub fn as_piecewise(&self) -> &$crate::Piecewise<$sections> {
                &self.0
            }

            /// The same motion in a longer time, see [`Piecewise::stretched_to`](crate::Piecewise::stretched_to).
            ///
            /// # Errors
            /// A duration above 1e75 s or shorter than the motion's own.
            pub fn stretched_to(&self, duration: f64) -> Result<Self, $crate::PlanError> {
                self.0.stretched_to(duration).map(Self)
            }
        }

        impl $crate::Profile for $law {
            #[inline]
            fn duration(&self) -> f64 {
                self.0.duration()
            }
            #[inline]
            fn sample(&self, t: f64) -> $crate::Sample {
                self.0.sample(t)
            }
            fn extrema(&self) -> $crate::Extrema {
                self.0.extrema()
            }
            fn response(&self, p: num_complex::Complex<f64>) -> num_complex::Complex<f64> {
                self.0.response(p)
            }
        }

        impl $crate::Sectioned for $law {
            const HARMONIC: bool = false;
            fn section(&self, index: usize) -> Option<$crate::Section> {
                self.0.section(index)
            }
            fn section_at(&self, t: f64) -> Option<$crate::Section> {
                self.0.section_at(t)
            }
            fn before(&self) -> $crate::Sample {
                self.0.before()
            }
            fn after(&self) -> $crate::Sample {
                self.0.after()
            }
        }
    };
}
pub(crate) use polynomial_law;

/// A distance, or why there is none.
pub(crate) fn finite_distance(distance: f64) -> Result<f64, PlanError> {
    if distance.is_finite() { Ok(distance) } else { Err(PlanError::Distance(distance)) }
}

/// A speed within the limits, or why it is not.
fn speed_within(which: &'static str, value: f64, velocity: Interval) -> Result<f64, PlanError> {
    if !value.is_finite() {
        return Err(PlanError::Speed { which, value });
    }
    if !velocity.contains(value) {
        return Err(PlanError::SpeedLimit { which, value, lower: velocity.lower, upper: velocity.upper });
    }
    Ok(value)
}

/// A limit that must be finite.
pub(crate) fn finite_limit(quantity: &'static str, limit: f64) -> Result<f64, PlanError> {
    if limit < f64::INFINITY { Ok(limit) } else { Err(PlanError::Unlimited(quantity)) }
}

/// The magnitude of limits that must be symmetric.
fn symmetric(quantity: &'static str, bounds: Interval) -> Result<f64, PlanError> {
    if bounds.is_symmetric() {
        Ok(bounds.upper)
    } else {
        Err(PlanError::Asymmetric { quantity, lower: bounds.lower, upper: bounds.upper })
    }
}

/// The symmetric limits of acceleration and jerk.
pub(crate) fn symmetric_limits(limits: &Limits) -> Result<(f64, f64), PlanError> {
    Ok((symmetric("acceleration", limits.acceleration())?, symmetric("jerk", limits.jerk())?))
}

/// The planned times whose fourth powers double precision can hold, s.
const TIMES: Interval = Interval::new(1e-75, 1e75);

/// A planned time that double precision can hold.
pub(crate) fn representable(quantity: &'static str, value: f64) -> Result<f64, PlanError> {
    if TIMES.contains(value) { Ok(value) } else { Err(PlanError::Range { quantity, value }) }
}

/// Verifies a plan: its sections must add up to the length.
fn covers(met: f64, length: f64) -> Result<(), PlanError> {
    // Written so that NaN fails.
    if (met - length).abs() <= 1e-12 * length.abs() {
        Ok(())
    } else {
        Err(PlanError::Range { quantity: "distance", value: met })
    }
}
