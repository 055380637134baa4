//! A planned motion, in units.

use profiles::switched::{Arc, Contact, Goal, Switched, Zero};
use profiles::{Extrema, Limits, Mode, Piecewise, Profile, SCurve, residual_vibration};

use super::band;
use super::error::VibrationFreeError;
use super::exchange::{Found, exchanged, shorter};
use super::joined::joined;
use super::search::searched;
use super::structure::{Blur, Structure};
use super::task::Task;
use super::{MOST_ARCS, Motion, Request, Robustness};

/// What a zero may leave, as a part of the motion.
const EXACT: f64 = 1e-12;
/// What may be missed of the end by the way there, as a part of the motion.
const REACHED: f64 = 1e-10;
/// Parts by which a number may be off for rounding.
const ROUNDING: f64 = 1e-12;
/// Rad of the fastest mode in the S-curve that are many.
const MANY: f64 = 80.0;
/// What the S-curve is known by.
const S_CURVE: Blur = Blur { shortest: 1e-12, acceleration: 1e-9, velocity: 1e-9, turn: 0.0 };

/// The shortest motion that leaves nothing (or no more than is tolerated) of given modes, see [`plan`](super::plan).
#[derive(Debug, Clone, PartialEq)]
pub struct VibrationFreeMove {
    profile: Piecewise<MOST_ARCS>,
    motion: Switched<MOST_ARCS>,
    contacts: Vec<Contact>,
    goal: Goal,
    task: Task,
    found: Found,
    request: Request,
    limits: Limits,
    modes: Vec<Mode>,
    robustness: Robustness,
    s_curve: f64,
}

impl VibrationFreeMove {
    pub(super) fn planned(
        request: Request,
        limits: &Limits,
        modes: &[Mode],
        robustness: Robustness,
    ) -> Result<Self, VibrationFreeError> {
        let (task, s_curve) = Task::new(&request, limits, modes, robustness)?;
        if s_curve.duration() == 0.0 {
            let nothing = Found {
                structure: Structure::default(),
                motion: Motion::default(),
                multipliers: Some(vec![]),
            };
            return Self::in_units(task, nothing, request, limits, modes, robustness, 0.0);
        }
        let found = match free_already(&task) {
            Some(found) => found,
            None => shortest(&task, request, limits, modes, robustness)?,
        };
        Self::in_units(task, found, request, limits, modes, robustness, s_curve.duration())
    }

    /// The move over another distance within the same limits, from the switches of this one: in a small part of the time
    /// that [`plan`](super::plan) takes where the structure is the same or nearly so, and by `plan` where it is not.
    ///
    /// # Errors
    /// As [`plan`](super::plan), and for a change of velocity, which has no distance.
    pub fn replanned(&self, distance: f64) -> Result<Self, VibrationFreeError> {
        let Request::Move { distance: before } = self.request else {
            return Err(VibrationFreeError::NoDistance(distance));
        };
        let request = Request::Move { distance };
        let anew = || Self::planned(request, &self.limits, &self.modes, self.robustness);
        let ratio = distance / before;
        if !(ratio > 0.0 && ratio.is_finite() && self.found.is_proven()) {
            return anew();
        }
        let s_curve = SCurve::rest_to_rest(distance, &self.limits)?;
        let mut task = self.task.clone();
        // Units are those of the first move.
        task.goal.distance = task.goal.distance.map(|before| before * ratio);
        task.bands.iter_mut().for_each(|band| band.scale(ratio));
        task.places = task.bands.iter().flat_map(|band| band.places()).collect();
        let mut structure = self.found.structure.clone();
        structure.arcs = self.found.motion.arcs().to_vec();
        structure.places.iter_mut().for_each(|place| place.tolerated *= ratio);
        match exchanged(&task, structure, self.found.multipliers.as_deref(), false) {
            Some(found) if found.is_proven() => {
                let (limits, modes) = (&self.limits, &self.modes);
                Self::in_units(task, found, request, limits, modes, self.robustness, s_curve.duration())
                    .or_else(|_| anew())
            }
            _ => anew(),
        }
    }

