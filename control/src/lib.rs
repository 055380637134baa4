#![no_std]
#![doc = include_str!("../README.md")]

mod cascade;
mod contour;
mod current;
mod error;
mod feedforward;
mod field_oriented;
mod finite;
mod observer;
mod pid;
mod range;
mod sliding;
mod transform;

pub use cascade::{Cascade, CascadeInput, CascadeOutput, CascadeState};
pub use contour::{
    CommandedPath, ContourBasis, ContourError, ContourFault, Coupled, CouplingError, CrossCoupling, PathFrame,
};
pub use current::{
    CurrentInput, CurrentLoop, CurrentLoopState, CurrentOutput, CurrentStatus, PiGains, Windings,
};
pub use error::{
    CascadeError, CurrentLoopError, FeedforwardError, FieldOrientedError, ObserverError, PidError,
    SlidingModeError,
};
pub use feedforward::Feedforward;
pub use field_oriented::{FieldOriented, FieldOrientedInput, FieldOrientedOutput, FieldOrientedState};
pub use observer::{DisturbanceEstimate, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState};
pub use pid::{AntiWindup, DerivativeOn, Pid, PidGains, PidInput, PidOutput, PidState, Status};
pub use sliding::{
    AxisModel, ReachingLaw, Sampling, SlidingMode, SlidingModeInput, SlidingModeOutput, SlidingModeState,
    SlidingSurface, SuperTwisting, SuperTwistingState, Switching,
};
pub use transform::{AlphaBeta, Dq, Phases, Rotation};

#[cfg(test)]
extern crate std;
