//! The fitted model in units of time and of the signals, with its uncertainty.

use faer::Mat;
use profiles::{Complex, Real};

use super::fit::{Model, Problem};
use super::roots::{root_gradient, roots};
use super::{RootEstimate, TransferFunctionFit};
use crate::error::{SignalError, TransferFunctionError};
use crate::fit_percentage::fit_percentage;
use crate::least_squares::{inverse_square, triangle};

/// What one stands for in the problem.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    pub(super) input_scale: f64,
    pub(super) output_scale: f64,
    /// Sample period, s.
    pub(super) period: f64,
}

pub(super) fn described(
    problem: &Problem<'_>,
    model: &Model,
    units: Units,
) -> Result<TransferFunctionFit, TransferFunctionError> {
    let undetermined = TransferFunctionError::Undetermined { condition: f64::INFINITY };
    let (n, m) = (model.a.len(), problem.options.zeros);
    let linear = problem.linear_parameters();
    let entries = problem.derivatives(model).ok_or(undetermined)?;
    let covariance = covariance(problem, &entries, linear + n)?;

    // s of the problem is s over `rate`.
    let rate = model.step / units.period;
    let gain = units.output_scale / units.input_scale;
    let numerator_unit = |k: usize| gain * Real::powf(rate, n as f64 - k as f64);
    let denominator_unit = |k: usize| Real::powf(rate, n as f64 - k as f64);
    // Ascending: numerator, then denominator.
    let unit = |k: usize| if k <= m { numerator_unit(k) } else { denominator_unit(k - m - 1) };
    let at = |k: usize| if k <= m { k } else { linear + k - m - 1 };
    let cov = |i: usize, j: usize| covariance[(at(i), at(j))];
    let ascending: Vec<f64> = model.linear.iter().take(m + 1).chain(&model.a).copied().collect();
    if let Some((index, value)) =
        ascending.iter().enumerate().map(|(k, c)| (k, c * unit(k))).find(|(_, c)| !c.is_finite())
    {
        return Err(SignalError::Value { index, value }.into());
    }

    let denominator: Vec<f64> = model.a.iter().copied().chain([1.0]).collect();
    let numerator = &model.linear[..=m];
    let root_cov = |first: usize| move |i: usize, j: usize| cov(first + i, first + j);
    let poles = estimates(&denominator, n, rate, root_cov(m + 1)).ok_or(undetermined)?;
    let zeros = if numerator[m].abs() > 0.0 { estimates(numerator, m + 1, rate, root_cov(0)) } else { None };
    let zeros = zeros.ok_or(undetermined)?;
    if let Some(pole) = poles.iter().find(|pole| pole.real >= 0.0) {
        return Err(TransferFunctionError::Unstable {
            real: pole.real,
            imaginary: pole.imaginary,
            deviation: pole.real_deviation,
        });
    }

    // Descending from here on.
    let order: Vec<usize> = (0..=m).rev().chain((m + 1..=m + n).rev()).collect();
    let value = |k: usize| ascending[k] * unit(k);
    let deviation = |k: usize| unit(k).abs() * cov(k, k).sqrt();
    let split = |f: &dyn Fn(usize) -> f64, first: f64| {
        let numerator = order.iter().take(m + 1).map(|k| f(*k)).collect();
        let denominator = std::iter::once(first).chain(order.iter().skip(m + 1).map(|k| f(*k))).collect();
        (numerator, denominator)
    };
    let (num, den) = split(&value, 1.0);
    let (numerator_deviations, denominator_deviations) = split(&deviation, 0.0);
    let rows = |i: &usize| order.iter().map(|j| unit(*i) * unit(*j) * cov(*i, *j)).collect();

    // A stable denominator has no zero at its end.
    let dc = numerator[0] / model.a[0];
    let dc_variance = cov(0, 0) - 2.0 * dc * cov(0, m + 1) + dc * dc * cov(m + 1, m + 1);
    let output: Vec<f64> =
        problem.simulated(model).ok_or(undetermined)?.iter().map(|y| y * units.output_scale).collect();
    let measured: Vec<f64> = problem.output.iter().map(|y| y * units.output_scale).collect();
    let offset = if problem.options.offset { model.linear.last().copied().unwrap_or(0.0) } else { 0.0 };
    Ok(TransferFunctionFit {
        numerator: num,
        numerator_deviations,
        denominator: den,
        denominator_deviations,
        covariance: order.iter().map(rows).collect(),
        poles,
        zeros,
        dc_gain: gain * dc,
        dc_gain_deviation: gain * dc_variance.max(0.0).sqrt() / model.a[0].abs(),
        offset: offset * units.output_scale,
        fit: fit_percentage(&measured, &output)?,
        output,
        residual_deviation: units.output_scale * variance(problem, &entries, linear + n).sqrt(),
    })
}

/// Variance of what the fit leaves.
fn variance(problem: &Problem<'_>, entries: &[f64], parameters: usize) -> f64 {
    let residual = &entries[parameters * problem.samples()..];
    let square: f64 = residual.iter().map(|e| e * e).sum();
    square / (problem.samples() - parameters) as f64
}

