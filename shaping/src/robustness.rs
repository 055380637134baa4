//! What a train leaves of modes that are not what they were thought to be, and what it costs.

use profiles::{Complex, Interval, Mode, Real, complex};

use crate::mode_range::ModeRange;
use crate::train::ImpulseTrain;

/// How far a certified bound may lie above what is attained.
const GAP: f64 = 1e-9;
/// Boxes looked at before a bound is given as it is.
const MOST_BOXES: usize = 200_000;
/// Boxes that wait: halving the longer side in turn, more are never needed.
const WAITING: usize = 128;

/// The most that a train leaves of the vibration of a step, over a range of modes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WorstCase {
    /// Left of this mode, the worst found.
    pub residual: f64,
    /// The mode.
    pub mode: Mode,
    /// Certified: no mode of the range is left with more. At most 1e-9 above `residual`, unless the train is so long that
    /// the range holds thousands of its lobes.
    pub bound: f64,
}

/// What a train does to a mode and to a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Robustness {
    /// Left of the mode itself, as a part of what a step leaves.
    pub residual: f64,
    /// Range of frequency errors within which no more than the tolerance is left, see
    /// [`ImpulseTrain::insensitivity`].
    pub insensitivity: Option<Interval>,
    /// The most that is left over the range of modes.
    pub worst_case: WorstCase,
    /// The largest vibration of the mode on the way, as a part of what a step leaves.
    pub transient: f64,
    /// The most by which acceleration and jerk of a command are multiplied.
    pub demand: f64,
    /// Range of a unit step through the train.
    pub step: Interval,
    /// Time added to a move, s.
    pub duration: f64,
    /// Mean delay, s.
    pub mean_delay: f64,
}

impl<const N: usize> ImpulseTrain<N> {
    /// Sum of the magnitudes of the amplitudes, one for positive trains: the most by which the train multiplies any
    /// derivative of a command.
    #[must_use]
    pub fn demand(&self) -> f64 {
        self.impulses().iter().map(|impulse| impulse.amplitude.abs()).sum()
    }

    /// Range of a unit step through the train: 0 to 1 for positive ones.
    #[must_use]
    pub fn step_range(&self) -> Interval {
        let mut sum = 0.0;
        let mut range = Interval::new(0.0, 1.0);
        for impulse in self.impulses() {
            sum += impulse.amplitude;
            range = Interval::new(range.lower.min(sum), range.upper.max(sum));
        }
        // The last sum is one but for rounding.
        let roundings = self.impulses().len() as f64 * f64::EPSILON * self.demand();
        let exact = |end: f64, value: f64| if (end - value).abs() <= roundings { value } else { end };
        Interval::new(exact(range.lower, 0.0), exact(range.upper, 1.0))
    }

    /// The largest vibration of a mode while a step goes through the train, as a part of what the step alone leaves: a
    /// train that ends without vibration may pass through a large one.
    #[must_use]
    pub fn transient(&self, mode: Mode) -> f64 {
        let pole = mode.pole();
        // Free vibration only dies down: it is largest just after an impulse.
        let mut largest = 0.0_f64;
        let mut vibration = Complex::new(0.0, 0.0);
        let mut now = 0.0;
        for impulse in self.impulses() {
            vibration = vibration * complex::exp(pole * (impulse.time - now)) + impulse.amplitude;
            now = impulse.time;
            largest = largest.max(complex::norm(vibration));
        }
        largest
    }

    /// The most that is left of any mode of a range, with a bound that holds between all samples.
    ///
    /// The range is halved where need be. In a box about the pole `p_c` the response `F` is within
    /// `M (p - p_c)^2 / 2` of its tangent, `M = sum of |A| (T - t)^2 e^(s (T - t))` with `s` the largest `Re p`, and the
    /// tangent is largest at a corner; boxes whose bound is no more than what has been found are done.
    ///
    /// ```
    /// use profiles::Mode;
    /// use shaping::{ImpulseTrain, ModeRange, Shaper};
    ///
    /// let mode = Mode::from_hz(40.0, 0.1)?;
    /// let zvd: ImpulseTrain<3> = Shaper::ZVD.train(mode)?;
    /// let worst = zvd.worst_case(&ModeRange::around(mode, 0.1, 0.05)?);
    /// assert!(worst.residual <= worst.bound && worst.bound < worst.residual + 1.1e-9);
    /// // 10 % too fast and with half the damping
    /// assert!((worst.residual - 0.0259).abs() < 1e-4 && worst.mode.hz() > 43.99);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn worst_case(&self, range: &ModeRange) -> WorstCase {
        let whole = Patch::of(range);
        let mut found = Found::new(self, range);
        let mut waiting = [whole; WAITING];
        let mut len = 1_usize;
        let mut bound = 0.0_f64;
        for _ in 0..MOST_BOXES {
            let Some(patch) = len.checked_sub(1).and_then(|last| waiting.get(last).copied()) else { break };
            len -= 1;
            let above = patch.bound(&mut found);
            match (above > found.residual + GAP, waiting.get_mut(len..len + 2)) {
                (true, Some([first, second])) => {
                    (*first, *second) = patch.halves();
                    len += 2;
                }
                _ => bound = bound.max(above),
            }
        }
        for patch in waiting.iter().take(len) {
            bound = bound.max(patch.bound(&mut found));
        }
        let Found { residual, mode, .. } = found;
        WorstCase { residual, mode, bound: bound.max(residual) }
    }

    /// Everything about the train that a choice between trains needs: for `mode`, for the modes of `range` that it may turn
    /// out to be, and with `tolerance` as the vibration that counts as none (0.05 is customary).
    #[must_use]
    pub fn robustness(&self, mode: Mode, range: &ModeRange, tolerance: f64) -> Robustness {
        Robustness {
            residual: self.residual(mode),
            insensitivity: self.insensitivity(mode, tolerance),
            worst_case: self.worst_case(range),
            transient: self.transient(mode),
            demand: self.demand(),
            step: self.step_range(),
            duration: self.duration(),
            mean_delay: self.mean_delay(),
        }
    }
}

