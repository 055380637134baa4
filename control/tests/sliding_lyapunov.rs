//! The surface falls as its law says, and `s^2` never grows, on the axis that the model describes.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]

use control::{
    AxisModel, ReachingLaw, Sampling, SlidingMode, SlidingModeInput, SlidingModeState, SlidingSurface,
    Status, Switching,
};
use profiles::Sample;
use proptest::prelude::*;

/// A surface and its two slopes, with powers taken one by one.
#[derive(Debug, Clone, Copy)]
enum Surface {
    Linear(f64),
    Terminal(f64, f64, u32, u32),
    Nonsingular(f64, u32, u32),
    Fast(f64, f64, f64, u32, u32),
}

fn signed_power(x: f64, a: f64) -> f64 {
    x.abs().powf(a).copysign(x)
}

impl Surface {
    fn ours(self) -> SlidingSurface {
        match self {
            Self::Linear(c) => SlidingSurface::linear(c),
            Self::Terminal(alpha, beta, p, q) => SlidingSurface::terminal(alpha, beta, p, q),
            Self::Nonsingular(beta, p, q) => SlidingSurface::nonsingular_terminal(beta, p, q),
            Self::Fast(alpha, g, beta, p, q) => {
                SlidingSurface::fast_nonsingular_terminal(alpha, g, beta, p, q)
            }
        }
        .expect("valid")
    }

    /// `s`, `ds/de` and `ds/de'`.
    fn by_hand(self, e: f64, rate: f64) -> [f64; 3] {
        match self {
            Self::Linear(c) => [rate + c * e, c, 1.0],
            Self::Terminal(alpha, beta, p, q) => {
                let a = f64::from(q) / f64::from(p);
                let slope = alpha + beta * a * e.abs().powf(a - 1.0);
                [rate + alpha * e + beta * signed_power(e, a), slope, 1.0]
            }
            Self::Nonsingular(beta, p, q) => {
                let a = f64::from(p) / f64::from(q);
                [e + signed_power(rate, a) / beta, 1.0, a / beta * rate.abs().powf(a - 1.0)]
            }
            Self::Fast(alpha, g, beta, p, q) => {
                let [s, _, leverage] = Self::Nonsingular(beta, p, q).by_hand(e, rate);
                [s + signed_power(e, g) / alpha, 1.0 + g / alpha * e.abs().powf(g - 1.0), leverage]
            }
        }
    }
}

fn surfaces() -> impl Strategy<Value = Surface> {
    let exponents = prop::sample::select(vec![(9_u32, 5_u32), (5, 3), (7, 5), (11, 7)]);
    prop_oneof![
        (0.1..50.0).prop_map(Surface::Linear),
        (0.0..50.0, 0.1..20.0, exponents.clone()).prop_map(|(a, b, (p, q))| Surface::Terminal(a, b, p, q)),
        (0.1..20.0, exponents.clone()).prop_map(|(b, (p, q))| Surface::Nonsingular(b, p, q)),
        (0.1..20.0, 1.9..3.0, 0.1..20.0, exponents)
            .prop_map(|(a, g, b, (p, q))| Surface::Fast(a, g, b, p, q)),
    ]
}

/// A law as the paper writes it.
#[derive(Debug, Clone, Copy)]
enum Law {
    Constant(f64),
    Exponential(f64, f64),
    Power(f64, f64),
    Double(f64, f64, f64, f64),
    Improved(f64, f64, f64, f64, f64),
}

impl Law {
    fn ours(self, switching: Switching) -> ReachingLaw {
        match self {
            Self::Constant(eps) => ReachingLaw::constant(eps),
            Self::Exponential(k, eps) => ReachingLaw::exponential(k, eps),
            Self::Power(k, a) => ReachingLaw::power(k, a),
            Self::Double(k1, b1, k2, b2) => ReachingLaw::double_power(k1, b1, k2, b2),
            Self::Improved(k1, k2, k3, b2, b3) => ReachingLaw::improved_double_power(k1, k2, k3, b2, b3),
        }
        .and_then(|law| law.with_switching(switching))
        .expect("valid")
    }

