//! Configurations as they are written down; an absent limit is infinite, which JSON could not say.

use profiles::Real;

use super::config::SlidingMode;
use super::model::AxisModel;
use super::reaching::{self, ReachingLaw, Switching};
use super::sampling::Sampling;
use super::super_twisting::SuperTwisting;
use super::surface::{self, SlidingSurface};
use crate::error::SlidingModeError;

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum UncheckedSurface<F> {
    Linear {
        c: F,
    },
    Terminal {
        alpha: F,
        beta: F,
        p: u32,
        q: u32,
        #[serde(default = "none", skip_serializing_if = "Option::is_none")]
        guard: Option<F>,
    },
    NonsingularTerminal {
        beta: F,
        p: u32,
        q: u32,
    },
    FastNonsingularTerminal {
        alpha: F,
        g: F,
        beta: F,
        p: u32,
        q: u32,
    },
}

fn none<F>() -> Option<F> {
    None
}

impl<F: Real> TryFrom<UncheckedSurface<F>> for SlidingSurface<F> {
    type Error = SlidingModeError;
    fn try_from(unchecked: UncheckedSurface<F>) -> Result<Self, SlidingModeError> {
        match unchecked {
            UncheckedSurface::Linear { c } => Self::linear(c),
            UncheckedSurface::Terminal { alpha, beta, p, q, guard } => {
                let surface = Self::terminal(alpha, beta, p, q)?;
                guard.map_or(Ok(surface), |guard| surface.with_guard(guard))
            }
            UncheckedSurface::NonsingularTerminal { beta, p, q } => Self::nonsingular_terminal(beta, p, q),
            UncheckedSurface::FastNonsingularTerminal { alpha, g, beta, p, q } => {
                Self::fast_nonsingular_terminal(alpha, g, beta, p, q)
            }
        }
    }
}

impl<F: Real> From<SlidingSurface<F>> for UncheckedSurface<F> {
    fn from(surface: SlidingSurface<F>) -> Self {
        match surface.0 {
            surface::Kind::Linear { c } => Self::Linear { c },
            surface::Kind::Terminal { alpha, beta, p, q, guard } => {
                Self::Terminal { alpha, beta, p, q, guard }
            }
            surface::Kind::NonsingularTerminal { beta, p, q } => Self::NonsingularTerminal { beta, p, q },
            surface::Kind::FastNonsingularTerminal { alpha, g, beta, p, q } => {
                Self::FastNonsingularTerminal { alpha, g, beta, p, q }
            }
        }
    }
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
)]
pub(super) struct UncheckedLaw<F> {
    law: reaching::Kind<F>,
    #[serde(default)]
    switching: Switching<F>,
}

impl<F: Real> TryFrom<UncheckedLaw<F>> for ReachingLaw<F> {
    type Error = SlidingModeError;
    fn try_from(unchecked: UncheckedLaw<F>) -> Result<Self, SlidingModeError> {
        Self::checked(unchecked.law)?.with_switching(unchecked.switching)
    }
}

impl<F: Real> From<ReachingLaw<F>> for UncheckedLaw<F> {
    fn from(ReachingLaw { kind, switching }: ReachingLaw<F>) -> Self {
        Self { law: kind, switching }
    }
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
)]
pub(super) struct UncheckedSlidingMode<F> {
    surface: SlidingSurface<F>,
    reaching: ReachingLaw<F>,
    model: AxisModel<F>,
    period: F,
    #[serde(default)]
    sampling: Sampling,
    #[serde(default)]
    integral_gain: F,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lower: Option<F>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    upper: Option<F>,
}

impl<F: Real> TryFrom<UncheckedSlidingMode<F>> for SlidingMode<F> {
    type Error = SlidingModeError;
    fn try_from(unchecked: UncheckedSlidingMode<F>) -> Result<Self, SlidingModeError> {
        let mode = Self::new(unchecked.surface, unchecked.reaching, unchecked.model, unchecked.period)?
            .with_sampling(unchecked.sampling)?
            .with_integral_compensation(unchecked.integral_gain)?;
        let (lower, upper) = mode.output_limits();
        mode.with_output_limits(unchecked.lower.unwrap_or(lower), unchecked.upper.unwrap_or(upper))
    }
}

impl<F: Real> From<SlidingMode<F>> for UncheckedSlidingMode<F> {
    fn from(mode: SlidingMode<F>) -> Self {
        Self {
            surface: mode.surface(),
            reaching: mode.law(),
            model: mode.model(),
            period: mode.period(),
            sampling: mode.sampling(),
            integral_gain: mode.integral_gain(),
            lower: Some(mode.output_limits().0).filter(|limit| limit.is_finite()),
            upper: Some(mode.output_limits().1).filter(|limit| limit.is_finite()),
        }
    }
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
)]
pub(super) struct UncheckedSuperTwisting<F> {
    surface: SlidingSurface<F>,
    k1: F,
    k2: F,
    model: AxisModel<F>,
    period: F,
    #[serde(default)]
    sampling: Sampling,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lower: Option<F>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    upper: Option<F>,
}

impl<F: Real> TryFrom<UncheckedSuperTwisting<F>> for SuperTwisting<F> {
    type Error = SlidingModeError;
    fn try_from(unchecked: UncheckedSuperTwisting<F>) -> Result<Self, SlidingModeError> {
        let UncheckedSuperTwisting { surface, k1, k2, model, period, sampling, .. } = unchecked;
        let twisting = Self::new(surface, k1, k2, model, period)?.with_sampling(sampling);
        let (lower, upper) = twisting.output_limits();
        twisting.with_output_limits(unchecked.lower.unwrap_or(lower), unchecked.upper.unwrap_or(upper))
    }
}

impl<F: Real> From<SuperTwisting<F>> for UncheckedSuperTwisting<F> {
    fn from(twisting: SuperTwisting<F>) -> Self {
        let (k1, k2) = twisting.gains();
        let (lower, upper) = twisting.output_limits();
        Self {
            surface: twisting.surface(),
            k1,
            k2,
            model: twisting.model(),
            period: twisting.period(),
            sampling: twisting.sampling(),
            lower: Some(lower).filter(|limit| limit.is_finite()),
            upper: Some(upper).filter(|limit| limit.is_finite()),
        }
    }
}
