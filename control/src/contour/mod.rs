//! Contour errors and the coupling of axes by them.

mod commanded;
mod contour_error;
mod coupling;
mod error;
mod frame;
#[cfg(feature = "serde")]
mod gains;
mod vector;

pub use commanded::CommandedPath;
pub use contour_error::{ContourBasis, ContourError};
pub use coupling::{Coupled, CrossCoupling};
pub use error::{ContourFault, CouplingError};
pub use frame::PathFrame;
