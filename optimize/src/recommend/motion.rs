//! The moves a recommendation chooses from.

use profiles::{Chain, Complex, Extrema, Profile, SCurve, Sample};
use shaping::{Shaped, Shaper};

use super::shapers::{CAPACITY, shaper_name};
use crate::vibration_free::{Robustness, VibrationFreeMove};

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
    /// The time optimum that leaves nothing of the modes, or little of their neighbours.
    Optimum(Robustness),
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
            Self::Optimum(Robustness::None) => "time optimum".to_owned(),
            Self::Optimum(Robustness::DoubleZero) => "time optimum, double zeros".to_owned(),
            Self::Optimum(Robustness::Band { half_width, .. }) => {
                format!("time optimum for frequencies within {:.2} %", 100.0 * half_width)
            }
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
    /// The time optimum.
    Optimum(Box<VibrationFreeMove>),
}

impl Motion {
    fn profile(&self) -> &dyn Profile {
        match self {
            Self::SCurve(profile) => profile.as_ref(),
            Self::Shaped(profile) => profile.as_ref(),
            Self::Chain(profile) => profile.as_ref(),
            Self::Optimum(profile) => profile.as_ref(),
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
