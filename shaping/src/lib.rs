#![no_std]
#![doc = include_str!("../README.md")]

mod delay_filter;
mod delay_line;
mod error;
mod family;
mod mode_range;
mod newton;
mod robustness;
mod shaped;
mod train;
#[cfg(feature = "serde")]
mod written;

pub use delay_filter::DelayFilter;
pub use delay_line::{DelayLine, DelayLineOutput, DelayLineState, Status};
pub use error::{DelayFilterError, DelayLineError, ModeRangeError, ShaperError, TrainError};
pub use family::Shaper;
pub use mode_range::ModeRange;
pub use robustness::{Robustness, WorstCase};
pub use shaped::Shaped;
pub use train::{Impulse, ImpulseTrain};

#[cfg(test)]
extern crate std;
