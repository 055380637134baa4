//! Modes from what goes on swinging while the command is at rest.

use profiles::{Complex, Mode, Real};

use super::pool::Sighting;
use super::rest::{Rest, rests};
use super::{Fitted, Log, LogError};
use crate::error::SinusoidError;
use crate::sinusoids::{DampedSinusoids, SinusoidOptions, fit_damped_sinusoids};

/// Fewest samples of a free decay.
const LEAST: usize = 32;
/// Most samples that are fitted; more are averaged in blocks, which leaves the poles where they are.
const MOST: usize = 16_384;
/// Most rests that are fitted.
const MOST_RESTS: usize = 16;

/// What the rests of a log show.
pub(super) struct Decays {
    /// The modes of every window of every rest.
    pub(super) views: Vec<Vec<Sighting>>,
    /// Rests after a move that were looked at.
    pub(super) rests: Vec<Rest>,
    /// The fit of the rest with the largest swing.
    pub(super) fitted: Option<Fitted>,
    /// Fit of that rest, percent.
    pub(super) fit: f64,
    /// Standard deviation of what that fit leaves.
    pub(super) noise: f64,
    /// Why there is no mode, where no view can be fitted.
    pub(super) why: Option<LogError>,
    /// What there is to say where no view has a mode.
    pub(super) nothing: LogError,
}

/// The rests of the command after a move; the whole log from its largest swing on where the command never moves.
pub(super) fn rests_after_moves(log: &Log<'_>) -> Vec<Rest> {
    // A set-point is exact, a measured one is not: the finest tolerance that shows a rest.
    const TOLERANCES: [f64; 4] = [1e-6, 1e-4, 1e-3, 1e-2];
    let range = log.command_range();
    if range <= 0.0 {
        let end = median(last_quarter(log.response));
        let swing = |(_, y): &(usize, &f64)| (**y - end).abs();
        let first = log
            .response
            .iter()
            .enumerate()
            .max_by(|a, b| swing(a).total_cmp(&swing(b)))
            .map_or(0, |(k, _)| k);
        return vec![Rest { first, end: log.response.len() }];
    }
    TOLERANCES
        .iter()
        .map(|part| {
            let mut found = rests(log.command, part * range, LEAST);
            found.retain(|rest| rest.first > 0);
            found
        })
        .find(|found| !found.is_empty())
        .unwrap_or_default()
}

/// The modes in every rest.
pub(super) fn decays(log: &Log<'_>, mut rests: Vec<Rest>, noise: f64, quantum: f64) -> Decays {
    // The longest tell most; the order of time is kept.
    let mut lengths: Vec<usize> = rests.iter().map(Rest::samples).collect();
    lengths.sort_unstable_by(|a, b| b.cmp(a));
    let least = lengths.get(MOST_RESTS - 1).copied().unwrap_or(0);
    rests.retain(|rest| rest.samples() >= least.max(LEAST));
    rests.truncate(MOST_RESTS);
    let nothing = LogError::NothingSwings { rests: rests.len(), movement: 0.0, noise };
    let mut found = Decays { views: Vec::new(), rests, fitted: None, fit: 0.0, noise, why: None, nothing };
    let (mut largest, mut movement) = (0.0_f64, 0.0_f64);
    for rest in found.rests.clone() {
        let Some(values) = log.response.get(rest.first..rest.end) else { continue };
        let (length, swing) = swinging(values, (4.0 * noise).max(1.5 * quantum));
        movement = movement.max(swing);
        let (eighth, later) = (length / 8, length - length / 4);
        // What is there is there wherever one begins and ends; what imitates friction or an offset is not.
        for (first, end) in [(0, length), (0, later), (eighth, length), (eighth, later), (length / 4, length)]
        {
            let Some(window) = values.get(first..end).filter(|window| window.len() >= LEAST) else {
                continue;
            };
            match view(log, window, rest.first + first) {
                Ok(view) => {
                    if (first, end) == (0, length) && swing > largest {
                        largest = swing;
                        (found.fit, found.noise) = (view.fit, view.noise);
                        found.fitted = Some(view.fitted);
                    }
                    found.views.push(view.modes);
                }
                Err(SinusoidError::NoMode { .. }) => found.views.push(Vec::new()),
                Err(error) => found.why = Some(error.into()),
            }
        }
    }
    found.nothing = LogError::NothingSwings { rests: found.rests.len(), movement, noise };
    if found.views.iter().any(|view| !view.is_empty()) {
        found.why = None;
    }
    found
}

