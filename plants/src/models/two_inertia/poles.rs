//! Where a two-inertia axis vibrates.

use nalgebra::Complex;
use profiles::{Mode, Real};

use super::TwoInertia;
use crate::error::ModelError;

impl TwoInertia {
    /// The undamped resonance, rad/s: `sqrt(K (1 / J_m + 1 / J_l))`, at which both ends vibrate against each other.
    #[must_use]
    pub fn resonance(&self) -> f64 {
        Real::sqrt(self.squared_resonance())
    }

    /// The undamped anti-resonance, rad/s: `sqrt(K / J_l)`, at which the load vibrates on a motor that stands still.
    #[must_use]
    pub fn anti_resonance(&self) -> f64 {
        Real::sqrt(self.stiffness * self.per_load_inertia)
    }

    /// The vibration of the load on a motor that is held: `J_l s^2 + (c_s + c_l) s + K = 0`.
    ///
    /// A stiff position loop around the motor comes close to it.
    ///
    /// # Errors
    /// A load so damped that it does not vibrate, with its damping ratio.
    pub fn held_mode(&self) -> Result<Mode, ModelError> {
        let frequency = self.anti_resonance();
        let rate = (self.spring_damping + self.load_damping) * self.per_load_inertia;
        Ok(Mode::new(frequency, 0.5 * rate / frequency)?)
    }

    /// The vibration of both ends against each other with no torque on the motor: the conjugate pair of
    /// [`poles`](Self::poles).
    ///
    /// # Errors
    /// An axis so damped that it does not vibrate, with its damping ratio.
    pub fn free_mode(&self) -> Result<Mode, ModelError> {
        let (_, pair) = self.factors();
        let frequency = Real::sqrt(pair.product);
        Ok(Mode::new(frequency * self.resonance(), 0.5 * pair.sum / frequency)?)
    }

    /// The four poles of the axis in rad/s, the roots of
    ///
    /// `s (J_m J_l s^3 + (J_m (c_l + c_s) + J_l (c_m + c_s)) s^2 + (K (J_m + J_l) + c_m c_l + c_m c_s + c_l c_s) s
    /// + K (c_m + c_l))`
    ///
    /// The first is the zero of the free rotation, the second real; the last two are the vibration, where there is
    /// one, the one with positive imaginary part first.
    #[must_use]
    pub fn poles(&self) -> [Complex<f64>; 4] {
        let (rate, pair) = self.factors();
        let [first, second] = pair.roots();
        [Complex::new(0.0, 0.0), Complex::new(-rate, 0.0), first, second].map(|root| root * self.resonance())
    }

    /// The cubic over `J_m J_l`, in units of the resonance: `(s + rate) (s^2 + sum s + product)`.
    fn factors(&self) -> (f64, Pair) {
        let w = self.resonance();
        let (m, l) = (self.per_motor_inertia / w, self.per_load_inertia / w);
        let (motor, spring, load) = (self.motor_damping, self.spring_damping, self.load_damping);
        let quadratic = (motor + spring) * m + (load + spring) * l;
        let linear = 1.0 + motor * m * (load * l) + motor * m * (spring * l) + load * l * (spring * m);
        let constant = self.stiffness / w * m * (motor * l) + self.stiffness / w * l * (load * m);
        let rate = root(quadratic, linear, constant);
        // From the end of the cubic at which nothing cancels.
        let pair = if rate * rate * rate <= constant || rate <= 0.0 {
            let sum = Real::max(quadratic - rate, 0.0);
            Pair { sum, product: if rate > 0.0 { constant / rate } else { linear } }
        } else {
            let product = constant / rate;
            Pair { sum: Real::max((linear - product) / rate, 0.0), product }
        };
        (rate, pair)
    }
}

// Bisection alone settles a double in some hundred steps, a subnormal in a thousand.
const MOST_STEPS: u32 = 1200;

/// `s^2 + sum s + product`, neither negative.
struct Pair {
    sum: f64,
    product: f64,
}

impl Pair {
    fn roots(&self) -> [Complex<f64>; 2] {
        let half = 0.5 * self.sum;
        let discriminant = half * half - self.product;
        if discriminant < 0.0 {
            let imaginary = Real::sqrt(-discriminant);
            return [Complex::new(-half, imaginary), Complex::new(-half, -imaginary)];
        }
        let fast = half + Real::sqrt(discriminant);
        [Complex::new(-fast, 0.0), Complex::new(if fast > 0.0 { -self.product / fast } else { 0.0 }, 0.0)]
    }
}

/// A root `rate` in `[0, a]` of `rate^3 - a rate^2 + b rate - c`, of a passive axis: `a b >= c >= 0`, `b >= 1`.
fn root(a: f64, b: f64, c: f64) -> f64 {
    if c <= 0.0 {
        return 0.0;
    }
    let (mut below, mut above) = (0.0, a);
    // The slow pole of a stiff axis, next to which Newton's method starts.
    let mut rate = Real::clamped(c / b, 0.0, a);
    for _ in 0..MOST_STEPS {
        let value = ((rate - a) * rate + b) * rate - c;
        let newton = rate - value / ((3.0 * rate - 2.0 * a) * rate + b);
        if (newton - rate).abs() <= f64::EPSILON * rate {
            return newton;
        }
        if value > 0.0 {
            above = rate;
        } else {
            below = rate;
        }
        // Bisection where Newton's method leaves the bounds.
        rate = if newton > below && newton < above { newton } else { 0.5 * (below + above) };
    }
    rate
}
