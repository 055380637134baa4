//! Where the energy of a motion went.

mod energetic;
mod held;
mod ledger;

pub use energetic::{Energetic, Powers};
pub use held::{HeldEnergetic, Work};
pub use ledger::EnergyLedger;
