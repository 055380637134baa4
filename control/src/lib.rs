#![no_std]
#![doc = include_str!("../README.md")]

mod error;
mod feedforward;
mod pid;

pub use error::{FeedforwardError, PidError};
pub use feedforward::Feedforward;
pub use pid::{AntiWindup, DerivativeOn, Pid, PidGains, PidInput, PidOutput, PidState, Status};

#[cfg(test)]
extern crate std;
