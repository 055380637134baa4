//! The configuration as it is written down; an absent limit is infinite, which JSON could not say.

use profiles::Real;

use super::{CurrentLoop, PiGains};
use crate::error::CurrentLoopError;

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
)]
pub(super) struct UncheckedCurrentLoop<F> {
    d_gains: PiGains<F>,
    q_gains: PiGains<F>,
    period: F,
    #[serde(default)]
    d_inductance: F,
    #[serde(default)]
    q_inductance: F,
    #[serde(default)]
    flux: F,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    voltage_limit: Option<F>,
}

impl<F: Real> TryFrom<UncheckedCurrentLoop<F>> for CurrentLoop<F> {
    type Error = CurrentLoopError;
    fn try_from(unchecked: UncheckedCurrentLoop<F>) -> Result<Self, CurrentLoopError> {
        let UncheckedCurrentLoop { d_gains, q_gains, period, .. } = unchecked;
        let current_loop = Self::new(d_gains, q_gains, period)?.with_decoupling(
            unchecked.d_inductance,
            unchecked.q_inductance,
            unchecked.flux,
        )?;
        current_loop.with_voltage_limit(unchecked.voltage_limit.unwrap_or(current_loop.voltage_limit()))
    }
}

impl<F: Real> From<CurrentLoop<F>> for UncheckedCurrentLoop<F> {
    fn from(current_loop: CurrentLoop<F>) -> Self {
        let (d_inductance, q_inductance, flux) = current_loop.decoupling();
        Self {
            d_gains: current_loop.d_gains(),
            q_gains: current_loop.q_gains(),
            period: current_loop.period(),
            d_inductance,
            q_inductance,
            flux,
            voltage_limit: Some(current_loop.voltage_limit()).filter(|limit| limit.is_finite()),
        }
    }
}
