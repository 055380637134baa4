//! Ball-screw axes at right angles.

use nalgebra::{SVector, vector};

use super::{BallScrewAxis, Friction, MeteredStickSlip, StickSlip};
use crate::energy::EnergyLedger;
use crate::error::{ModelError, StepError};
use crate::steppers::Stepper;

/// A Cartesian robot of `N` ball-screw axes, each with its own friction, that do not disturb each other: orthogonal
/// axes meet in the controller alone.
///
/// Its steps take a state of `2 N`, angles first: `[theta_1 ... theta_N, theta_1' ... theta_N']`, and an input of `2 N`,
/// `[u_1 ... u_N, M_1 ... M_N]` with the load torques in N m, or of `N` without loads. Other sizes do not compile:
///
/// ```compile_fail
/// use plants::{BallScrewAxis, CartesianRobot, Stepper, nalgebra::SVector};
///
/// let axis = BallScrewAxis::from_coefficients(10.0, 1.0, 1.0)?;
/// let mut robot = CartesianRobot::new([axis; 3]).stepper();
/// robot.advance(&SVector::<f64, 5>::zeros(), &SVector::<f64, 6>::zeros(), 1e-3)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A robot under a proportional controller, with a load of 10 N m on its first axis from 0.5 s on:
///
/// ```
/// use plants::{BallScrewAxis, CartesianRobot, Clock, ControlTick, Disturbance, Simulation};
/// use plants::nalgebra::SVector;
///
/// let axis = BallScrewAxis::from_coefficients(10.0, 1.0, 1.0)?;
/// let robot = CartesianRobot::new([axis; 3]);
/// let mut loads = [Disturbance::none(); 6];
/// loads[3] = Disturbance::step(0.5, 10.0)?;
///
/// let recording = Simulation::new(Clock::from_frequency(1000)?, 6000)
///     .disturbances(loads)
///     .run(
///         &mut robot.stepper(),
///         SVector::zeros(),
///         &mut (),
///         |_, tick: &ControlTick<'_, 6, 6>| {
///             let position = robot.angles(tick.state);
///             SVector::from_fn(|i, _| if i < 3 { 20.0 * (1.0 - position[i]) } else { 0.0 })
///         },
///         [("x", "rad"), ("y", "rad"), ("z", "rad")],
///         |(), probe| robot.angles(probe.state).into(),
///     )?
///     .completed()?;
/// // At rest b theta = k u - M / J: 20 / 21, and 10 / 21 under load.
/// let last = |name| recording.column(name).map(|values| values[6000]);
/// assert!((last("x")? - 10.0 / 21.0).abs() < 1e-3 && (last("z")? - 20.0 / 21.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CartesianRobot<const N: usize> {
    axes: [BallScrewAxis; N],
    friction: [Friction; N],
}

impl<const N: usize> CartesianRobot<N> {
    /// A robot without dry friction.
    #[must_use]
    pub fn new(axes: [BallScrewAxis; N]) -> Self {
        Self { axes, friction: [Friction::none(); N] }
    }

    /// The same robot with friction on its axes.
    ///
    /// # Errors
    /// Viscous friction that is out of range in the units of its axis.
    pub fn with_friction(self, friction: [Friction; N]) -> Result<Self, ModelError> {
        for (axis, friction) in self.axes.iter().zip(&friction) {
            axis.check_damping(friction)?;
        }
        Ok(Self { friction, ..self })
    }

    /// The axes, without their friction.
    #[must_use]
    pub fn axes(&self) -> &[BallScrewAxis; N] {
        &self.axes
    }

    /// The friction of every axis.
    #[must_use]
    pub fn friction(&self) -> &[Friction; N] {
        &self.friction
    }

    /// Steps of the robot, each axis as by its [`StickSlip`]: exact without Stribeck friction.
    #[must_use]
    pub fn stepper(&self) -> RobotStepper<N> {
        RobotStepper::new(std::array::from_fn(|i| StickSlip::of(self.axes[i], self.friction[i])))
    }

    /// The same steps with an account of the energy.
    #[must_use]
    pub fn metered(&self) -> RobotStepper<N, MeteredStickSlip> {
        RobotStepper::new(self.stepper().axes.map(StickSlip::metered))
    }

    /// The angles of a state, rad.
    #[must_use]
    pub fn angles<const STATES: usize>(&self, state: &SVector<f64, STATES>) -> SVector<f64, N> {
        const { assert!(STATES == 2 * N, "a robot has two states for each axis") };
        SVector::from_fn(|i, _| state[i])
    }

    /// The speeds of a state, rad/s.
    #[must_use]
    pub fn speeds<const STATES: usize>(&self, state: &SVector<f64, STATES>) -> SVector<f64, N> {
        const { assert!(STATES == 2 * N, "a robot has two states for each axis") };
        SVector::from_fn(|i, _| state[N + i])
    }
}

/// Steps of `N` axes side by side, each by a stepper of its own with the state `[theta, theta']` and the input `[u, M]`.
///
/// State and input are those of a [`CartesianRobot`].
#[derive(Debug, Clone)]
pub struct RobotStepper<const N: usize, S = StickSlip> {
    axes: [S; N],
}

impl<const N: usize, S: Stepper<2, 2>> RobotStepper<N, S> {
    /// The steps of the axes, side by side.
    #[must_use]
    pub fn new(axes: [S; N]) -> Self {
        Self { axes }
    }

    /// The steps of the axes.
    #[must_use]
    pub fn axes(&self) -> &[S; N] {
        &self.axes
    }
}

impl<const N: usize> RobotStepper<N, MeteredStickSlip> {
    /// The account of all axes and all steps so far.
    #[must_use]
    pub fn ledger(&self) -> EnergyLedger {
        let mut sum = EnergyLedger::default();
        self.axes.iter().for_each(|axis| sum.add(axis.ledger()));
        sum
    }
}

impl<const N: usize, S: Stepper<2, 2>, const STATES: usize, const INPUTS: usize> Stepper<STATES, INPUTS>
    for RobotStepper<N, S>
{
    #[inline(always)]
    fn advance(
        &mut self,
        state: &SVector<f64, STATES>,
        input: &SVector<f64, INPUTS>,
        interval: f64,
    ) -> Result<SVector<f64, STATES>, StepError> {
        const { assert!(STATES == 2 * N, "a robot has two states for each axis") };
        const { assert!(INPUTS == N || INPUTS == 2 * N, "a robot has one input for each axis, or one and a load") };
        let mut next = *state;
        for (i, axis) in self.axes.iter_mut().enumerate() {
            let load = if INPUTS == N { 0.0 } else { input[N + i] };
            let moved = axis.advance(&vector![state[i], state[N + i]], &vector![input[i], load], interval)?;
            (next[i], next[N + i]) = (moved[0], moved[1]);
        }
        Ok(next)
    }
}
