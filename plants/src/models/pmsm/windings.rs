//! The electric half of a synchronous motor.

use nalgebra::SVector;

use crate::error::ModelError;
use crate::models::check::{not_negative, positive};
use crate::simulation::Saturation;

/// The windings of a permanent-magnet synchronous motor in rotor coordinates, and the inverter that feeds them:
///
/// - `L_d i_d' = v_d - R i_d + p w L_q i_q`
/// - `L_q i_q' = v_q - R i_q - p w (L_d i_d + psi)`
/// - `T = 1.5 p (psi i_q + (L_d - L_q) i_d i_q)`
///
/// with `p` pole pairs, rotor speed `w` in rad/s, and the d axis along the flux `psi` of the magnets. Voltages and
/// currents are peak values of a phase, so that `1.5 (v_d i_d + v_q i_q)` is the electric power in W. The inverter may
/// have a limit: a longer voltage vector `[v_d, v_q]` is shortened to it and keeps its direction.
///
/// ```
/// use plants::PmsmWindings;
///
/// let windings = PmsmWindings::surface(2.875, 8.5e-3, 0.175, 3)?.with_voltage_limit(300.0)?;
/// assert!((windings.torque(0.0, 4.0) - 1.5 * 3.0 * 0.175 * 4.0).abs() < 1e-15);
/// assert!((windings.back_emf(100.0) - 52.5).abs() < 1e-13);
/// # Ok::<(), plants::ModelError>(())
/// ```
///
/// # References
/// P. C. Krause, O. Wasynczuk, S. D. Sudhoff and S. Pekarek, "Analysis of Electric Machinery and Drive Systems", 3rd
/// ed., Wiley (2013), doi:10.1002/9781118524336.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedWindings", into = "UncheckedWindings"))]
pub struct PmsmWindings {
    resistance: f64,
    inductance_d: f64,
    inductance_q: f64,
    flux_linkage: f64,
    pole_pairs: u32,
    voltage_limit: f64,
    torque_constant: f64,
    reluctance_constant: f64,
    // What the derivative needs, so that it has neither divisions nor more products than it must.
    per_inductance_d: f64,
    per_inductance_q: f64,
    rate_d: f64,
    rate_q: f64,
    coupling_d: f64,
    coupling_q: f64,
    back_emf_q: f64,
}

// No limit is written as none: formats like JSON have no infinity.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct UncheckedWindings {
    resistance: f64,
    inductance_d: f64,
    inductance_q: f64,
    flux_linkage: f64,
    pole_pairs: u32,
    voltage_limit: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedWindings> for PmsmWindings {
    type Error = ModelError;
    fn try_from(windings: UncheckedWindings) -> Result<Self, ModelError> {
        let checked = Self::new(
            windings.resistance,
            windings.inductance_d,
            windings.inductance_q,
            windings.flux_linkage,
            windings.pole_pairs,
        )?;
        match windings.voltage_limit {
            Some(limit) => checked.with_voltage_limit(limit),
            None => Ok(checked),
        }
    }
}

#[cfg(feature = "serde")]
impl From<PmsmWindings> for UncheckedWindings {
    fn from(windings: PmsmWindings) -> Self {
        Self {
            resistance: windings.resistance,
            inductance_d: windings.inductance_d,
            inductance_q: windings.inductance_q,
            flux_linkage: windings.flux_linkage,
            pole_pairs: windings.pole_pairs,
            voltage_limit: Some(windings.voltage_limit).filter(|limit| limit.is_finite()),
        }
    }
}

impl PmsmWindings {
    /// Windings from their resistance in ohm, their inductances along and across the magnets in H, the flux linkage
    /// of the magnets in Wb and the number of pole pairs; the inverter has no limit.
    ///
    /// # Errors
    /// A resistance or a flux linkage that is negative or not finite, an inductance that is not positive and finite,
    /// no pole pairs, or a ratio of these beyond the range of double precision.
    pub fn new(
        resistance: f64,
        inductance_d: f64,
        inductance_q: f64,
        flux_linkage: f64,
        pole_pairs: u32,
    ) -> Result<Self, ModelError> {
        not_negative("the resistance in ohm", resistance)?;
        positive("the d inductance in H", inductance_d)?;
        positive("the q inductance in H", inductance_q)?;
        not_negative("the flux linkage in Wb", flux_linkage)?;
        let pairs = f64::from(pole_pairs);
        positive("the number of pole pairs", pairs)?;
        let windings = Self {
            resistance,
            inductance_d,
            inductance_q,
            flux_linkage,
            pole_pairs,
            voltage_limit: f64::INFINITY,
            torque_constant: 1.5 * pairs * flux_linkage,
            reluctance_constant: 1.5 * pairs * (inductance_d - inductance_q),
            per_inductance_d: 1.0 / inductance_d,
            per_inductance_q: 1.0 / inductance_q,
            rate_d: resistance / inductance_d,
            rate_q: resistance / inductance_q,
            coupling_d: pairs * (inductance_q / inductance_d),
            coupling_q: pairs * (inductance_d / inductance_q),
            back_emf_q: pairs * (flux_linkage / inductance_q),
        };
        not_negative("the resistance over the d inductance in 1/s", windings.rate_d)?;
        not_negative("the resistance over the q inductance in 1/s", windings.rate_q)?;
        not_negative("the pole pairs times q over d inductance", windings.coupling_d)?;
        not_negative("the pole pairs times d over q inductance", windings.coupling_q)?;
        not_negative("the pole pairs times flux linkage over q inductance in A", windings.back_emf_q)?;
        not_negative("the torque constant in N m/A", windings.torque_constant)?;
        not_negative("the reluctance torque in N m/A^2", windings.reluctance_constant.abs())?;
        Ok(windings)
    }