    fn in_units(
        task: Task,
        found: Found,
        request: Request,
        limits: &Limits,
        modes: &[Mode],
        robustness: Robustness,
        s_curve: f64,
    ) -> Result<Self, VibrationFreeError> {
        let (from, goal) = (request.from(), request.goal());
        let unit = |order: i32| task.length / task.time.powi(order);
        let [velocity, acceleration, jerk] = [limits.velocity(), limits.acceleration(), limits.jerk()];
        // The limit itself, not what is left of it after scaling there and back.
        let known = |value: f64, bounds: profiles::Interval| {
            let near = |bound: &f64| bound.is_finite() && (value - bound).abs() <= ROUNDING * bound.abs();
            [bounds.lower, bounds.upper].into_iter().find(near).unwrap_or(value)
        };
        let arcs: Vec<Arc> = found
            .motion
            .arcs()
            .iter()
            .map(|arc| Arc { jerk: known(arc.jerk * unit(3), jerk), duration: arc.duration * task.time })
            .collect();
        let contacts: Vec<Contact> = found
            .structure
            .contacts
            .iter()
            .map(|contact| match *contact {
                Contact::Acceleration { arc, value } => {
                    Contact::Acceleration { arc, value: known(value * unit(2), acceleration) }
                }
                Contact::Velocity { arc, value } => {
                    Contact::Velocity { arc, value: known(value * unit(1), velocity) }
                }
                Contact::Turn { arc, value } => {
                    Contact::Turn { arc, value: known(value * unit(1), velocity) }
                }
            })
            .collect();
        let scaled = |zero: &Zero| Zero::at(zero.pole() / task.time, zero.is_double());
        let zeros: Vec<Zero> = task.zeros.iter().map(scaled).collect();
        let lost = VibrationFreeError::NotConverged { violation: f64::NAN };
        let close = Switched::new(from, &arcs).ok_or(lost)?;
        // Where modes are so near each other that their zeros are the same but for rounding, it is at rounding already.
        let motion = close.corrected(&goal, &zeros, &contacts).unwrap_or(close);
        let profile = motion.profile(&goal, &contacts);
        let planned = Self {
            profile,
            motion,
            contacts,
            goal,
            task,
            found,
            request,
            limits: *limits,
            modes: modes.to_vec(),
            robustness,
            s_curve,
        };
        planned.verified()
    }

    /// The motion, if it is all that was asked.
    fn verified(self) -> Result<Self, VibrationFreeError> {
        let banded = matches!(self.robustness, Robustness::Band { .. });
        let missed = self.missed().max(self.slopes());
        if missed.is_nan() || missed > REACHED {
            return Err(VibrationFreeError::NotConverged { violation: missed });
        }
        // The arcs that are delivered, in units of the task.
        let unit = self.task.time.powi(3) / self.task.length;
        let scaled = |arc: &Arc| Arc { jerk: arc.jerk * unit, duration: arc.duration / self.task.time };
        let arcs: Vec<Arc> = self.arcs().iter().map(scaled).collect();
        let violation = if banded && !band::is_certified(&self.task, &arcs) {
            band::worst(&self.task, &arcs)
        } else {
            self.violation(&self.profile)
        };
        if violation > 0.0 { Err(VibrationFreeError::NotConverged { violation }) } else { Ok(self) }
    }

    /// By how much the way there misses the end, which the profile then meets exactly.
    fn missed(&self) -> f64 {
        let end = self.motion.states().last().unwrap_or_default();
        let way = self.goal.distance.map_or(0.0, |distance| end.position - distance);
        let velocity = end.velocity - self.goal.velocity;
        let Task { time, length, .. } = &self.task;
        [end.acceleration * time * time, velocity * time, way]
            .iter()
            .map(|x| (x / length).abs())
            .fold(0.0, f64::max)
    }

    /// What is left of the derivatives of double zeros, as a part of the motion.
    fn slopes(&self) -> f64 {
        let double = self.task.zeros.iter().filter(|zero| zero.is_double());
        let left = double.map(|zero| {
            let zero = Zero::at(zero.pole() / self.task.time, true);
            let [_, slope] =
                self.arcs().iter().fold(Default::default(), |response, arc| zero.after(response, arc));
            slope.norm() / (zero.pole().norm() * zero.pole().im * self.task.length.abs())
        });
        left.fold(0.0, f64::max)
    }

    /// Whether a profile for the same end is all that was asked; of bands it says nothing.
    pub(super) fn holds<P: Profile>(&self, profile: &P) -> bool {
        self.violation(profile) <= 0.0
    }

