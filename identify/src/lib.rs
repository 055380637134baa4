#![doc = include_str!("../README.md")]

mod decrement;
mod error;
mod fit_percentage;
mod least_squares;
mod log;
mod moving_average;
mod peaks;
mod response_class;
mod signal;
mod sinusoids;
mod spectrum;
mod transfer_function;

pub use decrement::LogarithmicDecrement;
pub use error::{DecrementError, SignalError, SinusoidError, TransferFunctionError};
pub use fit_percentage::fit_percentage;
pub use log::{Fitted, Log, LogError, LogFigures, LogMode, LogModes, LogOptions, Rest, Route, identify_log};
pub use moving_average::MovingAverage;
pub use peaks::{Peak, Peaks};
pub use response_class::{ClassifiedResponse, ResponseClass, ResponseClassifier};
pub use signal::Signal;
pub use sinusoids::{DampedSinusoids, DecayEstimate, ModeEstimate, SinusoidOptions, fit_damped_sinusoids};
pub use spectrum::{SpectralPeak, Spectrum, SpectrumOptions, Window, amplitude_spectrum};
pub use transfer_function::{
    Hold, RootEstimate, TransferFunctionFit, TransferFunctionOptions, fit_transfer_function,
};
