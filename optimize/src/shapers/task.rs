//! What is asked of a train, without units.

use profiles::{Complex, Interval};
use shaping::ModeRange;

use super::conditions::Group;
use super::error::ShortestTrainError;
use super::{MOST_ORDER, MOST_RATIO, MOST_REQUIREMENTS, Requirement};

/// A pole at which a range must be kept, and the number of the range.
pub(super) type Place = (Complex<f64>, usize);

/// At most a tolerance over a range, which is sampled.
#[derive(Debug, Clone, Copy)]
pub(super) struct Band {
    pub(super) range: ModeRange,
    pub(super) tolerance: f64,
    /// What is aimed for: less by what a certificate cannot tell.
    pub(super) aim: f64,
}

/// All that is asked, with the lowest frequency as the unit.
#[derive(Debug, Clone)]
pub(super) struct Task {
    /// Poles of which nothing may be left, each as often as the order of its zero, and the conditions for that.
    zeros: Vec<Complex<f64>>,
    groups: Vec<Group>,
    pub(super) bands: Vec<Band>,
    /// The sum of magnitudes that is aimed for, and the largest there may be.
    pub(super) demand: f64,
    pub(super) most_demand: f64,
    /// Time of one rad of the slowest mode, s.
    pub(super) unit: f64,
}

/// A train in units of the task: times from zero on, and amplitudes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Train {
    pub(super) times: Vec<f64>,
    pub(super) amplitudes: Vec<f64>,
}

impl Train {
    pub(super) fn duration(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Sum of the magnitudes.
    pub(super) fn demand(&self) -> f64 {
        self.amplitudes.iter().map(|a| a.abs()).sum()
    }

    /// `sum of A e^(p (T - t))`.
    pub(super) fn response(&self, p: Complex<f64>) -> Complex<f64> {
        let end = self.duration();
        self.times.iter().zip(&self.amplitudes).map(|(t, a)| (p * (end - t)).exp() * *a).sum()
    }
}

/// What an impulse of one adds to everything that is asked when `tau` is left after it, and the derivative of that by `tau`.
#[derive(Debug, Clone, Default)]
pub(super) struct Weights {
    pub(super) values: Vec<Complex<f64>>,
    pub(super) slopes: Vec<Complex<f64>>,
}

impl Task {
    pub(super) fn new(requirements: &[Requirement], demand: f64) -> Result<Self, ShortestTrainError> {
        let count = requirements.len();
        if count == 0 {
            return Err(ShortestTrainError::NoRequirement);
        }
        if count > MOST_REQUIREMENTS {
            return Err(ShortestTrainError::Requirements { requirements: count, most: MOST_REQUIREMENTS });
        }
        if !(demand >= 1.0 && demand.is_finite()) {
            return Err(ShortestTrainError::Demand(demand));
        }
        let frequencies = requirements.iter().map(|requirement| match requirement {
            Requirement::Zero { mode, .. } => (mode.angular_frequency(), mode.angular_frequency()),
            Requirement::Within { range, .. } => {
                let Interval { lower, upper } = range.angular_frequency();
                (lower, upper)
            }
        });
        let lowest = frequencies.clone().map(|(lower, _)| lower).fold(f64::INFINITY, f64::min);
        let highest = frequencies.map(|(_, upper)| upper).fold(0.0, f64::max);
        let ratio = highest / lowest;
        if ratio > MOST_RATIO {
            return Err(ShortestTrainError::Spread { ratio, most: MOST_RATIO });
        }
        let mut task = Self {
            zeros: vec![],
            groups: vec![],
            bands: vec![],
            demand,
            most_demand: demand,
            unit: 1.0 / lowest,
        };
        for requirement in requirements {
            match *requirement {
                Requirement::Zero { order, .. } if !(1..=MOST_ORDER).contains(&order) => {
                    return Err(ShortestTrainError::Order { order, most: MOST_ORDER });
                }
                Requirement::Zero { mode, order } => {
                    task.zeros.extend(std::iter::repeat_n(mode.pole() / lowest, order));
                }
                Requirement::Within { tolerance, .. } if !(1e-6..1.0).contains(&tolerance) => {
                    return Err(ShortestTrainError::Tolerance(tolerance));
                }
                Requirement::Within { range, tolerance } => {
                    let w = range.angular_frequency();
                    let scaled = Interval::new(w.lower / lowest, w.upper / lowest);
                    // Scaling by a division leaves every range one.
                    let range = ModeRange::new(scaled, range.damping_ratio())
                        .map_err(|_| ShortestTrainError::Spread { ratio, most: MOST_RATIO })?;
                    let aim = tolerance - 4.0 * super::GAP;
                    task.bands.push(Band { range, tolerance, aim });
                }
            }
        }
        task.groups = Group::of(task.zeros.clone());
        Ok(task)
    }

