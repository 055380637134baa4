//! Trains of impulses.

use core::f64::consts::TAU;

use profiles::{Complex, Interval, Mode, Real, complex};

use crate::error::TrainError;

/// One impulse of a train.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Impulse {
    /// Time, s.
    pub time: f64,
    /// Share of the command, without unit.
    pub amplitude: f64,
}

impl Impulse {
    /// An impulse of `amplitude` at `time` in s.
    #[must_use]
    pub const fn new(time: f64, amplitude: f64) -> Self {
        Self { time, amplitude }
    }
}

/// A train of at most `N` impulses whose amplitudes add up to one: a command convolved with it ends where it would.
///
/// ```
/// use shaping::{Impulse, ImpulseTrain};
///
/// // Zero vibration for an undamped mode of 40 Hz: two halves, half a period apart.
/// let mode = profiles::Mode::from_hz(40.0, 0.0)?;
/// let train = ImpulseTrain::<2>::new(&[Impulse::new(0.0, 0.5), Impulse::new(0.0125, 0.5)])?;
/// assert!(train.residual(mode) < 1e-15);
/// assert!(train.sensitivity(mode, 0.1) > 0.15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpulseTrain<const N: usize> {
    impulses: [Impulse; N],
    len: usize,
}

impl<const N: usize> ImpulseTrain<N> {
    /// A train from impulses in order of time, scaled so that the amplitudes add up to one.
    ///
    /// # Errors
    /// No impulse or more than `N`, an amplitude that is not finite, a time that is negative, not finite or before the
    /// one ahead, or amplitudes whose sum is zero or has no inverse.
    pub fn new(impulses: &[Impulse]) -> Result<Self, TrainError> {
        if impulses.is_empty() {
            return Err(TrainError::Empty);
        }
        if impulses.len() > N {
            return Err(TrainError::Capacity { needed: impulses.len(), capacity: N });
        }
        let mut earliest = 0.0;
        let mut sum = 0.0;
        for (index, Impulse { time, amplitude }) in impulses.iter().enumerate() {
            if !amplitude.is_finite() {
                return Err(TrainError::Amplitude { index, value: *amplitude });
            }
            if !(*time >= earliest && time.is_finite()) {
                return Err(TrainError::Time { index, value: *time, earliest });
            }
            earliest = *time;
            sum += amplitude;
        }
        let mut train = Self { impulses: [Impulse::default(); N], len: impulses.len() };
        for (place, Impulse { time, amplitude }) in train.impulses.iter_mut().zip(impulses) {
            *place = Impulse::new(*time, amplitude / sum);
            if !place.amplitude.is_finite() {
                return Err(TrainError::Sum(sum));
            }
        }
        Ok(train)
    }

    /// The impulses, in order of time.
    #[must_use]
    pub fn impulses(&self) -> &[Impulse] {
        self.impulses.get(..self.len).unwrap_or(&[])
    }

