//! The moves a recommendation chooses from.

use profiles::{Complex, Extrema, Profile, SCurve, Sample};
use shaping::Shaped;

use super::shapers::{CAPACITY, ShaperKind};

/// How a move is kept from leaving vibration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum MoveKind {
    /// The S-curve, which knows of no mode.
    SCurve,
    /// The S-curve through a shaper of one kind for every mode.
    Shaped(ShaperKind),
}

impl MoveKind {
    /// In words.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::SCurve => "S-curve".to_owned(),
            Self::Shaped(kind) => format!("S-curve with {}", kind.name()),
        }
    }
}

/// A move that was planned for a recommendation.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Motion {
    /// The S-curve.
    SCurve(SCurve),
    /// The S-curve through a train.
    Shaped(Box<Shaped<SCurve, CAPACITY>>),
}

impl Motion {
    fn profile(&self) -> &dyn Profile {
        match self {
            Self::SCurve(profile) => profile,
            Self::Shaped(profile) => profile.as_ref(),
        }
    }
}

impl Profile for Motion {
    fn duration(&self) -> f64 {
        self.profile().duration()
    }
    fn sample(&self, t: f64) -> Sample {
        self.profile().sample(t)
    }
    fn extrema(&self) -> Extrema {
        self.profile().extrema()
    }
    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        self.profile().response(p)
    }
}