    /// The windings of a motor with surface magnets: one inductance in H, and torque from `i_q` alone.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn surface(
        resistance: f64,
        inductance: f64,
        flux_linkage: f64,
        pole_pairs: u32,
    ) -> Result<Self, ModelError> {
        Self::new(resistance, inductance, inductance, flux_linkage, pole_pairs)
    }

    /// The same windings on an inverter that gives `[v_d, v_q]` of at most `limit` in V.
    ///
    /// With sinusoidal modulation in its linear range that is the voltage of the intermediate circuit over `sqrt(3)`.
    ///
    /// # Errors
    /// A limit that is not positive and finite.
    pub fn with_voltage_limit(self, limit: f64) -> Result<Self, ModelError> {
        positive("the voltage limit in V", limit)?;
        Ok(Self { voltage_limit: limit, ..self })
    }

    /// Resistance of a phase `R`, ohm.
    #[must_use]
    pub fn resistance(&self) -> f64 {
        self.resistance
    }

    /// Inductance along the magnets `L_d`, H.
    #[must_use]
    pub fn inductance_d(&self) -> f64 {
        self.inductance_d
    }

    /// Inductance across the magnets `L_q`, H.
    #[must_use]
    pub fn inductance_q(&self) -> f64 {
        self.inductance_q
    }

    /// Flux linkage of the magnets `psi`, Wb.
    #[must_use]
    pub fn flux_linkage(&self) -> f64 {
        self.flux_linkage
    }

    /// Number of pole pairs `p`.
    #[must_use]
    pub fn pole_pairs(&self) -> u32 {
        self.pole_pairs
    }

    /// Longest voltage vector, V; infinite without a limit.
    #[must_use]
    pub fn voltage_limit(&self) -> f64 {
        self.voltage_limit
    }

    /// Torque per `i_q` while `i_d` is zero, N m/A: `1.5 p psi`.
    #[must_use]
    pub fn torque_constant(&self) -> f64 {
        self.torque_constant
    }

    /// The torque of a pair of currents in A, N m.
    #[inline]
    #[must_use]
    pub fn torque(&self, i_d: f64, i_q: f64) -> f64 {
        self.torque_less(i_d, i_q, 0.0)
    }

    /// The torque less `friction` in N m, in the order that has the shortest way through the processor.
    #[inline]
    pub(super) fn torque_less(&self, i_d: f64, i_q: f64, friction: f64) -> f64 {
        (self.torque_constant * i_q - friction) + self.reluctance_constant * (i_d * i_q)
    }

    /// The voltage that the magnets induce at a rotor speed in rad/s, V: `p w psi`, along the q axis.
    #[must_use]
    pub fn back_emf(&self, speed: f64) -> f64 {
        f64::from(self.pole_pairs) * speed * self.flux_linkage
    }

    /// What the inverter makes of a command `[v_d, v_q, ...]` in V; what follows the voltages passes.
    #[inline]
    #[must_use]
    pub fn realised<const M: usize>(&self, input: &SVector<f64, M>) -> SVector<f64, M> {
        self.saturation().apply(input)
    }

    /// The voltage limit as limits of the input, for the simulation to hand back to the controller.
    #[inline]
    #[must_use]
    pub fn saturation<const M: usize>(&self) -> Saturation<M> {
        Saturation::circle_unchecked(self.voltage_limit)
    }

    /// The realised voltages `v_d`, `v_q`.
    #[inline]
    pub(super) fn voltages(&self, v_d: f64, v_q: f64) -> (f64, f64) {
        // The square decides without a root; where it overflows so does the vector exceed any limit.
        let square = v_d * v_d + v_q * v_q;
        if square > self.voltage_limit * self.voltage_limit { self.shortened(v_d, v_q) } else { (v_d, v_q) }
    }

    #[cold]
    fn shortened(&self, v_d: f64, v_q: f64) -> (f64, f64) {
        let realised = self.realised(&SVector::from([v_d, v_q]));
        (realised[0], realised[1])
    }

    /// The derivatives of the currents in A/s under a command in V.
    #[inline]
    pub(super) fn currents(&self, i_d: f64, i_q: f64, speed: f64, v_d: f64, v_q: f64) -> (f64, f64) {
        let (v_d, v_q) = self.voltages(v_d, v_q);
        let along = v_d * self.per_inductance_d - self.rate_d * i_d + self.coupling_d * (speed * i_q);
        let across = v_q * self.per_inductance_q
            - self.rate_q * i_q
            - speed * (self.coupling_q * i_d + self.back_emf_q);
        (along, across)
    }

    /// Energy of the currents, J: `0.75 (L_d i_d^2 + L_q i_q^2)`.
    #[must_use]
    pub fn magnetic_energy(&self, i_d: f64, i_q: f64) -> f64 {
        0.75 * (self.inductance_d * i_d * i_d + self.inductance_q * i_q * i_q)
    }

    /// Heat in the windings, W: `1.5 R (i_d^2 + i_q^2)`.
    #[must_use]
    pub fn copper_loss(&self, i_d: f64, i_q: f64) -> f64 {
        1.5 * self.resistance * (i_d * i_d + i_q * i_q)
    }
    /// Electric power of a command `v_d`, `v_q` as the inverter realises it, W.
    pub(super) fn electric_power(&self, v_d: f64, v_q: f64, i_d: f64, i_q: f64) -> f64 {
        let (v_d, v_q) = self.voltages(v_d, v_q);
        1.5 * (v_d * i_d + v_q * i_q)
    }
}