/// How many samples pass before a record stays within `threshold` of its end, and the largest distance from there.
///
/// Where the last quarter moves by more than that, as noise with a colour and a long record do, it sets the threshold; a
/// record that hardly decays is kept whole.
fn swinging(values: &[f64], threshold: f64) -> (usize, f64) {
    let tail = last_quarter(values);
    let end = median(tail);
    let most = |values: &[f64]| values.iter().map(|y| (y - end).abs()).fold(0.0, f64::max);
    let (swing, left) = (most(values), 1.1 * most(tail));
    if left > threshold && swing < 2.0 * left {
        return (values.len(), swing);
    }
    let last = values.iter().rposition(|y| (y - end).abs() > threshold.max(left));
    // A little more shows the offset.
    let length = last.map_or(0, |last| (last + 1) + (last + 1) / 8 + 16);
    (length.min(values.len()), swing)
}

struct View {
    modes: Vec<Sighting>,
    fitted: Fitted,
    fit: f64,
    noise: f64,
    /// Samples over which what the fit leaves is correlated.
    correlation: f64,
}

/// The modes of one free decay, whose first sample is `first` of the log.
///
/// The errors of a count or of friction last for many samples of a slow swing, and a criterion that takes every sample for
/// news finds modes in them. Where what is left is correlated, blocks of that length are averaged and fitted anew.
fn view(log: &Log<'_>, values: &[f64], first: usize) -> Result<View, SinusoidError> {
    const CORRELATED: f64 = 2.0;
    const FEWEST: usize = 64;
    const TO_A_PERIOD: f64 = 10.0;
    let block = values.len().div_ceil(MOST);
    let view = averaged_view(log, values, first, block)?;
    let sure = view.modes.iter().filter(|mode| mode.significance > 5.0).map(|mode| mode.frequency);
    let fastest = sure.fold(0.0, f64::max);
    let longest = std::f64::consts::TAU / (TO_A_PERIOD * fastest * log.period);
    let longer = ((block as f64 * view.correlation).min(longest) as usize).min(values.len() / FEWEST);
    if view.correlation > CORRELATED && longer > block {
        averaged_view(log, values, first, longer)
    } else {
        Ok(view)
    }
}

fn averaged_view(log: &Log<'_>, values: &[f64], first: usize, block: usize) -> Result<View, SinusoidError> {
    let averaged: Vec<f64> =
        values.chunks_exact(block).map(|chunk| chunk.iter().map(|y| y / block as f64).sum()).collect();
    let period = log.period * block as f64;
    let found = fit_damped_sinusoids(&averaged, period, &SinusoidOptions::default())?;
    let left: Vec<f64> =
        averaged.iter().enumerate().map(|(n, y)| y - value(&found, n as f64 * period)).collect();
    let modes = found
        .modes
        .iter()
        .map(|estimate| {
            let (mode, pole) = (estimate.mode, estimate.mode.pole());
            let colour = colour(&left, mode.angular_frequency() * period).sqrt();
            let amplitude = estimate.amplitude / block_gain(pole * log.period, block);
            let rate = -pole.re * period;
            let lasting = (averaged.len() as f64).min(0.5 / rate.max(1e-12));
            Sighting {
                frequency: mode.angular_frequency(),
                damping: mode.damping_ratio(),
                frequency_deviation: colour * estimate.frequency_deviation,
                damping_deviation: colour * estimate.damping_deviation,
                amplitude,
                participation: log.unit_swing(mode, first).map(|unit| amplitude / unit),
                significance: estimate.amplitude * (0.5 * lasting).sqrt()
                    / found.noise.max(f64::MIN_POSITIVE),
            }
        })
        .collect();
    // The average of a block stands at its middle.
    let shift = 0.5 * (block - 1) as f64 * log.period;
    let curve = (0..values.len()).map(|n| value(&found, n as f64 * log.period - shift)).collect();
    let fitted = Fitted { first, values: curve };
    Ok(View { modes, fitted, fit: found.fit, noise: found.noise, correlation: correlation(&left) })
}

/// Samples over which a record is correlated: `1 + 2 sum of r[k]` over the lags up to the first correlation below a
/// twentieth.
fn correlation(left: &[f64]) -> f64 {
    const FAINT: f64 = 0.05;
    let product = |lag: usize| -> f64 { left.iter().zip(left.iter().skip(lag)).map(|(a, b)| a * b).sum() };
    let power = product(0);
    if power <= 0.0 {
        return 1.0;
    }
    let lags = (1..left.len() / 4).map(|lag| product(lag) / power).take_while(|r| *r > FAINT);
    1.0 + 2.0 * lags.sum::<f64>()
}

/// The fitted model at a time after its first sample, s.
fn value(found: &DampedSinusoids, t: f64) -> f64 {
    let modes = found.modes.iter().map(|estimate| {
        let pole = estimate.mode.pole();
        estimate.amplitude * Real::exp(pole.re * t) * Real::cos(pole.im * t + estimate.phase)
    });
    let decays = found.decays.iter().map(|decay| decay.amplitude * Real::exp(-decay.rate * t));
    found.offset + modes.chain(decays).sum::<f64>()
}

