//! Which move for a distance within limits.

use profiles::{Chain, Complex, Limits, Mode, Profile, SCurve, residual_vibration};
use shaping::Shaped;

use super::error::{RecommendError, not_negative, positive};
use super::motion::{Motion, MoveKind};
use super::region::{Region, UncertainMode};
use super::shapers::{all_together, kinds};
use crate::vibration_free::{Robustness, plan};

/// What a move has to do.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MoveTask {
    /// Signed distance, m.
    pub distance: f64,
    /// What the axis can do.
    pub limits: Limits,
    /// Amplitude of vibration of the response that counts as rest, in the unit of the response.
    pub tolerated: f64,
    /// Standard deviations of the modes to reckon with.
    pub deviations: f64,
}

/// A move with what it leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedMove {
    /// How it is kept from leaving vibration.
    pub kind: MoveKind,
    /// The move.
    pub motion: Motion,
    /// Vibration at its end of the modes as estimated, in the unit of the response: the sum of their amplitudes.
    pub nominal: f64,
    /// A bound of that over all the modes may be.
    pub worst: f64,
    /// Time after its end until that bound is tolerated, s; zero where it is at once, none where it never is.
    pub settling: Option<f64>,
}

impl JudgedMove {
    /// Time from the start until the vibration is tolerated whatever the modes, s; infinite where it never is.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.settling.map_or(f64::INFINITY, |settling| self.motion.duration() + settling)
    }
}

/// Moves in the order of merit.
#[derive(Debug, Clone, PartialEq)]
pub struct MoveRecommendation {
    /// All that were judged, the best first.
    pub moves: Vec<JudgedMove>,
}

impl MoveRecommendation {
    /// The best.
    #[must_use]
    pub fn best(&self) -> Option<&JudgedMove> {
        self.moves.first()
    }

    /// The first of a kind.
    #[must_use]
    pub fn of_kind(&self, kind: MoveKind) -> Option<&JudgedMove> {
        self.moves.iter().find(|judged| judged.kind == kind)
    }
}

/// The move after which the vibration is tolerated soonest, whatever the modes within their deviations.
///
/// Every candidate is planned for the modes as estimated and judged by a bound over all they may be. Of those that are
/// done at the same time (to a thousandth of the S-curve's duration) the one that leaves least is best. Without modes the
/// S-curve is.
///
/// ```
/// use optimize::{MoveKind, MoveTask, UncertainMode, recommend_move};
/// use profiles::{Limits, Mode, Profile};
///
/// let mode = Mode::from_hz(8.0, 0.02)?;
/// let modes = [UncertainMode::new(mode, 0.05, 0.002)?]; // rad/s
/// let task = MoveTask { distance: 0.1, limits: Limits::new(0.5, 5.0, 200.0)?, tolerated: 1e-4, deviations: 3.0 };
/// let found = recommend_move(&modes, &task)?;
/// let (best, plain) = (found.best().ok_or("none")?, found.of_kind(MoveKind::SCurve).ok_or("none")?);
/// assert!(best.worst <= 1e-4 && best.settling == Some(0.0));
/// assert!(best.total() < plain.total());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A distance of zero, a tolerated vibration that is not positive, deviations that are negative, a mode too vague to
/// reckon with, limits within which no S-curve can be planned.
pub fn recommend_move(
    modes: &[UncertainMode],
    task: &MoveTask,
) -> Result<MoveRecommendation, RecommendError> {
    let tolerated = positive("the tolerated vibration", task.tolerated)?;
    let deviations = not_negative("the number of deviations", task.deviations)?;
    positive("the length of a move", task.distance.abs())?;
    let regions: Vec<Region> =
        modes.iter().map(|mode| Region::of(mode, deviations)).collect::<Result<_, _>>()?;
    let plain = SCurve::rest_to_rest(task.distance, &task.limits)?;
    let judged = |kind, motion| judged(kind, motion, modes, &regions, tolerated);
    let without = judged(MoveKind::SCurve, Motion::SCurve(Box::new(plain)));
    // What an insensitive shaper may leave of the vibration.
    let part = tolerated / without.worst.max(tolerated);
    let with = candidates(modes, &plain, task, part).into_iter().chain(optima(modes, task));
    let mut moves: Vec<JudgedMove> = with.map(|(kind, motion)| judged(kind, motion)).collect();
    moves.push(without);
    moves.sort_by(|a, b| a.total().total_cmp(&b.total()));
    let tie = moves.first().map_or(0.0, JudgedMove::total) + 1e-3 * plain.duration();
    let equal = moves.iter().enumerate().take_while(|(_, judged)| judged.total() <= tie);
    let best = equal.min_by(|(_, a), (_, b)| a.worst.total_cmp(&b.worst)).map_or(0, |(at, _)| at);
    if let Some(equal) = moves.get_mut(..=best) {
        equal.rotate_right(1);
    }
    Ok(MoveRecommendation { moves })
}

