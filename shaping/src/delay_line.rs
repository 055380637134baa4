//! A train on a fixed clock.

use profiles::{Mode, Real};

use crate::error::DelayLineError;
use crate::train::ImpulseTrain;

/// One weighted look into the past.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Tap<F> {
    delay: usize,
    weight: F,
}

/// An impulse train as a filter that runs once a sample, with room for `K` taps and `N` samples of history.
///
/// An impulse of amplitude `A` that falls between two samples, `f` of a period `h` after the first, is split in two:
///
/// `a = A e^(z w f h) sin(w_d (1 - f) h) / sin(w_d h)`, `b = A e^(-z w (1 - f) h) sin(w_d f h) / sin(w_d h)`
///
/// which together are to the mode `(w, z)` exactly what the one impulse was: `a + b e^(-p h) = A e^(-p f h)`. The zeros of
/// the train on that mode survive any rate above twice the damped frequency. The taps are then scaled to add up to one.
///
/// ```
/// use profiles::Mode;
/// use shaping::{DelayFilter, DelayLine, DelayLineState};
///
/// let mode = Mode::from_hz(40.0, 0.02)?;
/// let filter = DelayFilter::positive(mode, 0.0101)?; // 10.1 samples
/// let line = DelayLine::<f32, 6, 32>::new(filter.train(), mode, 1e-3)?;
/// let mut axis = DelayLineState::at_rest(0.0);
/// let mut output = 0.0;
/// for _ in 0..22 {
///     output = line.update(&mut axis, 1.0).output;
/// }
/// assert!((output - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DelayLine<F, const K: usize, const N: usize> {
    taps: [Tap<F>; K],
    len: usize,
}

/// The memory of one delay line: the last `N` inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DelayLineState<F, const N: usize> {
    history: [F; N],
    newest: usize,
}

/// What a delay line answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DelayLineOutput<F> {
    /// The shaped command, in the unit of the input; always finite for inputs up to half the largest number over the
    /// sum of the tap magnitudes.
    pub output: F,
    /// How it came about.
    pub status: Status,
}

/// How an output came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Status {
    /// The input was taken.
    Regular,
    /// The input was not finite; the one before it was taken in its place.
    Held,
}

impl<F: Real, const K: usize, const N: usize> DelayLine<F, K, N> {
    /// The train sampled every `period` s, its zeros on `mode` kept.
    ///
    /// # Errors
    /// A period that is not positive and finite or not below half the damped period of the mode, a train that reaches
    /// back beyond `N` samples or needs more than `K` taps, or taps that add up to nothing.
    pub fn new<const M: usize>(
        train: &ImpulseTrain<M>,
        mode: Mode,
        period: f64,
    ) -> Result<Self, DelayLineError> {
        if !(period > 0.0 && period.is_finite()) {
            return Err(DelayLineError::Period(period));
        }
        let damped_period = mode.damped_period();
        if period >= 0.5 * damped_period {
            return Err(DelayLineError::Undersampled { period, damped_period });
        }
        let pole = mode.pole();
        let turn = pole.im * period;
        let mut exact = [Tap { delay: 0, weight: 0.0 }; K];
        let mut len = 0;
        let mut put = |delay: f64, weight: f64| {
            if delay >= N as f64 {
                return Err(DelayLineError::History { needed: delay + 1.0, capacity: N });
            }
            let tap = exact.get_mut(len).ok_or(DelayLineError::Taps { capacity: K })?;
            *tap = Tap { delay: delay as usize, weight };
            len += 1;
            Ok(())
        };
        for impulse in train.impulses() {
            let samples = impulse.time / period;
            let nearest = Real::round(samples);
            // What the quotient of a delay of whole samples and the period may be rounded by.
            if (samples - nearest).abs() <= 4.0 * f64::EPSILON * nearest {
                put(nearest, impulse.amplitude)?;
                continue;
            }
            let whole = Real::floor(samples);
            let part = samples - whole;
            let spread = impulse.amplitude / Real::sin(turn);
            put(whole, spread * Real::exp(-pole.re * part * period) * Real::sin((1.0 - part) * turn))?;
            put(whole + 1.0, spread * Real::exp(pole.re * (1.0 - part) * period) * Real::sin(part * turn))?;
        }
        let sum: f64 = exact.iter().map(|tap| tap.weight).sum();
        if !(1.0 / sum).is_finite() {
            return Err(DelayLineError::Sum(sum));
        }
        Ok(Self {
            taps: exact.map(|tap| Tap { delay: tap.delay, weight: F::from_f64(tap.weight / sum) }),
            len,
        })
    }

    /// One sample: takes the input and gives the shaped command.
    ///
    /// An input that is not finite counts as the one before it, so that what is already on its way keeps its time.
    #[inline]
    pub fn update(&self, state: &mut DelayLineState<F, N>, input: F) -> DelayLineOutput<F> {
        let status = if input.is_finite() { Status::Regular } else { Status::Held };
        let input = if input.is_finite() { input } else { state.before(0) };
        state.take(input);
        let mut output = F::ZERO;
        for tap in self.taps.iter().take(self.len) {
            output += tap.weight * state.before(tap.delay);
        }
        DelayLineOutput { output, status }
    }

    /// The taps in use: delay in samples and weight. They add up to one, to the rounding of `F`.
    pub fn taps(&self) -> impl Iterator<Item = (usize, F)> + '_ {
        self.taps.iter().take(self.len).map(|tap| (tap.delay, tap.weight))
    }
}

impl<F: Real, const N: usize> DelayLineState<F, N> {
    /// A memory in which the input has always been `value` (zero if that is not finite).
    #[must_use]
    pub fn at_rest(value: F) -> Self {
        const { assert!(N > 0, "a delay line remembers at least one sample") };
        Self { history: [if value.is_finite() { value } else { F::ZERO }; N], newest: 0 }
    }

    #[inline]
    fn take(&mut self, input: F) {
        self.newest = if self.newest + 1 < N { self.newest + 1 } else { 0 };
        if let Some(place) = self.history.get_mut(self.newest) {
            *place = input;
        }
    }

    /// The input `delay` samples ago, `delay < N`.
    #[inline]
    fn before(&self, delay: usize) -> F {
        let place = if self.newest >= delay { self.newest - delay } else { self.newest + N - delay };
        self.history.get(place).copied().unwrap_or(F::ZERO)
    }
}
