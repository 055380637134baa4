//! An axis that slides and sticks under a held input.

use nalgebra::{SVector, vector};

use super::BallScrewAxis;
use super::motion::Motion;
use crate::error::StepError;
use crate::models::Friction;
use crate::steppers::{Kept, check_interval};

/// Of the poles' magnitude times a substep: at most one reversal in it, and quadrature to rounding.
const POLES: f64 = 0.5;
/// Of the steepest fall of the friction over the inertia times a substep, which errs with its square.
const FALL: f64 = 0.05;
const MOST_SUBSTEPS: u32 = 100_000;

/// The nodes of Gauss's rule on five points on `[0, 1]`, and their weights.
pub(super) const NODES: [(f64, f64); 5] = [
    (0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_24),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// A part of a step in which the axis slides one way under a constant torque.
pub(super) struct Piece {
    /// The state at its start.
    pub(super) start: SVector<f64, 2>,
    /// The state at its end.
    pub(super) end: SVector<f64, 2>,
    /// The dry friction, N m, with the sign of the speed.
    pub(super) dry: f64,
    /// All that accelerates but damping and stiffness, rad/s^2.
    pub(super) acceleration: f64,
    /// Its length, s.
    pub(super) length: f64,
}

/// A ball-screw axis, its viscous friction in its damping, with dry friction.
#[derive(Debug, Clone)]
pub(super) struct Slide {
    axis: BallScrewAxis,
    friction: Friction,
    kept: Kept<Substeps>,
}

/// How an interval is divided, and the motion over a substep and over half of one.
#[derive(Debug, Clone, Copy)]
struct Substeps {
    count: u32,
    length: f64,
    whole: Motion,
    half: Motion,
}

impl Slide {
    pub(super) fn new(axis: BallScrewAxis, friction: Friction) -> Self {
        Self { axis, friction, kept: Kept::new() }
    }

    pub(super) fn axis(&self) -> &BallScrewAxis {
        &self.axis
    }

    pub(super) fn friction(&self) -> &Friction {
        &self.friction
    }

    /// The motion of the axis over a time, not longer than a substep.
    pub(super) fn motion(&self, time: f64) -> Motion {
        Motion::over(self.axis.a, self.axis.b, time)
    }

    #[inline(always)]
    pub(super) fn advance(
        &mut self,
        state: &SVector<f64, 2>,
        input: &SVector<f64, 2>,
        interval: f64,
        mut account: impl FnMut(&Self, &Piece),
    ) -> Result<SVector<f64, 2>, StepError> {
        check_interval(interval)?;
        let (axis, friction) = (self.axis, self.friction);
        let needed = substeps(&axis, &friction, interval)?;
        let substeps = *self.kept.get(interval, || {
            let length = interval / f64::from(needed);
            let motion = |time| Motion::over(axis.a, axis.b, time);
            Ok(Substeps { count: needed, length, whole: motion(length), half: motion(0.5 * length) })
        })?;
        let driving = axis.driving_acceleration(input);
        let mut state = *state;
        for _ in 0..substeps.count {
            state = self.substep(state, driving, &substeps, &mut account);
        }
        Ok(state)
    }

    #[inline(always)]
    fn substep(
        &self,
        mut state: SVector<f64, 2>,
        driving: f64,
        substeps: &Substeps,
        account: &mut impl FnMut(&Self, &Piece),
    ) -> SVector<f64, 2> {
        let (mut length, mut whole, mut half) = (substeps.length, substeps.whole, substeps.half);
        // Slides to a reversal, and from there the other way or not at all: from rest there is no second one.
        for _ in 0..3 {
            let pull = driving - self.axis.b * state[0];
            let way = if state[1].abs() > 0.0 {
                state[1].signum()
            } else if pull.abs() <= self.friction.breakaway() * self.axis.per_inertia {
                return state;
            } else {
                pull.signum()
            };
            let mut dry = self.friction.dry(state[1].abs());
            let accelerated = |dry: f64| driving - way * dry * self.axis.per_inertia;
            if self.friction.breakaway() > self.friction.coulomb_torque() {
                // Held at its value in the middle, as the midpoint rule has it.
                dry = self.friction.dry((way * half.apply(&state, accelerated(dry))[1]).max(0.0));
            }
            let acceleration = accelerated(dry);
            let end = whole.apply(&state, acceleration);
            if way * end[1] >= 0.0 {
                account(self, &Piece { start: state, end, dry: way * dry, acceleration, length });
                return end;
            }
            let stop = self.stop(&state, acceleration, length, end[1]);
            let end = vector![self.motion(stop).apply(&state, acceleration)[0], 0.0];
            account(self, &Piece { start: state, end, dry: way * dry, acceleration, length: stop });
            state = end;
            length -= stop;
            (whole, half) = (self.motion(length), self.motion(0.5 * length));
        }
        state
    }

    /// When a speed that has another sign at the end of an interval is zero, s: Newton's method, kept in the bracket.
    #[cold]
    fn stop(&self, state: &SVector<f64, 2>, acceleration: f64, length: f64, last: f64) -> f64 {
        let way = state[1].signum();
        let (mut before, mut after) = (0.0, length);
        let mut time = length * (state[1] / (state[1] - last));
        // Bisection alone takes as many steps as there are binary digits.
        for _ in 0..64 {
            let next = self.motion(time).apply(state, acceleration);
            if way * next[1] > 0.0 {
                before = time;
            } else {
                after = time;
            }
            let slope = acceleration - self.axis.a * next[1] - self.axis.b * next[0];
            let newton = time - next[1] / slope;
            let better = if newton > before && newton < after { newton } else { 0.5 * (before + after) };
            if (better - time).abs() <= f64::EPSILON * length {
                return better;
            }
            time = better;
        }
        time
    }
}

/// Into how many substeps an interval is divided.
fn substeps(axis: &BallScrewAxis, friction: &Friction, interval: f64) -> Result<u32, StepError> {
    let fall = friction.steepest_fall() * axis.per_inertia;
    let needed = (interval * (axis.a.max(axis.b.sqrt()) / POLES).max(fall / FALL)).ceil().max(1.0);
    if needed <= f64::from(MOST_SUBSTEPS) {
        Ok(needed as u32)
    } else {
        Err(StepError::Substeps { interval, needed, limit: MOST_SUBSTEPS })
    }
}
