//! Output-error minimisation: numerator, initial state and offset are linear once the poles are given, so Levenberg
//! and Marquardt's method moves the poles alone.

use faer::Mat;

use super::chain::{Chain, Motion};
use super::roots::roots;
use super::{Hold, TransferFunctionOptions};
use crate::least_squares::{back_substitute, damped_step, left, triangle};

/// The data in units of their largest values, and what is asked of the model.
pub(super) struct Problem<'a> {
    pub(super) input: &'a [f64],
    pub(super) output: &'a [f64],
    pub(super) options: &'a TransferFunctionOptions,
    /// Sum of squares that rounding alone may leave.
    pub(super) floor: f64,
}

/// A model in a unit of time of which one sample is `step`.
#[derive(Debug, Clone)]
pub(super) struct Model {
    pub(super) step: f64,
    /// Denominator below its leading one, ascending.
    pub(super) a: Vec<f64>,
    /// Numerator, ascending; then the numerator of the free motion and the offset, as far as asked for.
    pub(super) linear: Vec<f64>,
    /// Sum of squares of the residual.
    pub(super) square: f64,
}

/// The columns whose combination is the output, and the motions behind them.
struct Columns {
    entries: Vec<f64>,
    forced: Motion,
    free: Option<Motion>,
}

impl Problem<'_> {
    pub(super) fn samples(&self) -> usize {
        self.output.len()
    }

    /// Number of linear parameters.
    pub(super) fn linear_parameters(&self) -> usize {
        let options = self.options;
        let free = if options.initial_state { options.poles } else { 0 };
        options.zeros + 1 + free + usize::from(options.offset)
    }

    /// The motions of a denominator; none for poles that alias or leave the range within the record.
    fn columns(&self, a: &[f64], step: f64, more: usize) -> Option<Columns> {
        if !self.seen(a, step) {
            return None;
        }
        let chain = Chain::new(a, step, self.options.hold)?;
        let forced = chain.forced(self.input);
        let free = self.options.initial_state.then(|| chain.free(self.samples()));
        let mut entries = Vec::with_capacity(self.samples() * (self.linear_parameters() + more));
        entries.extend(forced.x.iter().take(self.options.zeros + 1).flatten());
        if let Some(free) = &free {
            entries.extend(free.x.iter().take(a.len()).flatten());
        }
        if self.options.offset {
            entries.resize(entries.len() + self.samples(), 1.0);
        }
        entries.iter().all(|entry| entry.is_finite()).then_some(Columns { entries, forced, free })
    }

    /// Whether samples tell such poles from others: not beyond half the sample rate, and grown to e^30 at most.
    fn seen(&self, a: &[f64], step: f64) -> bool {
        const GROWTH: f64 = 30.0;
        const FASTEST: f64 = 100.0;
        let monic: Vec<f64> = a.iter().copied().chain([1.0]).collect();
        let span = self.samples() as f64;
        roots(&monic).is_some_and(|poles| {
            poles.iter().all(|pole| {
                (pole.im * step).abs() < std::f64::consts::PI
                    && pole.re * step * span < GROWTH
                    && pole.norm() * step < FASTEST
            })
        })
    }

    /// The best numerator for a denominator.
    pub(super) fn model(&self, a: Vec<f64>, step: f64) -> Option<Model> {
        let mut entries = self.columns(&a, step, 1)?.entries;
        entries.extend_from_slice(self.output);
        let r = triangle(&entries, self.samples());
        let size = self.linear_parameters();
        let linear = back_substitute(&r, 0, size, size)?;
        Some(Model { step, a, linear, square: r[(size, size)] * r[(size, size)] })
    }

    /// The output of a model.
    pub(super) fn simulated(&self, model: &Model) -> Option<Vec<f64>> {
        let columns = self.columns(&model.a, model.step, 0)?;
        let residual = left(&columns.entries, &model.linear, self.output);
        Some(self.output.iter().zip(residual).map(|(y, e)| y - e).collect())
    }

    /// The derivatives of the output by all parameters, the linear ones first, and the residual behind them.
    pub(super) fn derivatives(&self, model: &Model) -> Option<Vec<f64>> {
        let n = model.a.len();
        let Columns { mut entries, forced, free } = self.columns(&model.a, model.step, n + 1)?;
        let residual = left(&entries, &model.linear, self.output);
        let (numerator, others) = model.linear.split_at(self.options.zeros + 1);
        for k in 0..n {
            // d/da[k] of B/A u is -s^k B/A^2 u.
            let start = entries.len();
            entries.resize(start + self.samples(), 0.0);
            let column = &mut entries[start..];
            let forced = numerator.iter().zip(&forced.v[k..]);
            let free = free.iter().flat_map(|free| others.iter().take(n).zip(&free.v[k..]));
            for (weight, v) in forced.chain(free) {
                column.iter_mut().zip(v).for_each(|(column, v)| *column -= weight * v);
            }
        }
        entries.extend_from_slice(&residual);
        Some(entries)
    }

    /// The nearest minimum of the sum of squares, or the way there after some `iterations`.
    ///
    /// # References
    /// G. H. Golub and V. Pereyra, "Separable nonlinear least squares: the variable projection method and its
    /// applications", Inverse Problems 19 (2003), doi:10.1088/0266-5611/19/2/201. The Jacobian is Kaufman's.
    pub(super) fn refined(&self, mut model: Model, iterations: usize) -> Model {
        const REFUSALS: usize = 8;
        let mut damping = 1e-3;
        for _ in 0..iterations {
            let Some(entries) = self.derivatives(&model) else { break };
            let r = triangle(&entries, self.samples());
            let (size, first) = (model.a.len() + 1, self.linear_parameters());
            let r = Mat::from_fn(size, size, |i, j| r[(first + i, first + j)]);
            let mut gain = None;
            for _ in 0..REFUSALS {
                let trial = damped_step(&r, damping)
                    .map(|step| model.a.iter().zip(step).map(|(a, step)| a + step).collect())
                    .and_then(|a| self.model(a, model.step));
                match trial {
                    Some(trial) if trial.square < model.square => {
                        gain = Some(model.square - trial.square);
                        model = trial;
                        damping *= 0.05;
                        break;
                    }
                    _ => damping = (damping * 10.0).max(1e-6),
                }
            }
            // A sum of squares that falls by less than this moves no parameter by a thousandth of its deviation.
            let enough = 1e-9 * model.square / self.samples() as f64;
            if gain.is_none_or(|gain| gain <= enough) || model.square <= 1e-6 * self.floor {
                break;
            }
        }
        model
    }

    /// The motion of given data through `1/A`, as straight lines between samples or as the input is held.
    pub(super) fn filtered(&self, a: &[f64], step: f64, data: &[f64], hold: Hold) -> Option<Vec<Vec<f64>>> {
        let x = Chain::new(a, step, hold)?.forced(data).x;
        x.iter().flatten().all(|x| x.is_finite()).then_some(x)
    }

    /// The free motion of `1/A`.
    pub(super) fn freed(&self, a: &[f64], step: f64) -> Option<Vec<Vec<f64>>> {
        Some(Chain::new(a, step, self.options.hold)?.free(self.samples()).x)
    }
}
