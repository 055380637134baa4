//! The response of a pole to a sectioned motion, in closed form.

use num_complex::Complex;

use crate::complex;
use crate::section::{Section, Sectioned};

/// `1 / k!` for `k` from 0 to 4.
const INVERSE_FACTORIALS: [f64; 5] = [1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0];

/// `integral of a(u) e^(p (T - u)) du`.
///
/// Where `|p T|` is small the acceleration nearly cancels over a move; then the same number is taken from the
/// velocity, `dv + p integral of (v(u) - v_before) e^(p (T - u)) du`, where nothing cancels.
pub(crate) fn over<S: Sectioned>(profile: &S, p: Complex<f64>) -> Complex<f64> {
    let duration = profile.duration();
    let (before, after) = (profile.before().velocity, profile.after().velocity);
    let from_velocity = complex::norm(p) * duration < 1.0;
    let mut sum = Complex::new(0.0, 0.0);
    let mut first = None;
    let mut last = before;
    let mut index = 0;
    while let Some(section) = profile.section(index) {
        index += 1;
        if section.length() <= 0.0 {
            continue;
        }
        let (from, to) = section.local_ends();
        first.get_or_insert_with(|| section.at_local(from).velocity);
        last = section.at_local(to).velocity;
        let integral = if from_velocity {
            velocity_integral(&section, before, p)
        } else {
            acceleration_integral(&section, p)
        };
        sum += complex::exp(p * (duration - section.end)) * integral;
    }
    if from_velocity {
        p * sum + (after - before)
    } else {
        let jump = first.unwrap_or(before) - before;
        complex::exp(p * duration) * jump + sum + (after - last)
    }
}

/// `integral of a(u) e^(-s u) du`, for `Re s >= 0` and `|s T|` of one or more: no exponential grows.
pub(crate) fn forward<S: Sectioned>(profile: &S, s: Complex<f64>) -> Complex<f64> {
    let before = profile.before().velocity;
    let mut sum = Complex::new(0.0, 0.0);
    let mut last = None;
    let mut index = 0;
    while let Some(section) = profile.section(index) {
        index += 1;
        if section.length() <= 0.0 {
            continue;
        }
        let (from, to) = section.local_ends();
        if last.is_none() {
            sum += section.at_local(from).velocity - before;
        }
        let end = section.polynomial.advanced(to);
        last = Some(section.at_local(to).velocity);
        // Counted back from the end of the section, every other derivative has the other sign.
        let d = section.length();
        let mut integral = polynomial_integral([end.acceleration, -end.jerk, end.snap, 0.0], d, -s);
        let w = section.angular_frequency;
        if section.amplitude != 0.0 {
            // sin(w (x + from)) is the imaginary part of e^(i w (x + from)).
            let i = Complex::new(0.0, 1.0);
            let turning = |q: Complex<f64>| {
                let [phi_1, ..] = phi_functions((q - s) * d);
                complex::exp(q * from) * phi_1 * d
            };
            let sine = (turning(i * w) - turning(-i * w)) / (2.0 * i);
            integral -= sine * (section.amplitude * w * w);
        }
        sum += complex::exp(-s * section.start) * integral;
    }
    sum + complex::exp(-s * profile.duration()) * (profile.after().velocity - last.unwrap_or(before))
}

/// `integral over the section of a(u) e^(p (end - u)) du`.
fn acceleration_integral(section: &Section, p: Complex<f64>) -> Complex<f64> {
    let start = section.polynomial.advanced(section.local_ends().0);
    let w = section.angular_frequency;
    polynomial_integral([start.acceleration, start.jerk, start.snap, 0.0], section.length(), p)
        + sine_integrals(section, p).0 * (-section.amplitude * w * w)
}

/// `integral over the section of (v(u) - v_before) e^(p (end - u)) du`.
fn velocity_integral(section: &Section, before: f64, p: Complex<f64>) -> Complex<f64> {
    let start = section.polynomial.advanced(section.local_ends().0);
    let coefficients = [start.velocity - before, start.acceleration, start.jerk, start.snap];
    polynomial_integral(coefficients, section.length(), p)
        + sine_integrals(section, p).1 * (section.amplitude * section.angular_frequency)
}

/// `integral from 0 to d of (sum of c_k x^k / k!) e^(p (d - x)) dx = sum of c_k d^(k+1) phi_(k+1)(p d)`.
fn polynomial_integral(coefficients: [f64; 4], d: f64, p: Complex<f64>) -> Complex<f64> {
    let mut power = 1.0;
    let mut sum = Complex::new(0.0, 0.0);
    for (c, phi) in coefficients.into_iter().zip(phi_functions(p * d)) {
        power *= d;
        sum += phi * (c * power);
    }
    sum
}