/// The worst mode found so far.
struct Found<'a, const N: usize> {
    train: &'a ImpulseTrain<N>,
    frequency: Interval,
    damping: Interval,
    residual: f64,
    mode: Mode,
}

impl<'a, const N: usize> Found<'a, N> {
    /// The worse of two corners.
    fn new(train: &'a ImpulseTrain<N>, range: &ModeRange) -> Self {
        let (residual, mode) = (train.residual(range.lowest()), range.lowest());
        let (frequency, damping) = (range.angular_frequency(), range.damping_ratio());
        let mut found = Self { train, frequency, damping, residual, mode };
        found.look(frequency.upper, Real::atan2(damping.upper, range.highest().pole().im / frequency.upper));
        found
    }

    /// Takes the mode of frequency `w` whose damping ratio is the sine of `angle`, if it is worse.
    fn look(&mut self, w: f64, angle: f64) {
        // Rounding must not leave the range.
        let w = w.clamped(self.frequency.lower, self.frequency.upper);
        let z = Real::sin(angle).clamped(self.damping.lower, self.damping.upper);
        if let Ok(mode) = Mode::new(w, z) {
            let residual = self.train.residual(mode);
            if residual > self.residual {
                (self.residual, self.mode) = (residual, mode);
            }
        }
    }
}

/// Modes about one of them, in polar coordinates of the pole: `p = w i e^(i angle)`, the sine of the angle being the
/// damping ratio.
#[derive(Debug, Clone, Copy)]
struct Patch {
    w: f64,
    half_width: f64,
    angle: f64,
    half_angle: f64,
}

impl Patch {
    fn of(range: &ModeRange) -> Self {
        let (low, high) = (range.lowest(), range.highest());
        let angle = |mode: Mode| Real::atan2(-mode.pole().re, mode.pole().im);
        let (w0, w1) = (low.angular_frequency(), high.angular_frequency());
        Self {
            w: 0.5 * (w0 + w1),
            half_width: 0.5 * (w1 - w0),
            angle: 0.5 * (angle(low) + angle(high)),
            half_angle: 0.5 * (angle(high) - angle(low)),
        }
    }

    fn halves(self) -> (Self, Self) {
        if self.half_width > self.w * self.half_angle {
            let half = 0.5 * self.half_width;
            let at = |w: f64| Self { w, half_width: half, ..self };
            (at(self.w - half), at(self.w + half))
        } else {
            let half = 0.5 * self.half_angle;
            let at = |angle: f64| Self { angle, half_angle: half, ..self };
            (at(self.angle - half), at(self.angle + half))
        }
    }

    /// No mode of the patch is left with more; what is left of its middle and of its worst corner is looked at.
    fn bound<const N: usize>(self, found: &mut Found<'_, N>) -> f64 {
        let Self { w, half_width, angle, half_angle } = self;
        let (sine, cosine) = Real::sin_cos(angle);
        let outward = Complex::new(-sine, cosine);
        let p = outward * w;
        // The largest real part of the patch, by its least damped and slowest corner.
        let right = -(w - half_width).max(0.0) * Real::sin((angle - half_angle).max(0.0));
        let end = found.train.duration();
        let (mut value, mut slope) = (Complex::new(0.0, 0.0), Complex::new(0.0, 0.0));
        let (mut bend, mut size) = (0.0, 0.0);
        for impulse in found.train.impulses() {
            let left = end - impulse.time;
            let share = complex::exp(p * left) * impulse.amplitude;
            value += share;
            slope += share * left;
            let magnitude = impulse.amplitude.abs() * Real::exp(right * left);
            bend += magnitude * left * left;
            size += magnitude;
        }
        // The tangent at the four corners.
        let along = slope * outward * half_width;
        let across = slope * Complex::new(-cosine, -sine) * (w * half_angle);
        let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
        let mut tangent = (0.0, 0.0, 0.0);
        for (i, j) in corners {
            let there = complex::norm(value + along * i + across * j);
            if there > tangent.0 {
                tangent = (there, i, j);
            }
        }
        let (there, i, j) = tangent;
        found.look(w + i * half_width, angle + j * half_angle);
        // What the polar coordinates and the response have beyond first order, and the rounding of phase and sum.
        let curl = half_width * half_angle + 0.5 * (w + half_width) * half_angle * half_angle;
        let reach = half_width + w * half_angle;
        let rounding = 4.0 * f64::EPSILON * size * (2.0 + w * end);
        // Nothing is larger than its terms.
        (there + complex::norm(slope) * curl + 0.5 * bend * reach * reach).min(size) + rounding
    }
}