    fn by_hand(self, s: f64, e: f64, sign: f64) -> f64 {
        let power = |a: f64| s.abs().powf(a) * sign;
        match self {
            Self::Constant(eps) => eps * sign,
            Self::Exponential(k, eps) => k * s + eps * sign,
            Self::Power(k, a) => k * power(a),
            Self::Double(k1, b1, k2, b2) => k1 * power(b1) + k2 * power(b2),
            Self::Improved(k1, k2, k3, b2, b3) => {
                k1 * power(2.0 - b2) + k2 * power(b2) + k3 * e.abs().powf(b3) * s
            }
        }
    }
}

fn laws() -> impl Strategy<Value = Law> {
    let k = || 0.1..200.0_f64;
    prop_oneof![
        k().prop_map(Law::Constant),
        (k(), 0.0..50.0).prop_map(|(k, eps)| Law::Exponential(k, eps)),
        (k(), 0.1..0.9).prop_map(|(k, a)| Law::Power(k, a)),
        (k(), 1.1..2.0, k(), 0.1..0.9).prop_map(|(k1, b1, k2, b2)| Law::Double(k1, b1, k2, b2)),
        (k(), k(), 0.0..200.0, 0.1..0.9, 0.1..2.0)
            .prop_map(|(k1, k2, k3, b2, b3)| Law::Improved(k1, k2, k3, b2, b3)),
    ]
}

fn switchings() -> impl Strategy<Value = Switching> {
    prop_oneof![
        Just(Switching::Sign),
        (0.01..1.0).prop_map(|width| Switching::Saturation { width }),
        (0.01..1.0).prop_map(|width| Switching::Smooth { width }),
    ]
}

fn sign(switching: Switching, s: f64) -> f64 {
    match switching {
        Switching::Sign => s.signum(),
        Switching::Saturation { width } => (s / width).clamp(-1.0, 1.0),
        Switching::Smooth { width } => s / (s.abs() + width),
    }
}

fn any_state() -> impl Strategy<Value = f64> {
    // From far off to well within a micrometre, on both sides.
    (any::<bool>(), -6.0..1.0_f64).prop_map(|(negative, digits)| {
        let size = 10_f64.powf(digits);
        if negative { -size } else { size }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4096))]

    #[test]
    fn the_square_of_the_surface_never_grows(
        surface in surfaces(), law in laws(), switching in switchings(),
        (a, b, k) in (0.0..50.0, 0.0..50.0, prop_oneof![0.1..10.0, -10.0..-0.1]),
        (x, v, e, rate, wanted) in (any_state(), any_state(), any_state(), any_state(), any_state()),
    ) {
        let model = AxisModel::new(a, b, k).expect("valid");
        // A period so short that no error drawn lies within the guard.
        let controller =
            SlidingMode::new(surface.ours(), law.ours(switching), model, 1e-9).expect("valid");
        prop_assert!(controller.guard().is_none_or(|guard| guard < 1e-6));
        let reference =
            Sample { position: x + e, velocity: v + rate, acceleration: wanted, ..Sample::default() };
        // What is left of the error after the subtraction.
        let (e, rate) = (reference.position - x, reference.velocity - v);
        let output = controller.update(&mut SlidingModeState::new(), SlidingModeInput::new(&reference, x, v));
        prop_assert_eq!(output.status, Status::Regular);

        // The axis itself, without load.
        let acceleration = -a * v - b * x + k * output.output;
        let [s, slope, leverage] = surface.by_hand(e, rate);
        let change = slope * rate + leverage * (wanted - acceleration);
        let rho = law.by_hand(s, e, sign(switching, s));

        // Each term is rounded a few times, its powers by up to ln(1e-6) times more.
        let size = wanted.abs() + (a * v).abs() + (b * x).abs();
        let scale = (slope * rate).abs() + leverage * (rho.abs() + size);
        // Where s itself is a small difference its rounding passes through the law, up to a square root and more of it.
        let cancelled = rate.abs() + s.abs() + (slope * e).abs();
        let blurred = [s - 1e-15 * cancelled, s + 1e-15 * cancelled]
            .map(|s| leverage * (law.by_hand(s, e, sign(switching, s)) - rho).abs());
        let tolerance = 64.0 * f64::EPSILON * scale + blurred[0].max(blurred[1]);
        prop_assert!((change + leverage * rho).abs() <= tolerance, "{change} {} {tolerance}", leverage * rho);
        prop_assert!(s * change <= s.abs() * tolerance, "{s} {change}");
        prop_assert!((output.surface - s).abs() <= 1e-14 * cancelled, "{} {s}", output.surface);
    }
}

