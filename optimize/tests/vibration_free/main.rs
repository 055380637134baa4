//! The shortest motions that leave nothing of given modes: nothing left, limits held, ends exact, and no shorter way known.
#![expect(clippy::expect_used, clippy::float_cmp, reason = "helpers fail as tests do; ends are exact")]

mod bands;
mod clocked;
mod failures;
mod programme;
mod published;
mod ramps;
mod random;
mod replanned;
mod tasks;