/// Power density of what a fit leaves about an angle per sample, over its mean: the part by which white noise of the
/// same power understates the variance of a mode there; at least one.
fn colour(left: &[f64], turn: f64) -> f64 {
    const BINS: usize = 24;
    let power: f64 = left.iter().map(|e| e * e).sum();
    if power <= 0.0 {
        return 1.0;
    }
    // The fit takes away what lies at the mode itself: half an octave either side.
    let density = (0..BINS)
        .map(|k| {
            let angle = turn * (0.7 + 0.7 * k as f64 / (BINS - 1) as f64);
            let step = Complex::new(Real::cos(angle), -Real::sin(angle));
            let start = (Complex::new(0.0, 0.0), Complex::new(1.0, 0.0));
            let (sum, _) = left.iter().fold(start, |(sum, at), e| (sum + at * *e, at * step));
            sum.norm_sqr()
        })
        .sum::<f64>()
        / BINS as f64;
    (density / power).max(1.0)
}

/// What averaging over blocks of samples leaves of an exponential: `|(e^(p q) - 1) / (q (e^p - 1))|`, `p` per sample.
fn block_gain(pole: Complex<f64>, block: usize) -> f64 {
    let q = block as f64;
    let less_one = |p: Complex<f64>| {
        let (sin, cos) = Real::sin_cos(p.im);
        Complex::new(Real::exp(p.re) * cos - 1.0, Real::exp(p.re) * sin)
    };
    if block > 1 { (less_one(pole * q) / (less_one(pole) * q)).norm().max(1e-3) } else { 1.0 }
}

impl Log<'_> {
    /// The amplitude with which a mode of unit participation swings about the command at sample `at`, if the command
    /// drives it by more than a thousandth of its range: `|p| / w_d` times the modulus of the sum of
    /// `du[k] e^(p (t[at] - t[k]))`.
    fn unit_swing(&self, mode: Mode, at: usize) -> Option<f64> {
        let pole = mode.pole();
        let (sin, cos) = Real::sin_cos(pole.im * self.period);
        let turn = Complex::new(cos, sin) * Real::exp(pole.re * self.period);
        let mut before = self.command.first().copied()?;
        let swing = self.command.iter().take(at + 1).fold(Complex::new(0.0, 0.0), |swing, u| {
            let next = swing * turn + (u - before);
            before = *u;
            next
        });
        let unit = swing.norm() * mode.angular_frequency() / mode.damped_angular_frequency();
        (unit > 1e-3 * self.command_range()).then_some(unit)
    }
}

fn last_quarter(values: &[f64]) -> &[f64] {
    values.get(values.len() - values.len() / 4..).filter(|tail| !tail.is_empty()).unwrap_or(values)
}

pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_averages_an_exponential_by_its_gain() {
        let pole = Complex::new(-0.01, 0.2);
        for block in [1, 2, 7, 20] {
            let sum = (0..block).fold(Complex::new(0.0, 0.0), |sum, k| {
                let (sin, cos) = (pole.im * k as f64).sin_cos();
                sum + Complex::new(cos, sin) * (pole.re * k as f64).exp()
            });
            // Roundings of a sum of twenty.
            assert!((block_gain(pole, block) - sum.norm() / block as f64).abs() < 1e-13);
        }
    }

    #[test]
    fn white_noise_has_no_colour_and_slow_noise_has() {
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let white: Vec<f64> = (0..4000).map(|_| uniform()).collect();
        // The mean of two dozen squares that have a deviation as large as their mean, some of them correlated.
        assert!(colour(&white, 0.1) < 2.5);
        let slow: Vec<f64> = white.windows(20).map(|w| w.iter().sum::<f64>() / 20.0).collect();
        // An average of twenty keeps all of the density below 0.1 and a twentieth of the power.
        assert!(colour(&slow, 0.05) > 6.0);
        // Its correlation falls in a straight line over twenty samples.
        assert!(correlation(&white) < 1.3 && (12.0..28.0).contains(&correlation(&slow)));
    }

    #[test]
    fn the_swing_ends_where_the_noise_begins() {
        let values: Vec<f64> = (0..1000).map(|n| 5.0 + (-0.02 * f64::from(n)).exp()).collect();
        let (length, swing) = swinging(&values, 0.01);
        // ln(100) / 0.02 = 230 samples and an eighth more.
        assert!((270..=280).contains(&length), "{length}");
        assert!((swing - 1.0).abs() < 1e-6);
        assert_eq!(swinging(&[1.0; 100], 0.1).0, 0);
        // Noise beyond the threshold in a long rest does not count but on top of the swing, up to sample 300; a swing that
        // hardly decays does.
        let noisy: Vec<f64> =
            values.iter().enumerate().map(|(n, y)| y + 0.02 * f64::from(u8::from(n % 50 == 0))).collect();
        assert!((200..=360).contains(&swinging(&noisy, 0.01).0));
        let lasting: Vec<f64> = (0..1000).map(|n| (0.1 * f64::from(n)).cos()).collect();
        assert_eq!(swinging(&lasting, 0.01).0, 1000);
    }
}
