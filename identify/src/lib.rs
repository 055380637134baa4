#![doc = include_str!("../README.md")]

mod decrement;
mod error;
mod peaks;
mod response_class;
mod signal;
mod sinusoids;

pub use decrement::LogarithmicDecrement;
pub use error::{DecrementError, SignalError, SinusoidError};
pub use peaks::{Peak, Peaks};
pub use response_class::{ClassifiedResponse, ResponseClass, ResponseClassifier};
pub use signal::Signal;
pub use sinusoids::{DampedSinusoids, DecayEstimate, ModeEstimate, SinusoidOptions, fit_damped_sinusoids};
