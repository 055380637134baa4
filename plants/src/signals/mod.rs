//! What sensors and surroundings add.

mod disturbance;
mod encoder;
mod noise;
mod transport_delay;

pub use disturbance::Disturbance;
pub(crate) use disturbance::DisturbanceSource;
pub use encoder::Encoder;
pub use noise::{GaussianNoise, Noise, UniformNoise};
pub use transport_delay::{DelayedHold, TransportDelay};
