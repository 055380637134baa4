//! What every plant answers.

use nalgebra::SVector;

/// A continuous plant with `N` states and `M` inputs: `x' = f(x, u)`.
///
/// Any function of state and input is one:
///
/// ```
/// use plants::{Plant, nalgebra::{SVector, Vector1, Vector2}};
///
/// // A pendulum of 1 m with a torque per inertia as its input: angle'' = -g sin(angle) + u.
/// let pendulum = |x: &SVector<f64, 2>, u: &SVector<f64, 1>| Vector2::new(x[1], -9.81 * x[0].sin() + u[0]);
/// assert_eq!(pendulum.derivative(&Vector2::new(0.0, 2.0), &Vector1::new(3.0)), Vector2::new(2.0, 3.0));
/// ```
pub trait Plant<const N: usize, const M: usize> {
    /// The derivative of the state with respect to time in s, at `state` under `input`.
    fn derivative(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> SVector<f64, N>;
}

impl<const N: usize, const M: usize, F> Plant<N, M> for F
where
    F: Fn(&SVector<f64, N>, &SVector<f64, M>) -> SVector<f64, N>,
{
    fn derivative(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> SVector<f64, N> {
        self(state, input)
    }
}
