//! One module per paper.

pub mod acceleration_curves;
pub mod belt_pso;
pub mod cross_coupling;
pub mod delay_filter;
