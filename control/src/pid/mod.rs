//! The PID controller in parallel form: configuration, memory, law and switching.

mod config;
mod state;
mod switching;
mod update;

pub use config::{AntiWindup, DerivativeOn, Pid, PidGains};
pub use state::PidState;
pub use update::{PidInput, PidOutput, Status};
