//! The configuration as it is written down; an absent limit is infinite, which JSON could not say.

use profiles::Real;

use super::Cascade;
use crate::current::PiGains;
use crate::error::CascadeError;
use crate::feedforward::Feedforward;
use crate::pid::AntiWindup;

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
)]
pub(super) struct UncheckedCascade<F> {
    period: F,
    #[serde(default = "one")]
    position_divisor: u32,
    #[serde(default = "one")]
    velocity_divisor: u32,
    position_gain: F,
    velocity_gains: PiGains<F>,
    #[serde(default)]
    velocity_feedforward: F,
    #[serde(default)]
    feedforward: Feedforward<F>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    velocity_limit: Option<F>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    current_limit: Option<F>,
    #[serde(default)]
    anti_windup: AntiWindup<F>,
}

fn one() -> u32 {
    1
}

impl<F: Real> TryFrom<UncheckedCascade<F>> for Cascade<F> {
    type Error = CascadeError;
    fn try_from(unchecked: UncheckedCascade<F>) -> Result<Self, CascadeError> {
        let cascade = Self::new(unchecked.position_gain, unchecked.velocity_gains, unchecked.period)?
            .with_divisors(unchecked.position_divisor, unchecked.velocity_divisor)?
            .with_velocity_feedforward(unchecked.velocity_feedforward)?
            .with_feedforward(unchecked.feedforward)
            .with_anti_windup(unchecked.anti_windup)?;
        let velocity_limit = unchecked.velocity_limit.unwrap_or(cascade.velocity_limit());
        let current_limit = unchecked.current_limit.unwrap_or(cascade.current_limit());
        cascade.with_velocity_limit(velocity_limit)?.with_current_limit(current_limit)
    }
}

impl<F: Real> From<Cascade<F>> for UncheckedCascade<F> {
    fn from(cascade: Cascade<F>) -> Self {
        let (position_divisor, velocity_divisor) = cascade.divisors();
        Self {
            period: cascade.period(),
            position_divisor,
            velocity_divisor,
            position_gain: cascade.position_gain(),
            velocity_gains: cascade.velocity_gains(),
            velocity_feedforward: cascade.velocity_feedforward(),
            feedforward: cascade.feedforward(),
            velocity_limit: Some(cascade.velocity_limit()).filter(|limit| limit.is_finite()),
            current_limit: Some(cascade.current_limit()).filter(|limit| limit.is_finite()),
            anti_windup: cascade.anti_windup(),
        }
    }
}
