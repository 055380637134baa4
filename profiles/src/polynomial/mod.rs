//! Motions made of sections with constant snap.

pub(crate) mod extrema;
mod piecewise;
mod ramp;
pub(crate) mod response;

pub(crate) use piecewise::Piece;
pub use piecewise::Piecewise;
pub(crate) use ramp::Ramp;
