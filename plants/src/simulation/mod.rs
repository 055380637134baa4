//! A continuous plant under a sampled controller.

mod clock;
mod recording;
mod run;
mod saturation;
mod setup;

pub use clock::Clock;
pub use recording::{Channel, Recording};
pub use run::{ControlTick, Outcome, Probe};
pub use saturation::Saturation;
pub use setup::{Simulation, Task};
