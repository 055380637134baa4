//! Transitions, eigenvalues and linearisation.

mod eigenvalues;
mod linearise;
mod monodromy;
mod quadratic_integral;
mod transition;

pub use eigenvalues::{eigenvalues, spectral_radius};
pub use linearise::linearise;
pub use monodromy::monodromy;
pub use quadratic_integral::{QuadraticIntegral, quadratic_integral};
pub use transition::{Transition, zero_order_hold};
