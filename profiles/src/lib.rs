#![no_std]
//! x
mod error;
mod profile;
mod quantities;
pub use error::{ClockError, LimitsError, ModeError, PlanError};
pub use profile::{Extrema, Profile, residual_vibration, transform};
pub use quantities::{Interval, Limits, Mode, Real, Sample, State};
#[cfg(test)]
extern crate std;
