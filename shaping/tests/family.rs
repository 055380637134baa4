//! The family of shapers against published numbers, its own equations and dense sampling.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use profiles::{Complex, Mode};
use proptest::prelude::*;
use shaping::{DelayFilter, ImpulseTrain, Shaper, ShaperError, TrainError};

fn train<const N: usize>(shaper: Shaper, mode: Mode) -> ImpulseTrain<N> {
    shaper.train(mode).expect("shaper")
}

#[test]
fn smoke() {
    for z in [0.0, 0.02, 0.1, 0.2, 0.3] {
        let mode = Mode::from_hz(40.0, z).expect("mode");
        for s in [
            Shaper::ZV,
            Shaper::ZVD,
            Shaper::ZVDD,
            Shaper::MZV,
            Shaper::UNITY_MAGNITUDE_ZV,
            Shaper::UNITY_MAGNITUDE_ZVD,
            Shaper::extra_insensitive(0.05),
            Shaper::ExtraInsensitive { humps: 2, tolerance: 0.05 },
            Shaper::ExtraInsensitive { humps: 3, tolerance: 0.05 },
            Shaper::Negative { order: 1, demand: 2.0 },
            Shaper::Negative { order: 2, demand: 2.0 },
        ] {
            match s.train::<5>(mode) {
                Ok(t) => {
                    let a: Vec<_> = t.impulses().iter().map(|i| (i.amplitude, i.time * 40.0)).collect();
                    println!("{z} {s:?} {a:?} V {:e}", t.residual(mode));
                }
                Err(e) => println!("{z} {s:?} {e}"),
            }
        }
    }
}