/// The integrals of the sine (of amplitude one) and of its cosine times `e^(p (end - u))` over the section.
fn sine_integrals(section: &Section, p: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
    if section.amplitude == 0.0 {
        return Default::default();
    }
    let d = section.length();
    let i = Complex::new(0.0, 1.0);
    let lead = section.phase / section.angular_frequency;
    // integral from 0 to d of e^(q (x + x0)) e^(p (d - x)) dx = e^(q (d + x0)) d phi_1((p - q) d), q = -+ i w.
    let turning = |q: Complex<f64>| {
        let [phi_1, ..] = phi_functions((p - q) * d);
        complex::exp(q * (section.local_ends().1 + lead)) * phi_1 * d
    };
    let (ahead, behind) = (turning(i * section.angular_frequency), turning(-i * section.angular_frequency));
    ((ahead - behind) / (2.0 * i), (ahead + behind) * 0.5)
}

/// `phi_1` and `phi_2` of `z`.
pub(crate) fn phi_1_2(z: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
    let [phi_1, phi_2, ..] = phi_functions(z);
    (phi_1, phi_2)
}

/// `(e^z - 1) / z`.
pub(crate) fn phi_1(z: Complex<f64>) -> Complex<f64> {
    let [phi_1, ..] = phi_functions(z);
    phi_1
}

/// `phi_1 ... phi_4` of `z`, with `phi_k(z) = sum of z^n / (n + k)!`.
fn phi_functions(z: Complex<f64>) -> [Complex<f64>; 4] {
    let [_, one, half, sixth, twenty_fourth] = INVERSE_FACTORIALS;
    if complex::norm(z) < 2.0 {
        // Horner from the 26th term, which is below 2^26 / 30! of the first; then phi_k = z phi_(k+1) + 1/k!.
        let mut nested = Complex::new(1.0, 0.0);
        for n in (1..=26).rev() {
            nested = nested * z / f64::from(n + 4) + 1.0;
        }
        let phi_4 = nested * twenty_fourth;
        let phi_3 = z * phi_4 + sixth;
        let phi_2 = z * phi_3 + half;
        [z * phi_2 + one, phi_2, phi_3, phi_4]
    } else {
        let phi_1 = (complex::exp(z) - one) / z;
        let phi_2 = (phi_1 - one) / z;
        let phi_3 = (phi_2 - half) / z;
        [phi_1, phi_2, phi_3, (phi_3 - sixth) / z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::Real;

    #[test]
    fn phi_functions_meet_where_series_and_recurrence_change_over() {
        for angle in [0.0, 0.7, 1.6, 2.4, 3.1] {
            let direction = complex::exp(Complex::new(0.0, angle));
            let (inside, outside) =
                (phi_functions(direction * 1.999_999_999_9), phi_functions(direction * 2.0));
            for (a, b) in inside.into_iter().zip(outside) {
                assert!(complex::norm(a - b) < 1e-9 * complex::norm(b), "{a} {b}");
            }
        }
    }

    #[test]
    fn integrals_of_a_sine_with_a_phase_are_those_of_quadrature() {
        let p = Complex::new(-0.4, 3.0);
        for (anchor, reach) in [(0.2, 1.5), (1.7, -1.5)] {
            let section = Section {
                anchor,
                reach,
                amplitude: 1.0,
                angular_frequency: 2.0,
                phase: 0.7,
                ..Section::cruise(0.2, 1.7, Default::default())
            };
            let (sine, cosine) = sine_integrals(&section, p);
            // Simpson's rule over 2000 steps is off by 1.5 (p h)^4 / 180, below 1e-13.
            let value = |k: i32, f: fn(f64) -> f64| {
                let t = 0.2 + 1.5 * f64::from(k) / 2000.0;
                complex::exp(p * (1.7 - t)) * f(2.0 * (t - anchor) + 0.7)
            };
            for (ours, f) in [(sine, Real::sin as fn(f64) -> f64), (cosine, Real::cos)] {
                let steps = (0..1000)
                    .map(|k| value(2 * k, f) + value(2 * k + 1, f) * 4.0 + value(2 * k + 2, f))
                    .fold(Complex::new(0.0, 0.0), |sum, step| sum + step);
                let known = steps * (1.5 / 2000.0 / 3.0);
                assert!(complex::norm(ours - known) < 1e-12, "{ours} {known}");
            }
        }
    }

    #[test]
    fn phi_functions_are_the_integrals_of_powers() {
        // phi_1(-3) = (1 - e^-3) / 3 and phi_2(-1/2) = (e^-0.5 - 1 + 0.5) / 0.25.
        let [phi_1, ..] = phi_functions(Complex::new(-3.0, 0.0));
        assert!((phi_1.re - (1.0 - Real::exp(-3.0)) / 3.0).abs() < 1e-16);
        let [_, phi_2, ..] = phi_functions(Complex::new(-0.5, 0.0));
        assert!((phi_2.re - 4.0 * (Real::exp(-0.5) - 0.5)).abs() < 1e-15);
    }
}
