//! One module per paper.

pub mod acceleration_curves;
