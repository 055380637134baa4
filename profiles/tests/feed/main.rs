//! Feeds along curves: limits hold between the ticks too, steps have the length they should, and no pulse is lost.
#![cfg(feature = "nurbs")]
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]
#![expect(clippy::float_cmp, reason = "ends and peaks are exact")]

mod checks;
#[path = "../nurbs/curves.rs"]
#[allow(dead_code, reason = "only the strategies are used")]
mod curves;
mod drives;
mod errors;
mod kept;
mod simple;