/// Covariance of all parameters of the problem.
///
/// With derivatives `J` and residuals whose correlation over `k` samples is `r[k]`, it is
/// `(J^T J)^-1 J^T R J (J^T J)^-1`, `R[i, j] = r[i - j]`; that is `r[0] (J^T J)^-1` for white noise. Correlations
/// fade linearly to zero past the last lag, which keeps `R` positive.
///
/// # References
/// W. K. Newey, K. D. West, "A simple, positive semi-definite, heteroskedasticity and autocorrelation consistent
/// covariance matrix", Econometrica 55 (1987), doi:10.2307/1913610.
fn covariance(
    problem: &Problem<'_>,
    entries: &[f64],
    parameters: usize,
) -> Result<Mat<f64>, TransferFunctionError> {
    // A sum of squares that halves the digits leaves none beyond.
    const LARGEST_CONDITION: f64 = 1e10;
    // Of a fit to noise by six parameters this is met once in a million.
    const LEAST_RATIO: f64 = 10.0;
    let samples = problem.samples();
    let undetermined = |condition| TransferFunctionError::Undetermined { condition };
    let (columns, residual) = entries.split_at(parameters * samples);
    let norms: Vec<f64> = columns
        .chunks_exact(samples)
        .map(|column| column.iter().map(|x| x * x).sum::<f64>().sqrt())
        .collect();
    if norms.iter().any(|norm| norm.is_nan() || *norm <= 0.0) {
        return Err(undetermined(f64::INFINITY));
    }
    let scaled: Vec<f64> = columns
        .chunks_exact(samples)
        .zip(&norms)
        .flat_map(|(c, norm)| c.iter().map(move |x| x / norm))
        .collect();
    let r = triangle(&scaled, samples);
    let singular = r.singular_values().map_err(|_| undetermined(f64::INFINITY))?;
    let condition =
        singular.iter().copied().fold(0.0, f64::max) / singular.iter().copied().fold(f64::INFINITY, f64::min);
    if condition.is_nan() || condition > LARGEST_CONDITION {
        return Err(undetermined(condition));
    }
    let variance = variance(problem, entries, parameters);
    let ratio = explained(problem, residual) / (parameters as f64 * variance).max(f64::MIN_POSITIVE);
    if ratio < LEAST_RATIO {
        return Err(TransferFunctionError::NoResponse { ratio, least: LEAST_RATIO });
    }
    let inverse = inverse_square(&r, parameters).ok_or(undetermined(condition))?;
    let lags = problem.options.noise_lags.min(samples / 4);
    let middle = correlated(&scaled, residual, parameters, lags);
    let square: f64 = residual.iter().map(|e| e * e).sum();
    let sandwich = if lags == 0 || square <= 0.0 {
        faer::Scale(variance) * &inverse
    } else {
        faer::Scale(variance / square) * (&inverse * middle * &inverse)
    };
    Ok(Mat::from_fn(parameters, parameters, |i, j| sandwich[(i, j)] / (norms[i] * norms[j])))
}

/// How much the sum of squares about the best constant, or zero where no constant is in the model, falls by the fit.
fn explained(problem: &Problem<'_>, residual: &[f64]) -> f64 {
    let samples = problem.samples() as f64;
    let mean = if problem.options.offset { problem.output.iter().sum::<f64>() / samples } else { 0.0 };
    let before: f64 = problem.output.iter().map(|y| (y - mean) * (y - mean)).sum();
    before - residual.iter().map(|e| e * e).sum::<f64>()
}

/// `J^T R J` with the sum of products of residuals as `r`.
fn correlated(columns: &[f64], residual: &[f64], parameters: usize, lags: usize) -> Mat<f64> {
    let samples = residual.len();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let column = |i: usize| &columns[i * samples..(i + 1) * samples];
    let mut sum = Mat::zeros(parameters, parameters);
    for lag in 0..=lags {
        let fade = 1.0 - lag as f64 / (lags + 1) as f64;
        let r = fade * dot(residual, &residual[lag..]);
        for i in 0..parameters {
            for j in 0..parameters {
                let one = dot(column(i), &column(j)[lag..]);
                sum[(i, j)] += r * one;
                if lag > 0 {
                    sum[(j, i)] += r * one;
                }
            }
        }
    }
    sum
}

/// The roots of a polynomial, ascending, in rad/s with what the covariance of its first `free` coefficients does to
/// them.
fn estimates(
    coefficients: &[f64],
    free: usize,
    rate: f64,
    covariance: impl Fn(usize, usize) -> f64,
) -> Option<Vec<RootEstimate>> {
    let found = roots(coefficients)?
        .into_iter()
        .map(|root| {
            let gradient: Vec<Complex<f64>> = root_gradient(coefficients, root).take(free).collect();
            let radius = root.norm();
            let deviation = |part: &dyn Fn(Complex<f64>) -> f64| {
                let slopes: Vec<f64> = gradient.iter().map(|g| part(*g)).collect();
                let sum: f64 = (0..free)
                    .flat_map(|i| (0..free).map(move |j| (i, j)))
                    .map(|(i, j)| slopes[i] * slopes[j] * covariance(i, j))
                    .sum();
                // Of a double root the gradient has no bound, and infinities of both signs have no sum.
                if sum.is_nan() { f64::INFINITY } else { sum.max(0.0).sqrt() }
            };
            // d|p| is Re(conj(p) dp) / |p|; the damping ratio is minus the cosine of the angle, whose differential is
            // Im(conj(p) dp) / |p|^2.
            let turned = |g: Complex<f64>| root.conj() * g / radius;
            RootEstimate {
                real: rate * root.re,
                imaginary: rate * root.im,
                real_deviation: rate * deviation(&|g| g.re),
                imaginary_deviation: rate * deviation(&|g| g.im),
                frequency_deviation: rate * deviation(&|g| turned(g).re),
                damping_deviation: deviation(&|g| turned(g).im * root.im / (radius * radius)),
            }
        })
        .collect();
    Some(found)
}
