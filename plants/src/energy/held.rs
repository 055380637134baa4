//! Linear plants that know their energy over a whole step.

use nalgebra::SVector;

use super::Energetic;
use crate::error::ModelError;
use crate::linear::QuadraticIntegral;
use crate::steppers::HeldLinear;

/// The work of a held input over an interval, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work {
    /// Work of the input on the plant, J.
    pub input: f64,
    /// Work of the plant on its load, J.
    pub delivered: f64,
}

/// A linear plant that knows where its energy goes over an interval under a held input, without a sum over time: a
/// held force times the way it went, and the heat as a quadratic form.
pub trait HeldEnergetic<const N: usize, const M: usize>: HeldLinear<N, M> + Energetic<N, M> {
    /// The heat of an interval in s, J, as a form in the state at its start and the realised input.
    ///
    /// # Errors
    /// As [`HeldLinear::transition`].
    fn heat(&self, interval: f64) -> Result<QuadraticIntegral<N, M>, ModelError>;

    /// The work of a held, realised input while the state changes by `change`.
    fn work(&self, realised: &SVector<f64, M>, change: &SVector<f64, N>) -> Work;
}
