//! The motion laws as ramps of a feed.

use crate::error::PlanError;
use crate::laws::{Cosine, FivePhase, SCurve, SnapLimited, Trapezoid};
use crate::quantities::Limits;
use crate::section::Sectioned;

/// A motion law by which a feed changes.
///
/// A change of speed must begin and end without acceleration where that is continuous, and with symmetric limits be
/// symmetric about its middle, so that it covers its duration times the mean of its speeds. In each of its sections speed
/// and jerk must be monotone; so must those of a move.
pub trait FeedLaw: Sectioned + Clone {
    /// Whether the acceleration of the law is continuous; if not, it is no law for axes with a limit of jerk.
    const CONTINUOUS: bool;

    /// The fastest change of speed from `from` to `to`, m/s.
    ///
    /// # Errors
    /// What the law cannot do.
    fn change(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError>;

    /// The fastest move over `distance`, m, from rest to rest.
    ///
    /// # Errors
    /// What the law cannot do.
    fn rest_to_rest(distance: f64, limits: &Limits) -> Result<Self, PlanError>;

    /// The same motion in a longer time, s: a change keeps its speeds, a move its distance.
    ///
    /// # Errors
    /// A duration shorter than the motion's own.
    fn stretched_to(&self, duration: f64) -> Result<Self, PlanError>;
}

/// A law without sines: what is made of it has sections that are polynomials, as [`Sectioned`] wants them.
pub trait PolynomialLaw: FeedLaw {}

macro_rules! feed_law {
    ($law:ident, $continuous:literal $(, $marker:ident)?) => {
        impl FeedLaw for $law {
            const CONTINUOUS: bool = $continuous;
            fn change(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError> {
                $law::velocity_ramp(from, to, limits)
            }
            fn rest_to_rest(distance: f64, limits: &Limits) -> Result<Self, PlanError> {
                $law::rest_to_rest(distance, limits)
            }
            fn stretched_to(&self, duration: f64) -> Result<Self, PlanError> {
                $law::stretched_to(self, duration)
            }
        }
        $(impl $marker for $law {})?
    };
}

feed_law!(Trapezoid, false, PolynomialLaw);
feed_law!(SCurve, true, PolynomialLaw);
feed_law!(SnapLimited, true, PolynomialLaw);
feed_law!(FivePhase, true, PolynomialLaw);
feed_law!(Cosine, true);
