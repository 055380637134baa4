//! One module per paper.

pub mod acceleration_curves;
pub mod belt_pso;
pub mod delay_filter;
