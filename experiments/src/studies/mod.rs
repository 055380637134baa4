//! One module per study of our own.

pub mod zero_vibration;
