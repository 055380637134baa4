//! Transitions, eigenvalues and linearisation.

mod eigenvalues;
mod linearise;
mod monodromy;
mod quadratic_integral;
mod roots;
mod transition;

pub(crate) use eigenvalues::eigenvalues_of;
pub use eigenvalues::{eigenvalues, spectral_radius};
pub use linearise::linearise;
pub use monodromy::monodromy;
pub use quadratic_integral::{QuadraticIntegral, quadratic_integral};
pub use roots::polynomial_roots;
pub(crate) use roots::quadratic_roots;
pub(crate) use transition::held_transition;
pub use transition::{Transition, zero_order_hold};
