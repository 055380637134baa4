//! Equally spaced impulses by the zeros that they place.

use core::f64::consts::{PI, TAU};

use profiles::{Mode, Real};

use crate::error::{ShaperError, TrainError};
use crate::train::{Impulse, ImpulseTrain};

/// The polynomial `sum of c_i x^i` in the delay `x = e^(-s T)`, built zero by zero, and its value at `x = 1`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spaced<const N: usize> {
    coefficients: [f64; N],
    degree: usize,
    sum: f64,
}

impl<const N: usize> Spaced<N> {
    /// The polynomial 1.
    pub(crate) fn one() -> Self {
        let mut coefficients = [0.0; N];
        if let Some(first) = coefficients.first_mut() {
            *first = 1.0;
        }
        Self { coefficients, degree: 0, sum: 1.0 }
    }

    /// With the zero of half a turn, times `1 + decay x`.
    pub(crate) fn with_half_turn(self, decay: f64) -> Self {
        self.times(decay, 0.0, 1, 1.0 + decay)
    }

    /// With the zeros of a pole pair that turns by `angle` in rad and shrinks to `decay` within one delay, times
    /// `1 - 2 decay cos(angle) x + decay^2 x^2`.
    pub(crate) fn with_pair(self, decay: f64, angle: f64) -> Self {
        let (sine, cosine) = Real::sin_cos(angle);
        // |1 - decay e^(i angle)|^2 as a sum of squares: the three coefficients cancel near whole turns.
        let (re, im) = (1.0 - decay * cosine, decay * sine);
        self.times(-2.0 * decay * cosine, decay * decay, 2, re * re + im * im)
    }

    /// Times `1 + first x + second x^2`, which adds up to `sum`; what leaves the array is dropped.
    fn times(mut self, first: f64, second: f64, degree: usize, sum: f64) -> Self {
        let (mut last, mut before) = (0.0, 0.0);
        for c in &mut self.coefficients {
            let old = *c;
            *c = old + first * last + second * before;
            (before, last) = (last, old);
        }
        self.degree += degree;
        self.sum *= sum;
        self
    }

    /// The largest magnitude among the amplitudes.
    pub(crate) fn largest(&self) -> f64 {
        self.coefficients.iter().fold(0.0_f64, |largest, c| largest.max(c.abs())) / self.sum
    }

    /// The impulses, `delay` s apart.
    ///
    /// # Errors
    /// More impulses than `N`, or numbers that leave the range of double precision.
    pub(crate) fn train(&self, delay: f64) -> Result<ImpulseTrain<N>, TrainError> {
        let needed = self.degree + 1;
        let Some(coefficients) = self.coefficients.get(..needed) else {
            return Err(TrainError::Capacity { needed, capacity: N });
        };
        let mut impulses = [Impulse::default(); N];
        let mut turn = 0.0;
        for (impulse, c) in impulses.iter_mut().zip(coefficients) {
            *impulse = Impulse::new(turn * delay, c / self.sum);
            turn += 1.0;
        }
        ImpulseTrain::new(impulses.get(..needed).unwrap_or_default())
    }

    /// The amplitudes are not negative; a rounding of the largest counts as zero and becomes it.
    fn made_positive(mut self) -> Option<Self> {
        let rounding = 4.0 * f64::EPSILON * self.largest() * self.sum;
        for c in &mut self.coefficients {
            if *c < -rounding {
                return None;
            }
            *c = c.max(0.0);
        }
        Some(self)
    }
}

/// A number of impulses, or why there is none; what needs more than `capacity` is not worth building.
fn within(needed: usize, capacity: usize) -> Result<usize, TrainError> {
    if needed <= capacity { Ok(needed) } else { Err(TrainError::Capacity { needed, capacity }) }
}

/// `order + 1` impulses half a damped period apart with a zero of that order on the mode.
pub(super) fn zero_vibration<const N: usize>(
    mode: Mode,
    order: usize,
) -> Result<ImpulseTrain<N>, ShaperError> {
    if order == 0 {
        return Err(ShaperError::Order { order, most: N.saturating_sub(1) });
    }
    within(order.saturating_add(1), N)?;
    let pole = mode.pole();
    let delay = PI / pole.im;
    let decay = Real::exp(pole.re * delay);
    let train = (0..order).fold(Spaced::one(), |train, _| train.with_half_turn(decay));
    Ok(train.train(delay)?)
}

/// `impulses` over `span` damped periods, with zeros spread evenly from the mode to its mirror image.
pub(super) fn equally_spaced<const N: usize>(
    mode: Mode,
    impulses: usize,
    span: f64,
) -> Result<ImpulseTrain<N>, ShaperError> {
    if impulses < 3 {
        return Err(ShaperError::Impulses { impulses, least: 3 });
    }
    let intervals = within(impulses, N)? - 1;
    let most = 0.5 * intervals as f64;
    if !(span > 0.0 && span <= most) {
        return Err(ShaperError::Span { span, most });
    }
    let turns = span / intervals as f64;
    let pole = mode.pole();
    let delay = turns * (TAU / pole.im);
    let decay = Real::exp(pole.re * delay);
    // Zeros from one turn of the mode, `angle`, to a whole turn less that; the one in the middle has no partner.
    let angle = TAU * turns;
    let apart = 2.0 * (PI - angle) / (intervals - 1) as f64;
    let mut train = Spaced::one();
    for pair in 0..intervals / 2 {
        train = train.with_pair(decay, angle + apart * pair as f64);
    }
    if intervals % 2 == 1 {
        train = train.with_half_turn(decay);
    }
    let positive = train.made_positive().ok_or(ShaperError::Negative { impulses, span })?;
    Ok(positive.train(delay)?)
}
