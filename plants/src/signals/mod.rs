//! What sensors and surroundings add.

mod disturbance;
mod encoder;
mod noise;

pub use disturbance::Disturbance;
pub(crate) use disturbance::DisturbanceSource;
pub use encoder::Encoder;
pub use noise::{GaussianNoise, Noise, UniformNoise};
