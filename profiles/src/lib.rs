#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "nurbs")]
extern crate alloc;

mod chain;
pub mod complex;
mod cursor;
mod error;
mod laws;
#[cfg(feature = "nurbs")]
pub mod nurbs;
mod polynomial;
mod profile;
mod pulses;
mod quantities;
mod section;
mod stretch;
pub mod switched;
mod table;

pub use chain::{Chain, Link};
pub use cursor::Cursor;
pub use error::{ChainError, ClockError, LimitsError, ModeError, PlanError, PulseError, TableError};
pub use laws::{Cosine, FivePhase, SCurve, SnapLimited, Trapezoid};
pub use num_complex::Complex;
pub use polynomial::Piecewise;
pub use profile::{Extrema, Profile, residual_vibration, transform};
pub use pulses::{Counts, Direction, Period, Periods, Pulse, PulseTrain, Pulses};
pub use quantities::{Interval, Limits, Mode, Real, Sample, State};
pub use section::{Section, Sectioned};
pub use table::{write_c_table, write_csv};

#[cfg(test)]
extern crate std;