    /// By how much a profile passes limits, or leaves more of the modes than it may.
    fn violation<P: Profile>(&self, profile: &P) -> f64 {
        let mut violation = 0.0_f64;
        let mut take =
            |value: f64| violation = if value.is_nan() { f64::INFINITY } else { violation.max(value) };
        match self.robustness {
            Robustness::Band { .. } => {}
            Robustness::None | Robustness::DoubleZero => {
                self.modes.iter().for_each(|mode| {
                    take(residual_vibration(profile, *mode) / self.size(mode) - EXACT);
                });
            }
        }
        let Extrema { velocity, acceleration, jerk, .. } = profile.extrema();
        let limits = [self.limits.velocity(), self.limits.acceleration(), self.limits.jerk()];
        for (range, bounds) in [velocity, acceleration, jerk].into_iter().zip(limits) {
            take(range.upper / bounds.upper - 1.0 - ROUNDING);
            take(range.lower / bounds.lower - 1.0 - ROUNDING);
        }
        violation
    }

    /// What a residual is set against: the distance, or the change of velocity over the frequency.
    fn size(&self, mode: &Mode) -> f64 {
        match self.request {
            Request::Move { distance } => distance.abs().max(f64::MIN_POSITIVE),
            Request::Ramp { from, to } => {
                ((to - from).abs() / mode.angular_frequency()).max(f64::MIN_POSITIVE)
            }
        }
    }

    pub(super) fn profile(&self) -> &Piecewise<MOST_ARCS> {
        &self.profile
    }

    pub(super) fn task(&self) -> &Task {
        &self.task
    }

    /// Instants at which the jerk jumps or the velocity turns, s.
    pub(super) fn instants(&self) -> Vec<f64> {
        let arcs = self.motion.states().zip(self.motion.arcs());
        let turns = arcs.filter_map(|(state, arc)| {
            let turn = -state.acceleration / arc.jerk;
            (turn > 0.0 && turn < arc.duration).then_some(state.time + turn)
        });
        self.motion.states().map(|state| state.time).chain(turns).collect()
    }

    pub(super) fn request(&self) -> Request {
        self.request
    }

    /// The sections of the motion.
    #[must_use]
    pub fn as_piecewise(&self) -> &Piecewise<MOST_ARCS> {
        &self.profile
    }

    /// The stretches of constant jerk.
    #[must_use]
    pub fn arcs(&self) -> &[Arc] {
        self.motion.arcs()
    }

    /// Where the motion meets limits.
    #[must_use]
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Where it ends.
    #[must_use]
    pub fn goal(&self) -> Goal {
        self.goal
    }

    /// Instants at which the jerk jumps, the start and the end among them; the S-curve with every limit met has eight.
    #[must_use]
    pub fn switches(&self) -> usize {
        self.motion.switches()
    }

    /// What the motion takes longer than the S-curve within the same limits, s.
    #[must_use]
    pub fn price(&self) -> f64 {
        self.profile.duration() - self.s_curve
    }

    /// Whether the switching function proves that there is no shorter motion; where it does not, this is the shortest that
    /// was found.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        self.found.is_proven()
    }
}

/// The shortest motion by a grid or by two ramps: these first where a grid would have few cells for a period.
fn shortest(
    task: &Task,
    request: Request,
    limits: &Limits,
    modes: &[Mode],
    robustness: Robustness,
) -> Result<Found, VibrationFreeError> {
    let joined = || joined(task, request, limits, modes, robustness);
    let early = if task.fastest() > MANY { joined() } else { None };
    if let Some(found) = early.as_ref().filter(|found| found.is_proven()) {
        return Ok(found.clone());
    }
    let searched = searched(task);
    if searched.as_ref().is_ok_and(Found::is_proven) {
        return searched;
    }
    let late = if task.fastest() > MANY { early } else { joined() };
    match (searched, late) {
        (Ok(found), late) => Ok(late.into_iter().fold(found, |best, found| shorter(Some(best), found))),
        (Err(_), Some(found)) => Ok(found),
        (Err(error), None) => Err(error),
    }
}

/// The S-curve, where it is free of vibration by itself.
fn free_already(task: &Task) -> Option<Found> {
    let structure = Structure::of(task, &task.plain, S_CURVE)?;
    let motion = Motion::new(task.from, &structure.arcs)?;
    let mut left = 0.0_f64;
    for zero in &task.zeros {
        let response =
            motion.arcs().iter().fold(Default::default(), |response, arc| zero.after(response, arc));
        let amplitude = zero.pole().norm() * zero.pole().im;
        left = response.iter().map(|part| part.norm() / amplitude).fold(left, f64::max);
    }
    let free = left <= 0.1 * EXACT && band::is_kept(task, motion.arcs());
    free.then(|| Found { structure, motion, multipliers: Some(vec![]) })
}

super::answers_as_its_profile!(VibrationFreeMove);
