//! Continuous models of plants.

mod ball_screw;
mod belt_drive;
mod cartesian_robot;
mod check;
mod decay;
mod discrete;
mod friction;
mod linear_motor;
mod low_pass;
mod plant;
mod pmsm;
mod state_space;
mod transfer_function;
mod two_inertia;

pub use ball_screw::{BallScrewAxis, MeteredStickSlip, StickSlip};
pub use belt_drive::BeltDrive;
pub use cartesian_robot::{CartesianRobot, RobotStepper};
pub use discrete::DiscreteStateSpace;
pub use friction::Friction;
pub use linear_motor::LinearMotor;
pub use low_pass::LowPass;
pub use plant::Plant;
pub use pmsm::{Pmsm, PmsmDrive, PmsmWindings};
pub use state_space::StateSpace;
pub use transfer_function::{HeldTransferFunction, TransferFunction};
pub use two_inertia::TwoInertia;

pub(crate) use state_space::finite;
