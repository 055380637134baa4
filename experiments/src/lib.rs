#![doc = include_str!("../README.md")]

pub mod bench;
pub mod cli;
pub mod expected;
pub mod experiment;
pub mod figure;
pub mod number;
pub mod papers;
pub mod progress;
pub mod readme;
pub mod registry;
pub mod report;
pub mod row;
pub mod studies;
pub mod tune;

/// The README of the repository, whose examples are tests of this crate.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
