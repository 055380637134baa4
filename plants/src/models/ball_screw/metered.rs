//! Steps of an axis with dry friction, with an account of the energy.

use nalgebra::SVector;

use super::BallScrewAxis;
use super::slide::{NODES, Piece, Slide};
use crate::energy::{Energetic, EnergyLedger, HeldEnergetic};
use crate::error::StepError;
use crate::steppers::{MeteredHold, Stepper};

/// The steps of a [`StickSlip`](crate::StickSlip), to the last bit, and a ledger of the energy that closes to rounding.
///
/// Every entry comes by a way of its own: input, load and dry friction as held torques times the way they went, the
/// stored energy from the states, the heat of damping by Gauss's rule on the motion, five points for a substep.
///
/// ```
/// use plants::{BallScrewAxis, Friction, StickSlip, Stepper, nalgebra::{self, vector}};
///
/// let axis = BallScrewAxis::from_coefficients(0.0, 0.0, 1.0)?;
/// let mut axis = StickSlip::new(axis, Friction::coulomb(2.0)?)?.metered();
/// // 2 rad/s on 1 kg m^2 slide for one radian: all of the 2 J is heat.
/// let state = axis.advance(&vector![0.0, 2.0], &vector![0.0, 0.0], 1.5)?;
/// assert!((state - vector![1.0, 0.0]).norm() < 1e-15);
/// assert!((axis.ledger().dissipated - 2.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct MeteredStickSlip {
    linear: MeteredHold<2, 2, BallScrewAxis>,
    slide: Slide,
    ledger: EnergyLedger,
}

impl MeteredStickSlip {
    pub(super) fn of(linear: MeteredHold<2, 2, BallScrewAxis>, slide: Slide) -> Self {
        Self { linear, slide, ledger: EnergyLedger::default() }
    }

    /// The account of all steps so far.
    #[must_use]
    pub fn ledger(&self) -> &EnergyLedger {
        if self.slide.friction().is_linear() { self.linear.ledger() } else { &self.ledger }
    }
}

impl Stepper<2, 2> for MeteredStickSlip {
    fn advance(
        &mut self,
        state: &SVector<f64, 2>,
        input: &SVector<f64, 2>,
        interval: f64,
    ) -> Result<SVector<f64, 2>, StepError> {
        let Self { linear, slide, ledger } = self;
        if slide.friction().is_linear() {
            return linear.advance(state, input, interval);
        }
        let axis = *slide.axis();
        let mut flow = EnergyLedger::default();
        let next = slide.advance(state, input, interval, |slide, piece| {
            let work = axis.work(input, &(piece.end - piece.start));
            flow.input += work.input;
            flow.delivered += work.delivered;
            flow.dissipated += heat(slide, piece) + piece.dry * (piece.end[0] - piece.start[0]);
        })?;
        flow.stored = axis.stored(&next) - axis.stored(state);
        ledger.add(&flow);
        Ok(next)
    }
}

/// The heat of damping over a piece, J.
fn heat(slide: &Slide, piece: &Piece) -> f64 {
    let mean: f64 = NODES
        .iter()
        .map(|(node, weight)| {
            let state = slide.motion(node * piece.length).apply(&piece.start, piece.acceleration);
            weight * state[1] * state[1]
        })
        .sum();
    slide.axis().damping() * mean * piece.length
}
