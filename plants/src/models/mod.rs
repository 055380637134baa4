//! Continuous models of plants.

mod discrete;
mod linear_motor;
mod plant;
mod state_space;

pub use discrete::DiscreteStateSpace;
pub use linear_motor::LinearMotor;
pub use plant::Plant;
pub use state_space::StateSpace;
