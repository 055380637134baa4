//! The exact motion of an axis over one period.

/// Of `y'' = -a y' - b y` with `y(0) = 0`, `y'(0) = 1`: the value and the rate at the end of the period, and the integral up
/// to there.
///
/// From position `x` and velocity `v` under a constant acceleration `w` besides `-a v - b x` an axis arrives at
///
/// `x + = (rate + a value) x + value v + integral w`, `v + = -b value x + rate v + value w`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transition {
    pub(super) value: f64,
    pub(super) rate: f64,
    pub(super) integral: f64,
    damping: f64,
    stiffness: f64,
}

impl Transition {
    /// Damping `a >= 0`, stiffness `b >= 0` and a period, all finite.
    pub(super) fn over(period: f64, damping: f64, stiffness: f64) -> Self {
        let mut short = period;
        let mut doublings = 0_u32;
        while damping * short + stiffness * short * short > 0.25 {
            short *= 0.5;
            doublings += 1;
        }
        let mut transition = Self::series(short, damping, stiffness);
        for _ in 0..doublings {
            transition = transition.doubled();
        }
        transition
    }

    /// From position to position: `rate + a value`.
    pub(super) fn persistence(&self) -> f64 {
        self.rate + self.damping * self.value
    }

    /// `1 - persistence` without its cancellation.
    pub(super) fn lost_persistence(&self) -> f64 {
        self.stiffness * self.integral
    }

    /// `1 - rate` without its cancellation: `y'' = -a y' - b y` integrated once.
    pub(super) fn lost_rate(&self) -> f64 {
        self.damping * self.value + self.stiffness * self.integral
    }

    /// From position to velocity: `-b value`.
    pub(super) fn restoring(&self) -> f64 {
        -self.stiffness * self.value
    }

    /// The Taylor series of a period so short that twelve terms leave nothing: 0.25^12 / 12! is 1e-16.
    fn series(period: f64, damping: f64, stiffness: f64) -> Self {
        // Terms n - 2 and n - 1 of the value, y^(n) h^n / n!.
        let (mut before, mut term) = (0.0, period);
        let (mut value, mut rate, mut integral) = (period, 1.0, 0.5 * period * period);
        for n in 2..14 {
            let n = f64::from(n);
            let next =
                -(damping * period * term) / n - stiffness * period * period * before / (n * (n - 1.0));
            (before, term) = (term, next);
            value += term;
            rate += n * term / period;
            integral += term * period / (n + 1.0);
        }
        Self { value, rate, integral, damping, stiffness }
    }

    /// The same over twice the period.
    fn doubled(self) -> Self {
        let Self { value, rate, integral, stiffness, .. } = self;
        let persistence = self.persistence();
        Self {
            value: value * (persistence + rate),
            rate: rate * rate - stiffness * value * value,
            integral: integral * (1.0 + persistence) + value * value,
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roundings of the doublings, each of which doubles the relative error.
    const ROUNDINGS: f64 = 1e-13;

    fn close(ours: f64, exact: f64, scale: f64) {
        assert!((ours - exact).abs() <= ROUNDINGS * scale, "{ours} {exact}");
    }

    #[test]
    fn the_closed_forms_come_out() {
        for h in [1e-4, 0.03, 2.0] {
            // No spring: (1 - e^(-a h)) / a.
            let a = 7.0_f64;
            let decay = (-a * h).exp();
            let free = Transition::over(h, a, 0.0);
            close(free.value, -(-a * h).exp_m1() / a, h);
            close(free.rate, decay, 1.0);
            close(free.integral, (h + (-a * h).exp_m1() / a) / a, h * h);
            close(free.persistence(), 1.0, 1.0);
            // No damping: sin(w h) / w.
            let w = 3.0_f64;
            let spring = Transition::over(h, 0.0, w * w);
            close(spring.value, (w * h).sin() / w, h);
            close(spring.rate, (w * h).cos(), 1.0);
            close(spring.integral, 2.0 * (0.5 * w * h).sin().powi(2) / (w * w), h * h);
            // Poles at -2 and -5.
            let (p, q) = (2.0_f64, 5.0_f64);
            let both = Transition::over(h, p + q, p * q);
            let (fast, slow) = ((-q * h).exp(), (-p * h).exp());
            close(both.value, (slow - fast) / (q - p), h);
            close(both.rate, (q * fast - p * slow) / (q - p), 1.0);
            close(both.persistence(), (q * slow - p * fast) / (q - p), 1.0);
            close(1.0 - both.lost_rate(), both.rate, 1.0);
            close(1.0 - both.lost_persistence(), both.persistence(), 1.0);
            close(both.restoring(), -p * q * (slow - fast) / (q - p), 1.0);
        }
    }

    #[test]
    fn stiff_axes_stay_finite() {
        let stiff = Transition::over(1e3, 1e9, 1e12);
        assert!([stiff.value, stiff.rate, stiff.integral].iter().all(|x| x.is_finite()));
    }
}
