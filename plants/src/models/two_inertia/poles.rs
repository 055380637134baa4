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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn axis(inertias: [f64; 2], stiffness: f64, damping: [f64; 3]) -> TwoInertia {
        TwoInertia::new(inertias[0], inertias[1], stiffness)
            .and_then(|axis| axis.with_damping(damping[0], damping[1], damping[2]))
            .expect("valid")
    }

    /// The largest distance from a pole to its nearest in `others`, each taken once.
    fn apart(poles: [Complex<f64>; 4], others: [Complex<f64>; 4]) -> f64 {
        let mut left = others.to_vec();
        poles.iter().fold(0.0, |worst: f64, pole| {
            let nearest = (0..left.len())
                .min_by(|&i, &j| (left[i] - pole).norm().total_cmp(&(left[j] - pole).norm()))
                .expect("one for each");
            worst.max((left.swap_remove(nearest) - pole).norm())
        })
    }

    fn log(low: f64, high: f64) -> impl Strategy<Value = f64> {
        (low..high).prop_map(|exponent| 10.0_f64.powf(exponent))
    }

    proptest! {
        #[test]
        fn poles_are_the_eigenvalues(
            motor in log(-4.0, -2.0), load in log(-4.0, -2.0), stiffness in log(0.0, 5.0),
            ratios in [0.01..0.4, 0.01..0.4, 0.01..0.4]
        ) {
            let scale = (stiffness * motor.min(load)).sqrt();
            let axis = axis([motor, load], stiffness, ratios.map(|ratio| ratio * scale));
            let values = axis.state_space().and_then(|s| s.poles()).expect("converges");
            let worst = apart(axis.poles(), values);
            // Roundings of the matrix over the distance of the slow pole from zero, at least 1e-4 resonances.
            prop_assert!(worst <= 1e-11 * axis.resonance(), "{worst} of {}", axis.resonance());
        }

        #[test]
        fn poles_solve_the_cubic(
            motor in log(-5.0, 0.0), load in log(-5.0, 0.0), stiffness in log(0.0, 5.0),
            ratios in [log(-8.0, 3.0), log(-8.0, 3.0), log(-8.0, 3.0)]
        ) {
            let scale = (stiffness * motor.min(load)).sqrt();
            let [m, s, l] = ratios.map(|ratio| ratio * scale);
            let axis = axis([motor, load], stiffness, [m, s, l]);
            for pole in axis.poles().into_iter().skip(1) {
                let terms = [
                    pole * pole * pole * (motor * load),
                    pole * pole * (motor * (l + s) + load * (m + s)),
                    pole * (stiffness * (motor + load) + m * l + m * s + l * s),
                    Complex::new(stiffness * (m + l), 0.0),
                ];
                let size = terms.iter().fold(0.0_f64, |size, term| size.max(term.norm()));
                // A dozen roundings of the largest term, as Newton's method leaves them.
                prop_assert!(terms.iter().sum::<Complex<f64>>().norm() <= 2e-14 * size);
                prop_assert!(pole.re <= 0.0);
            }
        }
    }

    #[test]
    fn an_undamped_axis_vibrates_at_its_resonance() {
        let axis = axis([0.003, 5e-4], 100.0, [0.0; 3]);
        let [zero, real, up, down] = axis.poles();
        assert!(zero.norm() <= 0.0 && real.norm() <= 0.0 && up.re.abs() <= 0.0);
        let resonance = (100.0_f64 / 0.003 + 100.0 / 5e-4).sqrt();
        assert!((up.im / resonance - 1.0).abs() < 1e-15 && (up - down.conj()).norm() <= 0.0);
        assert!((axis.resonance() / resonance - 1.0).abs() < 1e-15);
        assert!((axis.anti_resonance() - 200e3_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_spring_damper_alone_in_closed_form() {
        // The twist: J phi'' + c phi' + K phi = 0 with 1 / J = 1 / J_m + 1 / J_l.
        let reduced = 1.0 / (1.0 / 0.003 + 1.0 / 5e-4);
        for c in [1e-6, 0.006, 0.3] {
            let mode = axis([0.003, 5e-4], 100.0, [0.0, c, 0.0]).free_mode().expect("vibrates");
            assert!((mode.angular_frequency() / (100.0 / reduced).sqrt() - 1.0).abs() < 1e-15);
            assert!((mode.damping_ratio() / (0.5 * c / (100.0 * reduced).sqrt()) - 1.0).abs() < 1e-14);
        }
        let over = axis([0.003, 5e-4], 100.0, [0.0, 0.5, 0.0]).free_mode();
        let ratio = 0.25 / (100.0 * reduced).sqrt();
        assert!(matches!(
            over,
            Err(ModelError::Mode(profiles::ModeError::DampingRatio(z))) if (z / ratio - 1.0).abs() < 1e-14
        ));
    }

    #[test]
    fn the_modes_are_poles() {
        let axis = axis([0.003, 1.066e-3], 1000.0, [0.008, 0.02, 0.005]);
        assert!((axis.free_mode().expect("vibrates").pole() - axis.poles()[2]).norm() < 1e-11);
        let held = axis.held_mode().expect("vibrates").pole();
        let residual = held * held * 1.066e-3 + held * 0.025 + 1000.0;
        assert!(residual.norm() < 1e-12 * 1000.0);
        // A motor far heavier than the load holds it.
        let heavy = TwoInertia::new(1e6, 1.066e-3, 1000.0).and_then(|a| a.with_damping(0.0, 0.02, 0.005));
        let free = heavy.and_then(|a| a.free_mode()).expect("vibrates").pole();
        assert!((free - held).norm() < 1e-8 * held.norm());
    }
}
