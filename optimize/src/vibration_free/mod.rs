//! The shortest motion that leaves nothing of given modes.

/// Makes a motion answer like the profile inside it.
macro_rules! answers_as_its_profile {
    ($motion:ident) => {
        impl profiles::Profile for $motion {
            fn duration(&self) -> f64 {
                self.profile.duration()
            }
            fn sample(&self, t: f64) -> profiles::Sample {
                self.profile.sample(t)
            }
            fn extrema(&self) -> profiles::Extrema {
                self.profile.extrema()
            }
            fn response(&self, p: profiles::Complex<f64>) -> profiles::Complex<f64> {
                self.profile.response(p)
            }
        }

        impl profiles::Sectioned for $motion {
            const HARMONIC: bool = false;

            fn section(&self, index: usize) -> Option<profiles::Section> {
                self.profile.section(index)
            }
            fn section_at(&self, t: f64) -> Option<profiles::Section> {
                self.profile.section_at(t)
            }
            fn before(&self) -> profiles::Sample {
                self.profile.before()
            }
            fn after(&self) -> profiles::Sample {
                self.profile.after()
            }
        }
    };
}
use answers_as_its_profile;

mod asked;
mod band;
mod clocked;
mod conditions;
mod costate;
mod error;
mod exchange;
mod grid;
mod improve;
mod joined;
mod motion;
mod newton;
mod reading;
mod runs;
mod search;
mod settle;
mod shaped;
mod structure;
mod table;
mod task;

pub use clocked::ClockedMove;
pub use error::VibrationFreeError;
pub use motion::VibrationFreeMove;
pub use table::{MoveTableBuildError, OwnedMoveTable, TABLE_TOLERANCE, plan_table};

use profiles::switched::{Goal, Switched};
use profiles::{Limits, Mode};

/// The most modes that are dealt with at a time.
const MOST_MODES: usize = 4;
/// Arcs that a motion may have.
pub const MOST_ARCS: usize = 128;

type Motion = Switched<MOST_ARCS>;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Request {
    Move { distance: f64 },
    Ramp { from: f64, to: f64 },
}

impl Request {
    /// Velocity at the start, m/s.
    fn from(self) -> f64 {
        match self {
            Self::Move { .. } => 0.0,
            Self::Ramp { from, .. } => from,
        }
    }

    fn goal(self) -> Goal {
        match self {
            Self::Move { distance } => Goal { velocity: 0.0, distance: Some(distance) },
            Self::Ramp { to, .. } => Goal { velocity: to, distance: None },
        }
    }
}

/// What is asked at and about each mode.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Robustness {
    /// Nothing is left of the mode as it is given; a mode that is given twice gets a double zero.
    None,
    /// And nothing of the derivative by its frequency and damping.
    DoubleZero,
    /// No more than a part of the motion is left of any mode of a band.
    Band {
        /// Half the width of the band, as a part of the frequency.
        half_width: f64,
        /// The amplitude that may be left, as a part of the distance (of the change of velocity over the frequency).
        residual: f64,
    },
}

/// The shortest move over a signed `distance` in m within limits of velocity, acceleration and jerk, which may be
/// asymmetric, that leaves of up to four modes what `robustness` says.
///
/// With `j` the jerk and `p` the pole of a mode, the mode is left at rest where `integral of j(u) e^(p (T - u)) du` vanishes.
/// For a duration `T` that is a linear condition on the jerk, and so are the end and the limits: the furthest motion in `T`
/// is the solution of a linear programme, with bands one over second-order cones. It is solved on a grid, `T` such that the
/// distance is met. The optimum switches between full jerk up, full jerk down, and none at a limit: the switches are read off
/// the grid, and solved to rounding together with the multipliers of all conditions by Newton's method. The maximum
/// principle, which is sufficient as the problem is convex, then shows whether the motion is the shortest there is, and
/// where it is not what to change.
///
/// Where that cannot be shown, the result is the shortest motion that was found; of those that last as long but for a billionth,
/// the one with the fewest switches, and of these the one of least effort.
///
/// The result is a profile of constant jerk in each section: it ends where it should exactly, holds its limits to rounding,
/// and leaves less than 1e-12 of the distance of each mode. Bands are certified over their whole width.
///
/// ```
/// use optimize::vibration_free::{Robustness, plan};
/// use profiles::{Limits, Mode, Profile, residual_vibration};
///
/// // 0.1 m within 0.5 m/s, 5 m/s^2, 200 m/s^3, and a mode of 8 Hz with 2 % damping
/// let limits = Limits::new(0.5, 5.0, 200.0)?;
/// let mode = Mode::from_hz(8.0, 0.02)?;
/// let fastest = plan(0.1, &limits, &[mode], Robustness::None)?;
/// assert!(residual_vibration(&fastest, mode) < 1e-13); // m
/// // 9 ms more than the S-curve, where two impulses half a period apart cost 62.5 ms
/// assert!((fastest.price() - 0.0090).abs() < 1e-4);
/// assert!(fastest.is_proven());
///
/// // From there to another distance
/// let further = fastest.replanned(0.11)?;
/// assert!(residual_vibration(&further, mode) < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A distance that is not finite, an unlimited jerk, more than four modes, a band or a residual that cannot be, numbers beyond
/// double precision, or a search that does not converge.
pub fn plan(
    distance: f64,
    limits: &Limits,
    modes: &[Mode],
    robustness: Robustness,
) -> Result<VibrationFreeMove, VibrationFreeError> {
    VibrationFreeMove::planned(Request::Move { distance }, limits, modes, robustness)
}

/// The shortest change of velocity from `from` to `to` in m/s, otherwise as [`plan`]; the way it takes is free.
///
/// # Errors
/// As [`plan`], and a velocity beyond the limits.
pub fn plan_ramp(
    from: f64,
    to: f64,
    limits: &Limits,
    modes: &[Mode],
    robustness: Robustness,
) -> Result<VibrationFreeMove, VibrationFreeError> {
    VibrationFreeMove::planned(Request::Ramp { from, to }, limits, modes, robustness)
}
