//! The moves a recommendation chooses from.

use profiles::{Chain, Complex, Extrema, Profile, SCurve, Sample};
use shaping::{Shaped, Shaper};

use super::shapers::{CAPACITY, shaper_name};

/// Sections of a chain for four modes.
pub(super) const SECTIONS: usize = 191;

/// How a move is kept from leaving vibration.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MoveKind {
    /// The S-curve, which knows of no mode.
    SCurve,
    /// The S-curve through a shaper of one kind for every mode.
    Shaped(Shaper),
    /// A step through a chain of averages with a zero of this order on every mode.
    Chain {
        /// Order of the zeros.
        order: usize,
    },
}

impl MoveKind {
    /// In words.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::SCurve => "S-curve".to_owned(),
            Self::Shaped(shaper) => format!("S-curve with {}", shaper_name(shaper)),
            Self::Chain { order: 1 } => "chain of averages".to_owned(),
            Self::Chain { order } => format!("chain of averages, zeros of order {order}"),
        }
    }
}

/// A move that was planned for a recommendation.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Motion {
    /// The S-curve.
    SCurve(Box<SCurve>),
    /// The S-curve through a train.
    Shaped(Box<Shaped<SCurve, CAPACITY>>),
    /// A step through a chain of averages.
    Chain(Box<Chain<SECTIONS>>),
}

impl Motion {
    fn profile(&self) -> &dyn Profile {
        match self {
            Self::SCurve(profile) => profile.as_ref(),
            Self::Shaped(profile) => profile.as_ref(),
            Self::Chain(profile) => profile.as_ref(),
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