#[test]
fn the_law_of_the_paper_comes_out() {
    // Equation (24) with the printed gains, term by term.
    let surface = SlidingSurface::terminal(10.0, 1.0, 9, 5).expect("valid");
    let law = ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 1.0 / 3.0, 1.0 / 3.0).expect("valid");
    let model = AxisModel::new(10.0, 1.0, 1.0).expect("valid");
    let controller = SlidingMode::new(surface, law, model, 1e-3)
        .and_then(|c| c.with_integral_compensation(20.0))
        .expect("valid");
    let mut state = SlidingModeState::new();
    let mut integral = 0.0;
    for (r, q) in [((0.3, 1.1, -0.4), (0.5, -2.0)), ((0.1, 0.2, 0.7), (-0.4, 0.3))] {
        let reference = Sample { position: r.0, velocity: r.1, acceleration: r.2, ..Sample::default() };
        let output = controller.update(&mut state, SlidingModeInput::new(&reference, q.0, q.1));
        let (e, rate) = (r.0 - q.0, r.1 - q.1);
        let s = rate + 10.0 * e + signed_power(e, 5.0 / 9.0);
        integral += 1e-3 * e;
        let by_hand = r.2
            + 10.0 * q.1
            + q.0
            + 10.0 * rate
            + 5.0 / 9.0 * e.abs().powf(5.0 / 9.0 - 1.0) * rate
            + 20.0 * signed_power(s, 5.0 / 3.0)
            + 20.0 * signed_power(s, 1.0 / 3.0)
            + 200.0 * e.abs().powf(1.0 / 3.0) * s
            + 20.0 * integral;
        // The largest term is some hundred, and there are nine.
        assert!((output.output - by_hand).abs() < 1e-11, "{} {by_hand}", output.output);
    }
}

proptest! {
    #[test]
    fn single_precision_says_the_same(
        e in -1.0..1.0_f64, rate in -5.0..5.0_f64, x in -1.0..1.0_f64, v in -5.0..5.0_f64, matched: bool,
    ) {
        macro_rules! output {
            ($real:ident) => {{
                let third = 1.0 / 3.0;
                let surface = SlidingSurface::<$real>::terminal(10.0, 1.0, 9, 5).expect("valid");
                let law = ReachingLaw::improved_double_power(20.0, 20.0, 200.0, third, third).expect("valid");
                let model = AxisModel::new(10.0, 1.0, 1.0).expect("valid");
                let sampling = if matched { Sampling::Matched } else { Sampling::Explicit };
                let controller = SlidingMode::new(surface, law, model, 1e-3)
                    .and_then(|c| c.with_sampling(sampling))
                    .expect("valid");
                let input = SlidingModeInput {
                    position: x as $real,
                    velocity: v as $real,
                    ..SlidingModeInput::default()
                };
                let input = input.with_error(e as $real, rate as $real);
                let output = controller.update(&mut SlidingModeState::new(), input);
                (f64::from(output.output), f64::from(output.surface))
            }};
        }
        let (single, double) = (output!(f32), output!(f64));
        // s up to 16 is a sum of three; the law, up to 2100 + 3200, steepens what is lost of it to a cube root.
        let lost = 16.0 * f64::from(f32::EPSILON);
        prop_assert!((single.1 - double.1).abs() < lost, "{single:?} {double:?}");
        let steepened = 20.0 * (2.0 * lost.cbrt()).min(lost * double.1.abs().powf(-2.0 / 3.0));
        let scale = 5300.0 * 4.0 * f64::from(f32::EPSILON);
        prop_assert!((single.0 - double.0).abs() < scale + steepened + 300.0 * lost, "{single:?} {double:?}");
    }
}
