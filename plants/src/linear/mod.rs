//! Transitions, eigenvalues and linearisation.

mod eigenvalues;
mod linearise;
mod monodromy;
mod transition;

pub use eigenvalues::{eigenvalues, spectral_radius};
pub use linearise::linearise;
pub use monodromy::monodromy;
pub use transition::{Transition, zero_order_hold};
