//! Curves: what is exact is exact to rounding, and what cannot be is refused.
#![cfg(feature = "nurbs")]
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

mod arc_length;
mod closest;
mod curves;
mod errors;
mod evaluation;
mod exact;
mod geometry;
mod no_allocation;
