//! Motions whose jerk changes on the ticks of a clock only.

use profiles::switched::{Arc, Switched};
use profiles::{Piecewise, Profile};

use super::MOST_ARCS;
use super::band;
use super::error::VibrationFreeError;
use super::motion::VibrationFreeMove;
use super::runs::Runs;

/// Runs of a motion on a clock: the arcs, and a tick about each switch.
const MOST_RUNS: usize = 2 * MOST_ARCS;
/// Ticks of their own on both sides of the tick in which a switch lies, tried one after the other.
const MARGINS: [u64; 2] = [0, 1];
/// Ticks more than the motion needs, tried one after the other.
const EXTRA: [u64; 8] = [0, 1, 2, 3, 5, 8, 13, 21];
/// The most ticks there may be.
const MOST_TICKS: f64 = 1e9;
/// Instants closer to a tick than this, in ticks, are on it.
const ON_TICK: f64 = 1e-9;

/// A vibration-free motion that a sampled controller runs exactly: its jerk is constant from tick to tick.
///
/// The switches of the optimum lie between ticks. Here each is replaced by one tick with a jerk of its own, the motion is
/// given so many ticks, and the jerk of all runs follows from a linear programme: the smallest part of the limit of the jerk
/// with which end, limits and zeros hold.
#[derive(Debug, Clone)]
pub struct ClockedMove {
    profile: Piecewise<MOST_RUNS>,
    ticks: u64,
    period: f64,
}

impl ClockedMove {
    /// Duration in ticks.
    #[must_use]
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Time between ticks, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The sections of the motion, each of whole ticks.
    #[must_use]
    pub fn as_piecewise(&self) -> &Piecewise<MOST_RUNS> {
        &self.profile
    }
}

impl VibrationFreeMove {
    /// The motion with its switches on the ticks of a clock of `period` s, in the fewest ticks that are found.
    ///
    /// # Errors
    /// A period that is not positive and finite, or so long or short that there is no such motion.
    pub fn on_clock(&self, period: f64) -> Result<ClockedMove, VibrationFreeError> {
        let needed = self.profile().duration() / period;
        if !(period > 0.0 && period.is_finite() && needed <= MOST_TICKS) {
            return Err(VibrationFreeError::Period(period));
        }
        let fewest = (needed - ON_TICK).ceil().max(0.0) as u64;
        for ticks in EXTRA.map(|extra| fewest + extra) {
            for margin in MARGINS {
                let clocked = Clocked::of(self, period, ticks, margin);
                if let Some(profile) = clocked.and_then(|clocked| clocked.profile()) {
                    return Ok(ClockedMove { profile, ticks, period });
                }
            }
        }
        Err(VibrationFreeError::Period(period))
    }
}

/// The runs of a motion on a clock while their jerk is sought.
struct Clocked<'a> {
    planned: &'a VibrationFreeMove,
    /// Ticks of each run.
    runs: Vec<u64>,
    /// Time between ticks, s.
    period: f64,
}

impl<'a> Clocked<'a> {
    /// With so many ticks of their own on both sides of each switch; none where there are more runs than fit.
    fn of(planned: &'a VibrationFreeMove, period: f64, ticks: u64, margin: u64) -> Option<Self> {
        let stretch = ticks as f64 / planned.profile().duration();
        let mut marks = vec![0, ticks];
        for instant in planned.instants() {
            let instant = instant * stretch;
            let near = instant.round();
            let on_tick = margin == 0 && (instant - near).abs() <= ON_TICK;
            let (first, last) = if on_tick { (near, near) } else { (instant.floor(), instant.ceil()) };
            marks.extend((first as u64).saturating_sub(margin)..=(last as u64).saturating_add(margin));
        }
        marks.sort_unstable();
        marks.dedup();
        marks.retain(|mark| *mark <= ticks);
        let runs: Vec<u64> = marks.windows(2).map(|pair| pair[1] - pair[0]).collect();
        (runs.len() <= MOST_RUNS).then_some(Self { planned, runs, period })
    }

    /// The motion, if there is one in these ticks.
    fn profile(&self) -> Option<Piecewise<MOST_RUNS>> {
        let task = self.planned.task();
        let lengths: Vec<f64> =
            self.runs.iter().map(|ticks| *ticks as f64 * (self.period / task.time)).collect();
        let unit = task.length / task.time.powi(3);
        let arcs = Runs::kept(task, lengths)?;
        if !band::is_certified(task, &arcs) {
            return None;
        }
        let arcs: Vec<Arc> = arcs
            .iter()
            .zip(&self.runs)
            .map(|(arc, ticks)| Arc { jerk: arc.jerk * unit, duration: *ticks as f64 * self.period })
            .collect();
        let from = self.planned.request().from();
        let motion = Switched::<MOST_RUNS>::new(from, &arcs)?;
        let profile = motion.profile(&self.planned.goal(), &[]);
        self.planned.holds(&profile).then_some(profile)
    }
}

super::answers_as_its_profile!(ClockedMove);
