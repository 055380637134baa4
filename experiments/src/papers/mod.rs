//! One module per paper.

pub mod acceleration_curves;
pub mod delay_filter;