/// The moves that know of the modes; a kind that cannot be made for them is left out.
fn candidates(
    modes: &[UncertainMode],
    plain: &SCurve,
    task: &MoveTask,
    part: f64,
) -> Vec<(MoveKind, Motion)> {
    if modes.is_empty() {
        return Vec::new();
    }
    let all: Vec<Mode> = modes.iter().map(UncertainMode::mode).collect();
    let chains = (1..=2).filter_map(|order| {
        let zeros: Vec<Mode> = all.iter().flat_map(|mode| std::iter::repeat_n(*mode, order)).collect();
        let chain = Chain::rest_to_rest(task.distance, &task.limits, &zeros).ok()?;
        Some((MoveKind::Chain { order }, Motion::Chain(Box::new(chain))))
    });
    let shaped = kinds(part).into_iter().filter_map(|shaper| {
        let trains = all.iter().map(|mode| shaper.train(*mode)).collect::<Result<Vec<_>, _>>().ok()?;
        let shaped = Shaped::new(*plain, all_together(&trains).ok()?);
        Some((MoveKind::Shaped(shaper), Motion::Shaped(Box::new(shaped))))
    });
    chains.chain(shaped).collect()
}

/// The time optimum with every robustness; one that is not found is left out.
fn optima(modes: &[UncertainMode], task: &MoveTask) -> Vec<(MoveKind, Motion)> {
    /// What a band may leave, as a part of what is tolerated: the rest is for the damping.
    const PART: f64 = 0.8;
    if modes.is_empty() {
        return Vec::new();
    }
    let all: Vec<Mode> = modes.iter().map(UncertainMode::mode).collect();
    let parts = modes.iter().map(|mode| mode.frequency_deviation() / mode.mode().angular_frequency());
    let half_width = task.deviations * parts.fold(0.0, f64::max);
    let largest = modes.iter().map(UncertainMode::participation).fold(0.0, f64::max);
    let residual = PART * task.tolerated / (task.distance.abs() * largest * modes.len() as f64);
    let band = Robustness::Band { half_width, residual };
    let kinds = [Robustness::None, Robustness::DoubleZero, band].into_iter();
    kinds
        .filter_map(|robustness| {
            let motion = plan(task.distance, &task.limits, &all, robustness).ok()?;
            Some((MoveKind::Optimum(robustness), Motion::Optimum(Box::new(motion))))
        })
        .collect()
}

fn judged(
    kind: MoveKind,
    motion: Motion,
    modes: &[UncertainMode],
    regions: &[Region],
    tolerated: f64,
) -> JudgedMove {
    let nominal = modes.iter().map(|m| m.participation() * residual_vibration(&motion, m.mode())).sum();
    let (acceleration, duration) = (motion.extrema().acceleration.magnitude(), motion.duration());
    // Of the integral of a(u) e^(p (T - u)): the first and the second derivative by p.
    let slopes = [acceleration * duration.powi(2) / 2.0, acceleration * duration.powi(3) / 3.0];
    let left: Vec<(f64, f64)> = modes
        .iter()
        .zip(regions)
        .map(|(mode, region)| {
            let unit = mode.participation() / region.lowest_damped();
            let slack = 0.01 * tolerated / (unit * modes.len() as f64).max(f64::MIN_POSITIVE);
            let bound = region.bound(|p: Complex<f64>| motion.response(p), slopes, slack);
            (unit * bound, region.slowest_decay())
        })
        .collect();
    let worst = left.iter().map(|(amplitude, _)| amplitude).sum();
    JudgedMove { kind, motion, nominal, worst, settling: settling(&left, tolerated) }
}

/// The time after which amplitudes that decay with their rates add up to no more than tolerated; none if they never do.
fn settling(left: &[(f64, f64)], tolerated: f64) -> Option<f64> {
    let at = |t: f64| left.iter().map(|(amplitude, rate)| amplitude * (-rate * t).exp()).sum::<f64>();
    if at(0.0) <= tolerated {
        return Some(0.0);
    }
    let lasting: f64 = left.iter().filter(|(_, rate)| *rate <= 0.0).map(|(amplitude, _)| amplitude).sum();
    if lasting >= tolerated || !at(0.0).is_finite() {
        return None;
    }
    // By then every mode alone has fallen to an equal share of what is left to them.
    let share = (tolerated - lasting) / left.len() as f64;
    let mut late = left
        .iter()
        .filter(|(amplitude, rate)| *rate > 0.0 && *amplitude > share)
        .map(|(amplitude, rate)| (amplitude / share).ln() / rate)
        .fold(0.0, f64::max);
    let mut early = 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (early + late);
        if at(middle) <= tolerated {
            late = middle;
        } else {
            early = middle;
        }
    }
    Some(late)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settling_by_hand() {
        assert_eq!(settling(&[(1.0, 0.0)], 2.0), Some(0.0));
        assert_eq!(settling(&[(3.0, 0.0)], 2.0), None);
        let e = std::f64::consts::E;
        // Bisection to a part in 2^60 of the interval.
        assert!((settling(&[(e, 4.0)], 1.0).expect("decays") - 0.25).abs() < 1e-12);
        let two = settling(&[(1.0, 2.0), (1.0, 2.0)], 2.0 / e).expect("decays");
        assert!((two - 0.5).abs() < 1e-12);
        let mixed = settling(&[(1.0, 0.0), (e, 1.0)], 2.0).expect("decays");
        assert!((mixed - 1.0).abs() < 1e-12);
    }
}