    /// Time of the last impulse, s: how much longer a shaped command takes.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.impulses().last().map_or(0.0, |impulse| impulse.time)
    }

    /// Mean delay of a shaped command, `sum of A_k t_k`, s: that of a ramp once the last impulse has acted.
    #[must_use]
    pub fn mean_delay(&self) -> f64 {
        self.impulses().iter().map(|impulse| impulse.amplitude * impulse.time).sum()
    }

    /// Both trains, one after the other: the convolution, which has the zeros of both. Impulses at the same time (to
    /// four roundings) become one.
    ///
    /// # Errors
    /// More impulses than `K`, or amplitudes whose sum is zero.
    pub fn convolved<const M: usize, const K: usize>(
        &self,
        other: &ImpulseTrain<M>,
    ) -> Result<ImpulseTrain<K>, TrainError> {
        let mut product = [Impulse::default(); K];
        let mut len = 0;
        let same = 4.0 * f64::EPSILON * (self.duration() + other.duration());
        for first in self.impulses() {
            for second in other.impulses() {
                let time = first.time + second.time;
                let amplitude = first.amplitude * second.amplitude;
                let kept = product.get_mut(..len).unwrap_or_default();
                if let Some(equal) = kept.iter_mut().find(|kept| (kept.time - time).abs() <= same) {
                    equal.amplitude += amplitude;
                    continue;
                }
                let after = kept.iter().filter(|kept| kept.time <= time).count();
                len += 1;
                match product.get_mut(after..len) {
                    Some(shifted) => {
                        shifted.rotate_right(1);
                        if let Some(place) = shifted.first_mut() {
                            *place = Impulse { time, amplitude };
                        }
                    }
                    None => {
                        let needed = self.len * other.len;
                        return Err(TrainError::Capacity { needed, capacity: K });
                    }
                }
            }
        }
        ImpulseTrain::new(product.get(..len).unwrap_or_default())
    }

    /// The Laplace transform, `sum of A_k e^(-s t_k)`: bounded for `Re s >= 0`. Far to the left of that it overflows, where
    /// [`response`](Self::response) does not.
    #[must_use]
    pub fn transform(&self, s: Complex<f64>) -> Complex<f64> {
        self.sum(|time| -s * time)
    }

    /// The response of a pole `p` at the end of the train, `sum of A_k e^(p (T - t_k))`: bounded for `Re p <= 0`, and
    /// the factor by which the train multiplies [`Profile::response`](profiles::Profile::response).
    #[must_use]
    pub fn response(&self, p: Complex<f64>) -> Complex<f64> {
        let end = self.duration();
        self.sum(|time| p * (end - time))
    }

    /// Vibration that a step through the train leaves in a mode at the end of the train, as a part of what the step
    /// alone leaves: `V = |response(p)|`.
    ///
    /// # References
    /// N. C. Singer, W. P. Seering, Preshaping command inputs to reduce system vibration, Journal of Dynamic Systems,
    /// Measurement, and Control 112 (1990) 76-82, [doi:10.1115/1.2894142](https://doi.org/10.1115/1.2894142).
    #[must_use]
    pub fn residual(&self, mode: Mode) -> f64 {
        complex::norm(self.response(mode.pole()))
    }

    /// [`residual`](Self::residual) of a mode whose frequency is off by the part `frequency_error` of it, with the same
    /// damping ratio. An error below -1, which is no frequency, counts as -1.
    #[must_use]
    pub fn sensitivity(&self, mode: Mode, frequency_error: f64) -> f64 {
        complex::norm(self.response(mode.pole() * Real::max(1.0 + frequency_error, 0.0)))
    }

    /// The insensitivity of the train: the range of frequency errors around zero, as parts of the frequency of `mode`,
    /// in which no more than `tolerance` of the vibration of a step is left.
    ///
    /// A hundred turns of the last impulse are searched either way. The lower end is at least -1, where the frequency is
    /// zero, and the end of the search if nothing up to there leaves more; the upper end is then infinite. `None` if the
    /// train leaves more than `tolerance` of the mode itself, or the tolerance is NaN.
    ///
    /// ```
    /// use profiles::Mode;
    /// use shaping::DelayFilter;
    ///
    /// // The ZVD shaper keeps below 5 % over 28.7 % of the frequency.
    /// let mode = Mode::from_hz(40.0, 0.0)?;
    /// let band = DelayFilter::zvd(mode)?.train().insensitivity(mode, 0.05).ok_or("not at rest")?;
    /// assert!((band.upper - band.lower - 0.287).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn insensitivity(&self, mode: Mode, tolerance: f64) -> Option<Interval> {
        let within = |error: f64| self.sensitivity(mode, error) <= tolerance;
        if !within(0.0) {
            return None;
        }
        // Steps of 1/64 turn of the last impulse: a lobe of the sensitivity is no narrower than about half a turn.
        let turns = mode.damped_angular_frequency() * self.duration() / TAU;
        let step = 1.0 / (64.0 * turns.max(1.0));
        let end = |outward: f64, most: f64| {
            let mut inside = 0.0;
            while inside < most {
                let next = (inside + step).min(most);
                if !within(outward * next) {
                    return Some(outward * last_within(|error| within(outward * error), inside, next));
                }
                inside = next;
            }
            None
        };
        let searched = 100.0 / turns.max(1.0);
        let lowest = searched.min(1.0);
        let upper = end(1.0, searched).unwrap_or(f64::INFINITY);
        Some(Interval::new(end(-1.0, lowest).unwrap_or(-lowest), upper))
    }

    fn sum(&self, exponent: impl Fn(f64) -> Complex<f64>) -> Complex<f64> {
        let terms =
            self.impulses().iter().map(|impulse| complex::exp(exponent(impulse.time)) * impulse.amplitude);
        terms.fold(Complex::new(0.0, 0.0), |sum, term| sum + term)
    }
}

/// The last place between `inside` and `outside` that is `within`, to the last bit.
fn last_within(within: impl Fn(f64) -> bool, mut inside: f64, mut outside: f64) -> f64 {
    loop {
        let middle = 0.5 * (inside + outside);
        if middle <= inside || middle >= outside {
            return inside;
        }
        if within(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
}
