//! What every motion law answers.

use num_complex::Complex;

use crate::complex;
use crate::polynomial::response;
use crate::quantities::{Interval, Mode, Sample};
use crate::section::Sectioned;

/// A motion along one axis, planned and complete.
///
/// Positions count from the start of the motion. Before the start and after the end the motion goes on with the
/// velocity it has there: a move rests, a velocity ramp keeps its speed.
pub trait Profile {
    /// Duration `T`, s.
    fn duration(&self) -> f64;

    /// Position and derivatives at time `t` in s, from the right where one of them jumps.
    ///
    /// A NaN is answered like a time before the start.
    fn sample(&self, t: f64) -> Sample;

    /// The exact range of every derivative over `[0, T]`, impulses at jumps not counted.
    fn extrema(&self) -> Extrema;

    /// The response of a pole `p` in rad/s at the end of the motion, m/s:
    ///
    /// `response(p) = integral from 0 to T of a(u) e^(p (T - u)) du`
    ///
    /// with `a` the acceleration, jumps of the velocity included as impulses. It is bounded for `Re p <= 0`; to the
    /// right of that it grows as `e^(p T)` does and overflows with it, where [`transform`] does not.
    /// A mode with pole `p` is left vibrating with the amplitude `|response(p)| / w_d`.
    fn response(&self, p: Complex<f64>) -> Complex<f64>;
}

impl<P: Profile + ?Sized> Profile for &P {
    fn duration(&self) -> f64 {
        (**self).duration()
    }
    fn sample(&self, t: f64) -> Sample {
        (**self).sample(t)
    }
    fn extrema(&self) -> Extrema {
        (**self).extrema()
    }
    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        (**self).response(p)
    }
}

/// The exact range of position and of every derivative over a profile.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extrema {
    /// Range of the position, m.
    pub position: Interval,
    /// Range of the velocity, m/s.
    pub velocity: Interval,
    /// Range of the acceleration, m/s^2.
    pub acceleration: Interval,
    /// Range of the jerk, m/s^3.
    pub jerk: Interval,
    /// Range of the derivative of jerk, m/s^4.
    pub snap: Interval,
}

/// The Laplace transform of the acceleration of a profile, `integral from 0 to T of a(u) e^(-s u) du`, m/s, which is
/// `e^(-s T) response(s)`: bounded for `Re s >= 0`.
#[must_use]
pub fn transform<P: Sectioned>(profile: &P, s: Complex<f64>) -> Complex<f64> {
    if s.re > 0.0 && complex::norm(s) * profile.duration() >= 1.0 {
        response::forward(profile, s)
    } else {
        complex::exp(-s * profile.duration()) * profile.response(s)
    }
}

/// The amplitude in m with which `mode`, at rest before the motion, goes on vibrating about the moving axis when
/// the motion ends: `|response(p)| / w_d`.
///
/// For a move it is set against the distance, for a velocity ramp against `|dv| / w`.
#[must_use]
pub fn residual_vibration<P: Profile + ?Sized>(profile: &P, mode: Mode) -> f64 {
    complex::norm(profile.response(mode.pole())) / mode.damped_angular_frequency()
}
