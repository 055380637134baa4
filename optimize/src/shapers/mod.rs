//! The shortest trains for what is asked of several modes, and of ranges of them.

mod conditions;
mod error;
mod grid;
mod polish;
mod task;

pub use error::ShortestTrainError;

use profiles::Mode;
use shaping::{Impulse, ImpulseTrain, ModeRange, WorstCase};
use task::{Place, Task, Train};

/// Requirements that are dealt with at a time.
const MOST_REQUIREMENTS: usize = 8;
/// The highest order of a zero.
const MOST_ORDER: usize = 3;
/// The highest frequency over the lowest.
const MOST_RATIO: f64 = 100.0;
/// What a certificate may lie above what is attained.
const GAP: f64 = 1e-9;
/// What a zero may leave, as a part of what a step leaves.
const EXACT: f64 = 1e-12;
/// Impulses closer than this, in rad of the slowest mode, are one.
const CLOSE: f64 = 1e-5;
/// Impulses of a train while it is searched for.
const MOST_IMPULSES: usize = 64;
/// A violation that no further round takes away.
const HOPELESS: f64 = 1e-4;
/// Rounds of looking for worse modes.
const ROUNDS: usize = 20;

/// One thing that a train must do.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Requirement {
    /// Leave nothing of a mode.
    Zero {
        /// The mode.
        mode: Mode,
        /// Order of the zero: 1 for no vibration, 2 for no derivative of it either; at most 3.
        order: usize,
    },
    /// Leave no more than `tolerance` of any mode of a range (specified insensitivity).
    Within {
        /// The modes.
        range: ModeRange,
        /// What may be left, as a part of what a step leaves.
        tolerance: f64,
    },
}

/// A train that does what was asked.
#[derive(Debug, Clone, PartialEq)]
pub struct ShortestTrain<const N: usize> {
    /// The train.
    pub train: ImpulseTrain<N>,
    /// The worst of every range, in the order of the requirements, each with a bound that is certified not to exceed what
    /// is tolerated.
    pub worst_cases: Vec<WorstCase>,
}

/// The shortest train with impulses whose magnitudes add up to at most `demand` (1 for positive impulses only) that does
/// all that is asked.
///
/// Convolving a shaper for each mode takes the sum of their times; one train for all of them is shorter. Its structure
/// comes from a second-order cone programme over amplitudes on a grid of times, as short as that is feasible. Times and
/// amplitudes then follow from a sequence of such programmes that make it shorter still; the zeros are solved to rounding,
/// and what is tolerated is certified over the whole of each range by [`ImpulseTrain::worst_case`], not at samples:
/// the worst mode that it finds is asked for in the next round.
///
/// ```
/// use optimize::shapers::{Requirement, shortest_train};
/// use profiles::Mode;
///
/// // Two modes: 37.5 ms by one train, where a ZV shaper for each would take 41.7 ms
/// let modes = [Mode::from_hz(20.0, 0.02)?, Mode::from_hz(30.0, 0.02)?];
/// let zeros = modes.map(|mode| Requirement::Zero { mode, order: 1 });
/// let joint = shortest_train::<4>(&zeros, 1.0)?.train;
/// assert!(modes.iter().all(|mode| joint.residual(*mode) < 1e-14));
/// let one_by_one: f64 = modes.iter().map(|mode| 0.5 * mode.damped_period()).sum();
/// assert!(joint.duration() < one_by_one);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Requirements that cannot be, frequencies more than a factor of 100 apart, nothing short enough that does it, or a train
/// of more than `N` impulses.
///
/// # References
/// W. E. Singhose, W. P. Seering, N. C. Singer, Input shaping for vibration reduction with specified insensitivity to
/// modeling errors, Japan-USA Symposium on Flexible Automation (1996) 307-313.
pub fn shortest_train<const N: usize>(
    requirements: &[Requirement],
    demand: f64,
) -> Result<ShortestTrain<N>, ShortestTrainError> {
    let task = Task::new(requirements, demand)?;
    let mut failure = ShortestTrainError::NotConverged { violation: f64::INFINITY };
    for start in STARTS {
        let start = match start {
            Start::Grid { harder, visible } => grid::structure(&task.harder(harder), visible)?,
            Start::OneByOne => task.one_by_one(),
        };
        match searched(task.clone(), start) {
            Ok(train) => return finished(&train, task.unit, requirements),
            Err(error) => failure = error,
        }
    }
    Err(failure)
}

/// Where a search may start.
#[derive(Debug, Clone, Copy)]
enum Start {
    /// From a grid, with a part of every tolerance and amplitudes down to a part of the largest: where a structure only
    /// just does what is asked, that of a harder task has an impulse more.
    Grid { harder: f64, visible: f64 },
    /// From a train for each zero, one after the other.
    OneByOne,
}

