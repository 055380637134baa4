//! Permanent-magnet synchronous motors in rotor coordinates.

mod drive;
mod motor;
mod windings;

pub use drive::PmsmDrive;
pub use motor::Pmsm;
pub use windings::PmsmWindings;