    /// The same with a part of every tolerance.
    pub(super) fn harder(&self, part: f64) -> Self {
        let mut harder = self.clone();
        harder.bands.iter_mut().for_each(|band| band.aim *= part);
        harder
    }

    /// A train of half a period for every zero, one after the other.
    pub(super) fn one_by_one(&self) -> Train {
        let mut train = Train { times: vec![0.0], amplitudes: vec![1.0] };
        for zero in &self.zeros {
            let delay = std::f64::consts::PI / zero.im;
            let decay = (zero.re * delay).exp();
            let mut both: Vec<(f64, f64)> = train.times.iter().copied().zip(train.amplitudes).collect();
            let late: Vec<_> = both.iter().map(|(t, a)| (t + delay, a * decay / (1.0 + decay))).collect();
            both.iter_mut().for_each(|(_, a)| *a /= 1.0 + decay);
            both.extend(late);
            both.sort_by(|a, b| a.0.total_cmp(&b.0));
            (train.times, train.amplitudes) = both.into_iter().unzip();
        }
        train
    }

    /// Number of conditions for the zeros.
    pub(super) fn zeros(&self) -> usize {
        self.zeros.len()
    }

    /// What an impulse of one adds to the conditions of the zeros and to the responses at `places`.
    pub(super) fn weights(&self, tau: f64, places: &[Place]) -> Weights {
        let mut weights = Weights::default();
        for group in &self.groups {
            group.append(tau, &mut weights.values, &mut weights.slopes);
        }
        for (p, _) in places {
            let value = (p * tau).exp();
            weights.values.push(value);
            weights.slopes.push(p * value);
        }
        weights
    }

    /// What each of those may be at most: nothing for a zero, the aim of its range for a place.
    pub(super) fn bounds(&self, places: &[Place]) -> Vec<f64> {
        let aims = places.iter().map(|(_, number)| self.bands.get(*number).map_or(0.0, |band| band.aim));
        std::iter::repeat_n(0.0, self.zeros.len()).chain(aims).collect()
    }

    /// The sums over a train of what its impulses add.
    pub(super) fn sums(&self, train: &Train, places: &[Place]) -> Vec<Complex<f64>> {
        let mut sums = vec![Complex::default(); self.zeros.len() + places.len()];
        for (t, a) in train.times.iter().zip(&train.amplitudes) {
            let weights = self.weights(train.duration() - t, places);
            sums.iter_mut().zip(weights.values).for_each(|(sum, value)| *sum += value * *a);
        }
        sums
    }

    /// Places of all ranges along lines of equal damping, dense enough for a train of this duration: `density` a turn of
    /// its last impulse.
    pub(super) fn samples(&self, duration: f64, density: f64) -> Vec<Vec<Place>> {
        let lines = self.bands.iter().enumerate().flat_map(|(number, band)| {
            let (w, z) = (band.range.angular_frequency(), band.range.damping_ratio());
            let middle = 0.5 * (z.lower + z.upper);
            let dampings = if z.lower < z.upper { vec![z.lower, middle, z.upper] } else { vec![z.lower] };
            let turns = (w.upper - w.lower) * duration / std::f64::consts::TAU;
            let count = if w.lower < w.upper { (density * turns).ceil().max(8.0) as u32 } else { 0 };
            dampings.into_iter().map(move |z| {
                let at = |k: u32| {
                    let part = if count > 0 { f64::from(k) / f64::from(count) } else { 0.0 };
                    let w = w.lower + (w.upper - w.lower) * part;
                    let outward = Complex::new(-z, ((1.0 - z) * (1.0 + z)).sqrt());
                    (outward * w, number)
                };
                (0..=count).map(at).collect()
            })
        });
        lines.collect()
    }

    /// The most that a train is off what is asked: conditions of the zeros, and beyond the aim at places.
    pub(super) fn violation(&self, train: &Train, places: &[Place]) -> f64 {
        let sum: f64 = train.amplitudes.iter().sum();
        let sums = self.sums(train, places);
        let beyond = sums.iter().zip(self.bounds(places)).map(|(sum, bound)| sum.norm() - bound);
        beyond.fold((sum - 1.0).abs(), f64::max)
    }
}
