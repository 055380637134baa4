//! Moving a plant through time.

mod dormand_prince;
mod integrate;
mod kept;
mod metered_hold;
mod metered_rk4;
mod rk4;
mod stepper;
mod zero_order_hold;

pub use dormand_prince::{DormandPrince, Tolerance};
pub use integrate::{integrate, integrate_adaptive};
pub use metered_hold::MeteredHold;
pub use metered_rk4::MeteredRk4;
pub use rk4::Rk4;
pub use stepper::Stepper;
pub use zero_order_hold::{HeldLinear, ZeroOrderHold};

pub(crate) use kept::Kept;
pub(crate) use stepper::check as check_interval;
