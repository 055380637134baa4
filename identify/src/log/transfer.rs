//! Modes from the transfer function between command and response.

use profiles::Complex;

use super::pool::Sighting;
use super::{Fitted, Log, LogError};
use crate::error::TransferFunctionError;
use crate::transfer_function::{
    Hold, RootEstimate, TransferFunctionFit, TransferFunctionOptions, fit_transfer_function,
};

/// Most samples that are fitted; more are averaged in blocks on both sides, which leaves the transfer function.
const MOST: usize = 4096;
/// Most poles.
const MOST_POLES: usize = 6;

/// What transfer functions of several orders show.
pub(super) struct Transfers {
    /// The modes of every model that explains the log about as well as the best.
    pub(super) views: Vec<Vec<Sighting>>,
    /// The output of the best model.
    pub(super) fitted: Fitted,
    /// Its fit, percent.
    pub(super) fit: f64,
    /// Standard deviation of what it leaves.
    pub(super) noise: f64,
    /// Its gain at frequency zero.
    pub(super) gain: f64,
    /// Its poles and zeros.
    pub(super) order: (usize, usize),
    /// Samples averaged to one.
    pub(super) block: usize,
    /// What there is to say where no mode of them can be used.
    pub(super) nothing: LogError,
}

/// A model that was tried.
struct Tried {
    found: TransferFunctionFit,
    order: (usize, usize),
    criterion: f64,
}

impl Tried {
    fn swings(&self) -> bool {
        self.found.poles.iter().any(|pole| pole.imaginary > 0.0)
    }
}

/// Fits models of one to six poles and keeps those whose modes are needed and whose numbers can be believed.
///
/// Orders are compared by Schwarz's criterion, `N ln(sum of squares) + p ln N` with `p` parameters. A mode must lower
/// it by 20 against the best model without one. Models whose slowest pole is slower than the record is long
/// trade it for the offset, and are left out.
pub(super) fn transfers(log: &Log<'_>) -> Result<Transfers, LogError> {
    /// e^(20/2) to one.
    const NEEDED: f64 = 20.0;
    /// Standard deviation over that of the best model up to which another one is a view of the log as well.
    const SIMILAR: f64 = 1.25;
    let block = log.response.len().div_ceil(MOST);
    // The axis has stood at the first command: what counts is the distance from there.
    let start = log.command.first().copied().unwrap_or(0.0);
    let averaged = |values: &[f64], start: f64| -> Vec<f64> {
        let mean = |chunk: &[f64]| chunk.iter().map(|x| (x - start) / block as f64).sum();
        values.chunks_exact(block).map(mean).collect()
    };
    let (input, output) = (averaged(log.command, start), averaged(log.response, 0.0));
    let period = log.period * block as f64;
    let tried = tried(&input, &output, period, if block > 1 { Hold::First } else { Hold::Zero })?;

    let best_of = |swinging: bool| {
        tried.iter().filter(|t| t.swings() == swinging).min_by(|a, b| a.criterion.total_cmp(&b.criterion))
    };
    let residual = |tried: Option<&Tried>| tried.map_or(f64::INFINITY, |t| t.found.residual_deviation);
    let static_criterion = criterion(static_residual(&input, &output), output.len(), 2);
    let without = best_of(false);
    let rigid = without.map_or(f64::INFINITY, |t| t.criterion).min(static_criterion);
    let gain_alone = (static_residual(&input, &output) / output.len() as f64).sqrt();
    let nothing =
        LogError::Rigid { without: residual(without).min(gain_alone), with: residual(best_of(true)) };
    let Some(best) = best_of(true).filter(|best| best.criterion < rigid - NEEDED) else {
        return Err(nothing);
    };
    let similar =
        tried.iter().filter(|t| residual(Some(t)) <= SIMILAR * residual(Some(best)) && t.criterion < rigid);
    let views = similar.map(|t| sightings(&t.found, &input, period)).collect();
    let values = best.found.output.iter().flat_map(|y| std::iter::repeat_n(*y, block)).collect();
    Ok(Transfers {
        views,
        fitted: Fitted { first: 0, values },
        fit: best.found.fit,
        noise: best.found.residual_deviation,
        gain: best.found.dc_gain,
        order: best.order,
        block,
        nothing,
    })
}

