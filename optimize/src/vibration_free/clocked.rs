//! Motions whose jerk changes on the ticks of a clock only.

use nalgebra::{DMatrix, DVector};
use profiles::switched::{Arc, Goal, SwitchState, Switched, Zero};
use profiles::{Complex, Extrema, Interval, Piecewise, Profile, Sample, Section, Sectioned};

use super::error::VibrationFreeError;
use super::motion::VibrationFreeMove;
use super::task::{Place, Task};
use super::{MOST_ARCS, Request};
use crate::programme::{Affine, Programme};

/// Runs of a motion on a clock: the arcs, and a tick about each switch.
const MOST_RUNS: usize = 2 * MOST_ARCS;
/// Ticks of their own on both sides of the tick in which a switch lies, tried one after the other.
const MARGINS: [u64; 3] = [0, 1, 3];
/// Ticks more than the motion needs, at most.
const MOST_EXTRA: usize = 24;
/// The most ticks there may be.
const MOST_TICKS: f64 = 1e9;
/// Room left in limits for the last correction, as a part of them.
const ROOM: f64 = 1e-8;
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
    /// The motion with its switches on the ticks of a clock of `period` s, in as few ticks as that takes.
    ///
    /// # Errors
    /// A period that is not positive and finite, or so long or short that there is no such motion.
    pub fn on_clock(&self, period: f64) -> Result<ClockedMove, VibrationFreeError> {
        let needed = self.profile().duration() / period;
        if !(period > 0.0 && period.is_finite() && needed <= MOST_TICKS) {
            return Err(VibrationFreeError::Period(period));
        }
        let fewest = (needed - ON_TICK).ceil().max(0.0) as u64;
        for ticks in fewest..=fewest + MOST_EXTRA as u64 {
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

/// A motion on a clock while its jerk is sought, in units of the task.
struct Clocked<'a> {
    planned: &'a VibrationFreeMove,
    task: &'a Task,
    /// Ticks of each run.
    runs: Vec<u64>,
    /// Time between ticks.
    tick: f64,
    /// s.
    period: f64,
}

/// Conditions on the jerk of the runs: `rows . jerk = right`.
struct Ends {
    rows: DMatrix<f64>,
    right: DVector<f64>,
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
        let task = planned.task();
        (runs.len() <= MOST_RUNS).then_some(Self { planned, task, runs, tick: period / task.time, period })
    }

    /// The motion, if there is one in these ticks.
    fn profile(&self) -> Option<Piecewise<MOST_RUNS>> {
        let jerk = self.exact(self.programme()?)?;
        let unit = self.task.length / self.task.time.powi(3);
        let arcs: Vec<Arc> = jerk
            .iter()
            .zip(&self.runs)
            .map(|(jerk, ticks)| Arc { jerk: jerk * unit, duration: *ticks as f64 * self.period })
            .collect();
        let from = match self.planned.request() {
            Request::Move { .. } => 0.0,
            Request::Ramp { from, .. } => from,
        };
        let motion = Switched::<MOST_RUNS>::new(from, &arcs)?;
        let profile = motion.profile(&self.planned.goal(), &[]);
        self.planned.holds(&profile).then_some(profile)
    }

    fn lengths(&self) -> impl Iterator<Item = f64> {
        self.runs.iter().map(|ticks| *ticks as f64 * self.tick)
    }

    fn duration(&self) -> f64 {
        self.lengths().sum()
    }

    /// For each run its length and the time after it.
    fn places(&self) -> Vec<(f64, f64)> {
        let mut rest = self.duration();
        let lengths = self.lengths();
        lengths
            .map(|length| {
                rest = (rest - length).max(0.0);
                (length, rest)
            })
            .collect()
    }

    /// What a jerk of one in each run leaves of a pole at the end, real and imaginary part, and of its derivative.
    fn responses(&self, zero: &Zero) -> Vec<[f64; 4]> {
        let places = self.places();
        let left = places.iter().map(|(length, rest)| {
            let pushed = zero.after(Default::default(), &Arc { jerk: 1.0, duration: *length });
            let [q, r] = zero.after(pushed, &Arc { jerk: 0.0, duration: *rest });
            [q.re, q.im, r.re, r.im]
        });
        left.collect()
    }

    /// What must hold exactly: the end and the zeros.
    fn ends(&self) -> Ends {
        let at_rest = SwitchState::default();
        let pushed: Vec<SwitchState> = self
            .places()
            .iter()
            .map(|(length, rest)| at_rest.advanced(1.0, *length).advanced(0.0, *rest))
            .collect();
        let Goal { velocity, distance } = self.task.goal;
        let mut rows: Vec<(Vec<f64>, f64)> = vec![
            (pushed.iter().map(|state| state.acceleration).collect(), 0.0),
            (pushed.iter().map(|state| state.velocity).collect(), velocity - self.task.from),
        ];
        if let Some(distance) = distance {
            let way = self.task.from * self.duration();
            rows.push((pushed.iter().map(|state| state.position).collect(), distance - way));
        }
        for zero in &self.task.zeros {
            let responses = self.responses(zero);
            rows.extend((0..zero.conditions()).map(|k| (responses.iter().map(|r| r[k]).collect(), 0.0)));
        }
        // Each with a largest coefficient of one.
        let largest =
            |row: &[f64]| row.iter().fold(f64::MIN_POSITIVE, |largest: f64, c| largest.max(c.abs()));
        rows.iter_mut().for_each(|(row, right)| {
            let unit = largest(row);
            row.iter_mut().for_each(|c| *c /= unit);
            *right /= unit;
        });
        Ends {
            rows: DMatrix::from_fn(rows.len(), self.runs.len(), |i, k| rows[i].0[k]),
            right: DVector::from_iterator(rows.len(), rows.iter().map(|(_, right)| *right)),
        }
    }

    /// The jerk of the runs with the smallest part of its limits, if that is no more than all of them.
    fn programme(&self) -> Option<Vec<f64>> {
        let n = self.runs.len();
        let unit = self.task.full_jerk();
        let mut cost = vec![0.0; n + 1];
        cost[n] = 1.0;
        let mut programme = Programme::new(cost);
        let Ends { rows, right } = self.ends();
        for (row, right) in rows.row_iter().zip(right.iter()) {
            let terms = row.iter().map(|c| c * unit).enumerate().collect();
            programme.zero(Affine { terms, constant: -right });
        }
        for Place { pole, tolerated } in &self.task.places {
            let responses = self.responses(&Zero::at(*pole, false));
            let part = |k: usize| Affine {
                terms: responses.iter().map(|r| r[k] * unit / tolerated).enumerate().collect(),
                constant: 0.0,
            };
            programme.cone(Affine { terms: vec![], constant: 1.0 - 1e-4 }, part(0), part(1));
        }
        for k in 0..n {
            for (sign, limit) in [(1.0, self.task.jerk.upper), (-1.0, -self.task.jerk.lower)] {
                programme.positive(Affine { terms: vec![(k, -sign), (n, limit / unit)], constant: 0.0 });
            }
        }
        let mut within = |terms: Vec<(usize, f64)>, start: f64, bounds: Interval| {
            for (sign, bound) in [(-1.0, bounds.upper), (1.0, bounds.lower)] {
                if bound.is_finite() {
                    let terms = terms.iter().map(|(k, c)| (*k, sign * c / bound.abs())).collect();
                    let constant = sign * (start - bound) / bound.abs() - ROOM;
                    programme.positive(Affine { terms, constant });
                }
            }
        };
        let lengths: Vec<f64> = self.lengths().collect();
        for end in 1..n {
            // Acceleration and velocity at the start of a run, and the middle Bernstein coefficient of its velocity.
            let mut rest: f64 = lengths[..end].iter().sum();
            let (mut steep, mut fast, mut middle) = (vec![], vec![], vec![]);
            for (k, length) in lengths[..end].iter().enumerate() {
                rest -= length;
                let (a, v) = (length * unit, length * (rest.max(0.0) + 0.5 * length) * unit);
                steep.push((k, a));
                fast.push((k, v));
                middle.push((k, v + 0.5 * a * lengths[end]));
            }
            within(steep, 0.0, self.task.acceleration);
            within(fast, self.task.from, self.task.velocity);
            within(middle, self.task.from, self.task.velocity);
        }
        let (x, part) = programme.solved_to(1e-10)?;
        (part <= 1.0 - ROOM).then(|| x.iter().take(n).map(|jerk| jerk * unit).collect())
    }

    /// The jerk nearest to a solution of the programme with which end and zeros hold to rounding.
    fn exact(&self, jerk: Vec<f64>) -> Option<Vec<f64>> {
        let Ends { rows, right } = self.ends();
        let mut jerk = DVector::from_vec(jerk);
        let svd = rows.clone().try_svd(true, true, f64::EPSILON, 1000)?;
        for _ in 0..3 {
            let missed = &rows * &jerk - &right;
            jerk -= svd.solve(&missed, 1e-12).ok()?;
        }
        Some(jerk.iter().copied().collect())
    }
}

impl Profile for ClockedMove {
    fn duration(&self) -> f64 {
        self.profile.duration()
    }
    fn sample(&self, t: f64) -> Sample {
        self.profile.sample(t)
    }
    fn extrema(&self) -> Extrema {
        self.profile.extrema()
    }
    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        self.profile.response(p)
    }
}

impl Sectioned for ClockedMove {
    const HARMONIC: bool = false;

    fn section(&self, index: usize) -> Option<Section> {
        self.profile.section(index)
    }
    fn section_at(&self, t: f64) -> Option<Section> {
        self.profile.section_at(t)
    }
    fn before(&self) -> Sample {
        self.profile.before()
    }
    fn after(&self) -> Sample {
        self.profile.after()
    }
}
