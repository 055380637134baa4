//! The vocabulary: scalars, bounds, instants and modes.

mod interval;
mod limits;
mod mode;
mod real;
mod state;

pub use interval::Interval;
pub use limits::Limits;
pub use mode::Mode;
pub use real::Real;
pub use state::{Sample, State};
