#![no_std]
#![doc = include_str!("../README.md")]

mod delay_filter;
mod delay_line;
mod error;
mod family;
mod newton;
mod shaped;
mod train;

pub use delay_filter::DelayFilter;
pub use delay_line::{DelayLine, DelayLineOutput, DelayLineState, Status};
pub use error::{DelayFilterError, DelayLineError, ShaperError, TrainError};
pub use family::Shaper;
pub use shaped::Shaped;
pub use train::{Impulse, ImpulseTrain};

#[cfg(test)]
extern crate std;
