//! The coupling of axes by their contour error.

use profiles::Real;

use super::contour_error::ContourError;
use super::error::{ContourFault, CouplingError};
use super::frame::PathFrame;
use super::vector::{check, in_range, subtract, zip};

/// Cross-coupling of `N` axes, eq. (15): every axis is given more of the error that matters,
///
/// `C = E + lambda e`
///
/// with the tracking error `E`, the contour error `e` and a gain `lambda` for each axis. Both errors point from the
/// actual position to where it should be. Any law that works on an error can take `C` for it: see
/// [`couple`](Self::couple) for laws on an error and its rate, [`setpoints`](Self::setpoints) for those on a set-point
/// and a measurement. A gain of zero leaves its axis as it is, to the bit.
///
/// ```
/// use control::{CrossCoupling, PathFrame, Pid, PidGains, PidInput, PidState};
///
/// let coupling = CrossCoupling::new([0.5, 2.0])?;
/// let pid = Pid::new(PidGains { kp: 10.0, ..PidGains::default() }, 1e-3)?;
/// let mut axes = [PidState::new(); 2];
///
/// // Along x, 0.25 m late and 0.125 m off: only y is given more.
/// let path = PathFrame::along([1.0, 0.0])?;
/// let (reference, position) = ([3.0, 1.0], [2.75, 0.875]);
/// let setpoints = coupling.setpoints(reference, position, path.as_ref());
/// assert_eq!(setpoints, [3.0, 1.25]);
/// let torque = pid.update(&mut axes[1], PidInput::new(setpoints[1], position[1])).output;
/// assert_eq!(torque, 10.0 * 0.375);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
/// W. Wang, Z. Chen, Z. Wang, "Compensation sliding cross coupling control research of Cartesian coordinate robot",
/// Journal of System Simulation 33 (2021), eq. (15), doi:10.16182/j.issn1004731x.joss.19-0646. Y. Koren, C. C. Lo,
/// "Variable-gain cross-coupling controller for contouring", CIRP Annals 40 (1991),
/// doi:10.1016/S0007-8506(07)62009-5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossCoupling<const N: usize, F = f64> {
    gains: [F; N],
}

/// What a coupling makes of the errors of its axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coupled<const N: usize, F = f64> {
    /// `C = E + lambda e`; without a contour error `E` as it was given.
    pub errors: [F; N],
    /// `E' + lambda e'` with the path held still: `e'` is the part of `E'` across the path. Without a contour error
    /// `E'` as it was given.
    pub rates: [F; N],
    /// The contour error, or why there is none.
    pub contour: Result<ContourError<N, F>, ContourFault>,
}

impl<const N: usize, F: Real> CrossCoupling<N, F> {
    /// A coupling with a gain for each axis, without unit.
    ///
    /// # Errors
    /// A gain that is negative, infinite or NaN.
    pub fn new(gains: [F; N]) -> Result<Self, CouplingError> {
        let valid = |gain: &F| *gain >= F::ZERO && gain.is_finite();
        match gains.iter().enumerate().find(|(_, gain)| !valid(gain)) {
            None => Ok(Self { gains }),
            Some((axis, gain)) => Err(CouplingError::Gain { axis, value: gain.to_f64() }),
        }
    }

    /// A coupling with the same gain for every axis.
    ///
    /// # Errors
    /// A gain that is negative, infinite or NaN.
    pub fn uniform(gain: F) -> Result<Self, CouplingError> {
        Self::new([gain; N])
    }

    /// The gain `lambda` of every axis.
    #[must_use]
    pub fn gains(&self) -> [F; N] {
        self.gains
    }

    /// Couples tracking errors `E = R - P` and their rates; `path` is the path about the reference, none where it has
    /// no direction.
    ///
    /// Whatever has no contour error is left uncoupled and says why: an axis whose error or rate is not finite keeps
    /// it, for its own law to answer, and costs the others no more than their coupling.
    #[inline(always)]
    #[must_use]
    pub fn couple(&self, errors: [F; N], rates: [F; N], path: Option<&PathFrame<N, F>>) -> Coupled<N, F> {
        let coupled = ContourError::new(errors, path).and_then(|contour| {
            check("rate of the error", rates)?;
            let errors = self.add("coupled error", errors, contour.vector())?;
            let rates = self.add("rate of the coupled error", rates, contour.across(rates))?;
            Ok(Coupled { errors, rates, contour: Ok(contour) })
        });
        coupled.unwrap_or_else(|fault| Coupled { errors, rates, contour: Err(fault) })
    }

    /// The set-points `R + lambda e` with which the errors of the axes are the coupled ones, for laws that take a
    /// set-point and a measurement, like [`Pid`](crate::Pid). Without a contour error they are `R`.
    #[inline(always)]
    #[must_use]
    pub fn setpoints(&self, references: [F; N], positions: [F; N], path: Option<&PathFrame<N, F>>) -> [F; N] {
        ContourError::new(subtract(references, positions), path)
            .and_then(|contour| self.add("coupled set-point", references, contour.vector()))
            .unwrap_or(references)
    }

    /// `a + lambda b`.
    #[inline(always)]
    fn add(&self, quantity: &'static str, a: [F; N], b: [F; N]) -> Result<[F; N], ContourFault> {
        // Minus zero is what changes no number when it is added, not even the sign of a zero.
        let b = zip(self.gains, b, |gain, b| if gain > F::ZERO { gain * b } else { -F::ZERO });
        in_range(quantity, zip(a, b, |a, b| a + b))
    }
}