/// All models with one or two zeros less than poles, up to the order from which no more are better.
fn tried(input: &[f64], output: &[f64], period: f64, hold: Hold) -> Result<Vec<Tried>, LogError> {
    let mut tried: Vec<Tried> = Vec::new();
    let mut last = None;
    let (mut least, mut worse) = (f64::INFINITY, 0);
    for poles in 1..=MOST_POLES {
        let before = least;
        for zeros in poles.saturating_sub(2)..poles {
            let options = TransferFunctionOptions {
                hold,
                offset: true,
                noise_lags: (output.len() / 40).min(50),
                ..TransferFunctionOptions::new(poles, zeros)
            };
            match fit_transfer_function(input, output, period, &options) {
                Ok(found) => {
                    let span = output.len() as f64 * period;
                    if found.poles.iter().any(|pole| pole.angular_frequency() * span < std::f64::consts::PI) {
                        continue;
                    }
                    let square = found.residual_deviation * found.residual_deviation * output.len() as f64;
                    let criterion = criterion(square, output.len(), poles + zeros + 2);
                    least = least.min(criterion);
                    tried.push(Tried { found, order: (poles, zeros), criterion });
                }
                Err(error) => last = Some(error),
            }
        }
        worse = if least < before { 0 } else { worse + 1 };
        // A mode more takes two poles more.
        if worse > 1 {
            break;
        }
    }
    match last {
        // Not even one pole: a gain says it all, and the caller has that.
        Some(TransferFunctionError::Undetermined { .. }) => Ok(tried),
        Some(error) if tried.is_empty() => Err(error.into()),
        _ => Ok(tried),
    }
}

fn criterion(square: f64, samples: usize, parameters: usize) -> f64 {
    let samples = samples as f64;
    samples * (square / samples).max(1e-300).ln() + parameters as f64 * samples.ln()
}

/// Sum of squares that the best `gain u + offset` leaves.
fn static_residual(input: &[f64], output: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (u, y) = (mean(input), mean(output));
    let sum =
        |f: &dyn Fn(f64, f64) -> f64| -> f64 { input.iter().zip(output).map(|(a, b)| f(a - u, b - y)).sum() };
    let square = sum(&|a, _| a * a);
    let gain = if square > 0.0 { sum(&|a, b| a * b) / square } else { 0.0 };
    sum(&|a, b| (b - gain * a) * (b - gain * a))
}

fn sightings(found: &TransferFunctionFit, input: &[f64], period: f64) -> Vec<Sighting> {
    found
        .poles
        .iter()
        .filter(|pole| pole.imaginary > 0.0)
        .filter_map(|pole| {
            let size = 2.0 * residue(found, pole)?.norm();
            // What the mode alone adds to the response: its norm and its largest value.
            let own = swing(pole.value(), input, period).map(|swing| size * swing.norm());
            let (square, amplitude) =
                own.fold((0.0_f64, 0.0_f64), |(square, most), x| (square + 0.5 * x * x, most.max(x)));
            let (frequency, damping) = (pole.angular_frequency(), pole.damping_ratio());
            Some(Sighting {
                frequency,
                damping,
                frequency_deviation: pole.frequency_deviation,
                damping_deviation: pole.damping_deviation,
                amplitude,
                // A unit mode is w^2 / (s^2 + 2 z w s + w^2): its residue has the modulus w^2 / (2 w_d).
                participation: Some(size * pole.imaginary / (frequency * frequency)),
                significance: square.sqrt() / found.residual_deviation.max(f64::MIN_POSITIVE),
            })
        })
        .collect()
}

/// `B(p) / A'(p)` at a simple pole.
fn residue(found: &TransferFunctionFit, pole: &RootEstimate) -> Option<Complex<f64>> {
    let p = pole.value();
    let zero = Complex::new(0.0, 0.0);
    let numerator = found.numerator.iter().fold(zero, |sum, b| sum * p + *b);
    let (_, slope) =
        found.denominator.iter().fold((zero, zero), |(value, slope), a| (value * p + *a, slope * p + value));
    let residue = numerator / slope;
    (residue.re.is_finite() && residue.im.is_finite()).then_some(residue)
}

/// The integral of `e^(p (t - x)) (u(x) - u(0)) dx` up to every sample, the input held between samples.
fn swing(pole: Complex<f64>, input: &[f64], period: f64) -> impl Iterator<Item = Complex<f64>> + '_ {
    let at = pole * period;
    let turn = Complex::new(at.im.cos(), at.im.sin()) * at.re.exp();
    let held = (turn - 1.0) / pole;
    let first = input.first().copied().unwrap_or(0.0);
    input.iter().scan(Complex::new(0.0, 0.0), move |swing, u| {
        *swing = *swing * turn + held * (u - first);
        Some(*swing)
    })
}
