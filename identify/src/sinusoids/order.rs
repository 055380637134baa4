//! How many poles: a start from the pencil, then poles added and dropped while the information criterion falls.

use super::basis::{Pole, order, residual};
use super::fit::Fit;
use super::pencil::starts;

/// Iterations that show whether another model is better: from a start nearby the first few gain nearly all.
const TRIAL: usize = 8;

/// The data and what is fixed of the model.
pub(super) struct Problem<'a> {
    pub(super) y: &'a [f64],
    pub(super) offset: bool,
    pub(super) largest_order: usize,
    /// Sum of squares that rounding alone may leave.
    pub(super) floor: f64,
}

impl Problem<'_> {
    /// The fit with the lowest criterion that the search meets.
    pub(super) fn search(&self) -> Option<Fit> {
        const ROUNDS: usize = 8;
        const TO_THE_END: usize = 60;
        let empty = self.linear(Vec::new())?;
        let starts: Vec<Fit> = starts(self.y, self.largest_order)
            .into_iter()
            .filter_map(|poles| self.linear(self.without_constant(poles)))
            .collect();
        // Unrefined poles leave more than noise, which tempts to more of them: refine the fewest that come near.
        let least = starts.iter().map(|fit| fit.square.max(self.floor)).fold(f64::INFINITY, f64::min);
        let fewest = starts
            .iter()
            .filter(|fit| fit.square <= 2.0 * least)
            .min_by_key(|fit| order(&fit.poles))
            .map(|fit| self.refined(fit.clone(), TO_THE_END));
        let start = starts.into_iter().fold(empty, |best, fit| self.better(best, fit));
        let mut best = match fewest {
            Some(fewest) if self.criterion(&fewest) <= self.criterion(&start) => fewest,
            _ => self.refined(start, TO_THE_END),
        };
        for _ in 0..ROUNDS {
            let before = self.criterion(&best);
            let dropped = self.dropped(&best);
            best = dropped.into_iter().fold(best, |best, fit| self.better(best, fit));
            let added = self.added(&best);
            best = added.into_iter().fold(best, |best, fit| self.better(best, fit));
            if self.criterion(&best) >= before {
                break;
            }
            best = self.refined(best, TO_THE_END);
        }
        Some(best)
    }

    /// Schwarz's criterion with a correction for few samples: `N ln(sum of squares) + p ln N (N / (N - p - 2))`, `p`
    /// parameters. A pair costs at least 24, so that the best of a few hundred candidates in noise is not taken. One
    /// that decays faster than it turns costs ten more: two decays look alike, and a mode must be e^5 likelier.
    ///
    /// # References
    /// G. Schwarz, "Estimating the dimension of a model", Annals of Statistics 6 (1978), doi:10.1214/aos/1176344136;
    /// A. D. R. McQuarrie and C.-L. Tsai, "Regression and Time Series Model Selection", World Scientific, 1998.
    fn criterion(&self, fit: &Fit) -> f64 {
        const LEAST: f64 = 6.0;
        const HEAVILY_DAMPED: f64 = 10.0;
        let samples = self.y.len() as f64;
        let parameters = 2.0 * order(&fit.poles) as f64;
        let few = samples / (samples - parameters - 2.0).max(1.0);
        let heavy = fit.poles.iter().filter(|pole| heavily_damped(pole)).count() as f64;
        samples * fit.square.max(self.floor).ln()
            + HEAVILY_DAMPED * heavy
            + parameters * samples.ln().max(LEAST) * few
    }

    fn better(&self, one: Fit, other: Fit) -> Fit {
        if self.criterion(&other) < self.criterion(&one) { other } else { one }
    }

    fn linear(&self, poles: Vec<Pole>) -> Option<Fit> {
        Fit::linear(poles, self.offset, self.y)
    }

    fn refined(&self, fit: Fit, iterations: usize) -> Fit {
        fit.refined(self.offset, self.y, self.floor, iterations)
    }

    /// Without real poles that the record cannot tell from the constant.
    fn without_constant(&self, mut poles: Vec<Pole>) -> Vec<Pole> {
        let samples = self.y.len() as f64;
        poles.retain(|pole| {
            !(self.offset && matches!(pole, Pole::Real { decay } if decay.abs() * samples < 1.0))
        });
        poles
    }

    /// The fit without its least useful pole, and with a pair that hardly turns as one or two decays.
    fn dropped(&self, fit: &Fit) -> Vec<Fit> {
        let with = |at: usize, others: &[Pole]| {
            let mut poles = fit.poles.clone();
            poles.splice(at..=at, others.iter().copied());
            self.linear(poles)
        };
        let weakest = (0..fit.poles.len())
            .filter_map(|at| with(at, &[]))
            .min_by(|a, b| self.criterion(a).total_cmp(&self.criterion(b)))
            // What refinement of the others cannot make good is not worth the try.
            .filter(|fit_without| fit_without.square <= 4.0 * fit.square.max(self.floor));
        let flattened = fit.poles.iter().enumerate().flat_map(|(at, pole)| match *pole {
            Pole::Pair { decay, .. } if heavily_damped(pole) => {
                let one = with(at, &[Pole::Real { decay }]);
                let two = with(at, &[Pole::Real { decay: 0.7 * decay }, Pole::Real { decay: 1.4 * decay }]);
                [one, two]
            }
            _ => [None, None],
        });
        weakest
            .into_iter()
            .chain(flattened.flatten())
            .chain(self.joined(fit))
            .map(|fit| self.refined(fit, TRIAL))
            .collect()
    }

    /// The fit with one pair in place of all its decays: several of them imitate a heavily damped mode.
    fn joined(&self, fit: &Fit) -> Option<Fit> {
        let real = |pole: &Pole| if let Pole::Real { decay } = pole { Some(*decay) } else { None };
        let decays: Vec<f64> = fit.poles.iter().filter_map(real).collect();
        if decays.len() < 2 {
            return None;
        }
        let decay = decays.iter().sum::<f64>() / decays.len() as f64;
        let mut poles: Vec<Pole> = fit.poles.iter().copied().filter(|pole| real(pole).is_none()).collect();
        poles.push(Pole::Pair { decay, turn: 0.5 * decay.abs() }.bounded(self.y.len()));
        self.linear(poles)
    }

    /// The fit with the strongest one or two poles of what it leaves.
    fn added(&self, fit: &Fit) -> Vec<Fit> {
        let left = residual(&fit.poles, &fit.amplitudes, self.offset, self.y);
        starts(&left, 2)
            .into_iter()
            .filter_map(|more| {
                let more = self.without_constant(more);
                let poles: Vec<Pole> = fit.poles.iter().copied().chain(more.iter().copied()).collect();
                let fits = !more.is_empty() && order(&poles) <= self.largest_order;
                if fits { self.linear(poles) } else { None }
            })
            .map(|fit| self.refined(fit, TRIAL))
            .collect()
    }
}

/// A pair with a damping ratio above `1/sqrt(2)`.
fn heavily_damped(pole: &Pole) -> bool {
    matches!(pole, Pole::Pair { decay, turn } if turn < decay)
}
