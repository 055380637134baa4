//! Motions made of sections with constant snap.

mod extrema;
mod piecewise;
mod ramp;
pub(crate) mod response;

pub(crate) use piecewise::Piece;
pub use piecewise::Piecewise;
pub(crate) use ramp::Ramp;