/// Starts, one after the other until one leads to a train.
const STARTS: [Start; 5] = [
    Start::Grid { harder: 1.0, visible: 1e-3 },
    Start::Grid { harder: 0.98, visible: 1e-3 },
    Start::Grid { harder: 0.9, visible: 1e-3 },
    Start::Grid { harder: 1.0, visible: 1e-5 },
    Start::OneByOne,
];

/// The shortest train of one structure, with a certificate for every range.
fn searched(mut task: Task, start: Train) -> Result<Train, ShortestTrainError> {
    let mut train = start;
    let mut places = Vec::new();
    for _ in 0..ROUNDS {
        for line in task.samples(train.duration(), 48.0) {
            add(&mut places, worst_of(&line, &train));
        }
        train = tidied(&polish::shortened(&task, &train, &places));
        train = polish::with_exact_zeros(&task, &train);
        let violation = task.violation(&train, &places);
        if violation > HOPELESS {
            return Err(ShortestTrainError::NotConverged { violation });
        }
        let worse = worse_modes(&mut task, &train)?;
        // What the zeros took to be exact may have been lent by the demand.
        let beyond = train.demand() - task.most_demand;
        if worse.is_empty() && task.violation(&train, &[]) <= EXACT && beyond <= EXACT {
            return Ok(train);
        }
        task.demand = (task.demand - 2.0 * beyond.max(0.0)).max(1.0);
        add(&mut places, worse);
    }
    Err(ShortestTrainError::NotConverged { violation: task.violation(&train, &places) })
}

/// Adds places that are not there yet.
fn add(places: &mut Vec<Place>, more: Vec<Place>) {
    for (p, number) in more {
        let near = |(q, other): &Place| *other == number && (p - q).norm() < CLOSE;
        if !places.iter().any(near) {
            places.push((p, number));
        }
    }
}

/// The local maxima along one line of samples, its ends included.
fn worst_of(line: &[Place], train: &Train) -> Vec<Place> {
    let left: Vec<f64> = line.iter().map(|(p, _)| train.response(*p).norm()).collect();
    let at = |k: Option<usize>| k.and_then(|k| left.get(k)).copied().unwrap_or(0.0);
    let peaks =
        (0..line.len()).filter(|k| at(Some(*k)) >= at(k.checked_sub(1)) && at(Some(*k)) >= at(Some(k + 1)));
    peaks.map(|k| line[k]).collect()
}

/// Impulses that have met become one, and those of no size go.
fn tidied(train: &Train) -> Train {
    let mut tidy = Train { times: vec![], amplitudes: vec![] };
    for (t, a) in train.times.iter().zip(&train.amplitudes) {
        match (tidy.times.last(), tidy.amplitudes.last_mut()) {
            (Some(before), Some(amplitude)) if t - before < CLOSE && *amplitude * a >= 0.0 => *amplitude += a,
            _ if a.abs() < CLOSE => {}
            _ => {
                tidy.times.push(*t);
                tidy.amplitudes.push(*a);
            }
        }
    }
    let first = tidy.times.first().copied().unwrap_or(0.0);
    tidy.times.iter_mut().for_each(|t| *t -= first);
    tidy
}

/// The train with `unit` s for its unit of time.
fn with_units<const N: usize>(train: &Train, unit: f64) -> Result<ImpulseTrain<N>, ShortestTrainError> {
    let impulses = train.times.iter().zip(&train.amplitudes).map(|(t, a)| Impulse::new(t * unit, *a));
    Ok(ImpulseTrain::new(&impulses.collect::<Vec<_>>())?)
}

/// The modes of every range that may be left with more than is tolerated. Where that is less than the search can tell,
/// it aims for that much less.
fn worse_modes(task: &mut Task, train: &Train) -> Result<Vec<Place>, ShortestTrainError> {
    let train = with_units::<MOST_IMPULSES>(train, 1.0)?;
    let mut worse = vec![];
    for (number, band) in task.bands.iter_mut().enumerate() {
        let worst = train.worst_case(&band.range);
        let beyond = worst.bound - band.tolerance;
        if beyond > 0.0 {
            worse.push((worst.mode.pole(), number));
            if beyond < 1e-5 * band.tolerance {
                band.aim -= beyond + 2e-6 * band.tolerance;
            }
        }
    }
    Ok(worse)
}

fn finished<const N: usize>(
    train: &Train,
    unit: f64,
    requirements: &[Requirement],
) -> Result<ShortestTrain<N>, ShortestTrainError> {
    let train = with_units(train, unit)?;
    let ranges = requirements.iter().filter_map(|requirement| match requirement {
        Requirement::Within { range, .. } => Some(range),
        Requirement::Zero { .. } => None,
    });
    let worst_cases = ranges.map(|range| train.worst_case(range)).collect();
    Ok(ShortestTrain { train, worst_cases })
}
