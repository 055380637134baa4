//! Plants that know their energy.

use nalgebra::SVector;

use crate::models::Plant;

/// The flows of energy through a plant at an instant, W.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Powers {
    /// Work of the input on the plant per time, W.
    pub input: f64,
    /// Heat per time, W; never negative.
    pub dissipated: f64,
    /// Work of the plant on its load per time, W.
    pub delivered: f64,
}

impl Powers {
    /// What must be the growth of the stored energy, W: `input - dissipated - delivered`.
    #[must_use]
    pub fn net(&self) -> f64 {
        self.input - self.dissipated - self.delivered
    }
}

/// A plant that knows its energy: along every motion `d stored / dt = input - dissipated - delivered`.
///
/// A controller's limits are in it: the powers are those of the realised input.
///
/// ```
/// use plants::{Energetic, LinearMotor, Powers, nalgebra::{self, vector}};
///
/// let motor = LinearMotor::new(2.0, 5.0)?;
/// let state = vector![0.0, 3.0]; // m, m/s
/// assert_eq!(motor.stored(&state), 9.0);
/// let powers = motor.powers(&state, &vector![20.0]);
/// assert_eq!(powers, Powers { input: 60.0, dissipated: 45.0, delivered: 0.0 });
/// # Ok::<(), plants::ModelError>(())
/// ```
pub trait Energetic<const N: usize, const M: usize>: Plant<N, M> {
    /// The energy stored in a state, J.
    fn stored(&self, state: &SVector<f64, N>) -> f64;

    /// The flows of energy in a state under an input, W.
    fn powers(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> Powers;
}
