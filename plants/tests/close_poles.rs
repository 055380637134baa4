//! Transfer functions whose poles are close together or far apart.

use plants::nalgebra::{Complex, matrix};
use plants::{TransferFunction, eigenvalues};

type Roots = Vec<Complex<f64>>;

fn real(x: f64) -> Complex<f64> {
    Complex::new(x, 0.0)
}

fn pair(re: f64, im: f64) -> [Complex<f64>; 2] {
    [Complex::new(re, im), Complex::new(re, -im)]
}

/// Relative spacing of close poles.
const CLOSE: f64 = 1e-6;

#[test]
fn close_poles_keep_their_digits_where_a_companion_form_loses_them() {
    let [a, b, c] = [-3.0, -3.0 * (1.0 + CLOSE), -3.0 * (1.0 - CLOSE)];
    let transfer = TransferFunction::with_dc_gain(&[], &[a, b, c].map(real), 2.0).expect("valid");
    let distance = |found: [Complex<f64>; 3]| {
        [a, b, c].iter().fold(0.0_f64, |most, p| {
            most.max(found.iter().map(|f| (f - p).norm()).fold(f64::INFINITY, f64::min))
        })
    };
    let system = transfer.to_state_space::<3>().expect("finite");
    assert!(distance(system.poles().expect("converges")) < 1e-15);
    let again = TransferFunction::from_state_space(&system, 0, 0).expect("converges");
    assert!(distance([again.poles()[0], again.poles()[1], again.poles()[2]]) < 1e-15);
    let [_, c2, c1, c0] = transfer.denominator()[..] else { unreachable!("a cubic") };
    let companion = matrix![-c2, -c1, -c0; 1.0, 0.0, 0.0; 0.0, 1.0, 0.0];
    assert!(distance(eigenvalues(&companion).expect("converges")) > 1e-6);
}

#[test]
fn a_step_through_close_lags() {
    // The impulse response of two lags is e^(-a t) (1 - e^(-(b - a) t)) / (b - a), exact however close they are.
    let (a, b) = (3.0, 3.0 * (1.0 + CLOSE));
    let transfer = TransferFunction::new(&[], &[real(-a), real(-b)], 1.0).expect("valid");
    let impulse = transfer.impulse_response(0.02, 200).expect("finite");
    for (k, h) in impulse.into_iter().enumerate() {
        let t = 0.02 * k as f64;
        let expected = (-a * t).exp() * -(-(b - a) * t).exp_m1() / (b - a);
        // Two hundred products; the largest value is 0.12.
        assert!((h - expected).abs() < 1e-15, "{h} {expected}");
    }
    for w in [0.1, 3.0, 700.0] {
        let s = Complex::new(0.0, w);
        let expected = ((s + a) * (s + b)).inv();
        let g = transfer.frequency_response(w).expect("no pole");
        assert!((g - expected).norm() < 1e-15 * expected.norm());
    }
}

#[test]
fn an_impulse_through_close_vibrations() {
    // sin(v t) / v convolved with sin(w t) / w by Gauss's rule on panels of a fifth of a radian.
    let (v, w) = (40.0, 40.0 * (1.0 + CLOSE));
    let poles = [pair(0.0, v), pair(0.0, w)].concat();
    let transfer = TransferFunction::new(&[], &poles, v * w * v * w).expect("valid");
    let period = 0.05;
    let impulse = transfer.impulse_response(period, 40).expect("finite");
    let gauss = [(0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
    for (k, h) in impulse.into_iter().enumerate() {
        let t = period * k as f64;
        let panels = 20 * k * 4;
        let half = 0.5 * t / panels.max(1) as f64;
        let mut sum = 0.0;
        for panel in 0..panels {
            for (node, weight) in
                gauss.iter().flat_map(|(x, w)| [(*x, *w), (-*x, if *x > 0.0 { *w } else { 0.0 })])
            {
                let u = half * (2.0 * panel as f64 + 1.0 + node);
                sum += weight * half * (v * (t - u)).sin() * (w * u).sin();
            }
        }
        // In resonance it grows as v w t / 2; three points on 1/40 rad are exact to 1e-14, and so are phases of 80 rad.
        assert!((h - sum * v * w).abs() < 2e-13 * v * w * (1.0 + t), "{h} {}", sum * v * w);
    }
}

#[test]
fn order_and_frequency_far_apart() {
    // Eight poles over eight decades, stepped for one second.
    let poles: Roots = (-2..6).map(|k| real(-(10.0_f64.powi(k)))).collect();
    let transfer = TransferFunction::with_dc_gain(&[], &poles, 1.0).expect("valid");
    assert!((transfer.dc_gain().expect("no pole") - 1.0).abs() < 1e-14);
    let step = transfer.step_response(1.0, 1000).expect("finite");
    for (k, y) in step.iter().enumerate().skip(300) {
        // After three seconds what is faster than 0.1 rad/s follows as a delay; the closed form of the two slow lags.
        let partial: f64 = poles
            .iter()
            .enumerate()
            .map(|(i, p)| {
                let others: f64 = poles
                    .iter()
                    .enumerate()
                    .filter(|(j, _)| *j != i)
                    .map(|(_, q)| q.re / (q.re - p.re))
                    .product();
                others * (p.re * k as f64).exp()
            })
            .sum();
        assert!((y - (1.0 - partial)).abs() < 1e-10, "{y} {}", 1.0 - partial);
    }
}
