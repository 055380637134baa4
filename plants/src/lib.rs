#![doc = include_str!("../README.md")]

mod energy;
mod error;
mod linear;
mod models;
mod signals;
mod simulation;
mod steppers;

pub use nalgebra;

pub use energy::EnergyLedger;
pub use error::{HaltError, ModelError, RecordingError, SimulationError, StepError};
pub use linear::{Transition, eigenvalues, linearise, monodromy, spectral_radius, zero_order_hold};
pub use models::{DiscreteStateSpace, LinearMotor, Plant, StateSpace};
pub use signals::{Disturbance, Encoder, GaussianNoise, Noise, UniformNoise};
pub use simulation::{Channel, Clock, ControlTick, Outcome, Probe, Recording, Saturation, Simulation, Task};
pub use steppers::{
    DormandPrince, HeldLinear, Rk4, Stepper, Tolerance, ZeroOrderHold, integrate, integrate_adaptive,
};
