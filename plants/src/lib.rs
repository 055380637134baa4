#![doc = include_str!("../README.md")]

mod energy;
mod error;
mod linear;
mod models;
mod signals;
mod simulation;
mod steppers;

pub use nalgebra;

pub use energy::{Energetic, EnergyLedger, HeldEnergetic, Powers, Work};
pub use error::{HaltError, ModelError, RecordingError, SimulationError, StepError};
pub use linear::{
    QuadraticIntegral, Transition, eigenvalues, linearise, monodromy, polynomial_roots, quadratic_integral,
    spectral_radius, zero_order_hold,
};
pub use models::{
    BallScrewAxis, BeltDrive, CartesianRobot, DiscreteStateSpace, Friction, HeldTransferFunction,
    LinearMotor, LowPass, MeteredStickSlip, Plant, Pmsm, PmsmDrive, PmsmWindings, RobotStepper, StateSpace,
    StickSlip, TransferFunction, TwoInertia,
};
pub use signals::{DelayedHold, Disturbance, Encoder, GaussianNoise, Noise, TransportDelay, UniformNoise};
pub use simulation::{Channel, Clock, ControlTick, Outcome, Probe, Recording, Saturation, Simulation, Task};
pub use steppers::{
    DormandPrince, HeldLinear, MeteredHold, MeteredRk4, Rk4, Stepper, Tolerance, ZeroOrderHold, integrate,
    integrate_adaptive,
};
