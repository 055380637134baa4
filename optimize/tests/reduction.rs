//! Degree reduction: exact where it can be, at the optimum elsewhere, never further off than it says.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

#[path = "common/curves.rs"]
mod curves;

use curves::{butterfly, cubic, quarter, quintic, sampled, spatial};
use optimize::reduce_degree;
use optimize::reduction::{
    Criterion, Deviation, Ends, Reduced, Reduction, ReductionError, Target, Weights, deviation,
};
use profiles::nurbs::{Knots, NurbsCurve, NurbsError, Side};
use proptest::prelude::*;

/// Diagonal of the box of its control points.
const CUBIC_SIZE: f64 = 107.703_296_142_690_08;

fn reduced<const D: usize>(curve: &NurbsCurve<D>, degree: usize, weights: Weights) -> Reduced<D> {
    let reduced = reduce_degree(curve, &Reduction { weights, ..Reduction::to(degree) }).expect("reduces");
    // What is said of it holds in every test.
    let seen = sampled(curve, &reduced.curve, 20_001);
    let said = reduced.deviation;
    assert!(said.at_most >= seen, "{} {seen}", said.at_most);
    // Roundings of coordinates apart.
    let scale = curve.control_points().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(
        said.attained <= said.at_most && said.attained >= seen * (1.0 - 1e-6) - 1e-13 * scale,
        "{said:?} {seen}"
    );
    assert!(reduced.optimum <= said.at_most);
    reduced
}

#[test]
fn published_optima_are_reached() {
    let ones = |curve: &NurbsCurve<2>, degree| reduced(curve, degree, Weights::Ones);
    let inner = |curve: &NurbsCurve<2>, degree| reduced(curve, degree, Weights::Inner);
    let quartic = cubic().raised(1).expect("valid");
    // Of a convex solver with unit weights, of a descent with free ones between kept ends; sampled, so that the true
    // optimum lies up to a thousandth above.
    for (found, optimum, tolerance) in [
        (ones(&quintic(), 4), 1.351_828e-2, 0.01),
        (ones(&quintic(), 3), 0.195_782_7, 0.01),
        (ones(&quartic, 3), 1.151_521, 0.01),
        (ones(&quarter(), 3), 7.846_697e-3, 0.01),
        (ones(&quarter(), 2), 4.425_456e-2, 0.01),
        (ones(&butterfly(), 2), 0.7206, 0.01),
        (inner(&quintic(), 4), 5.900_362e-3, 0.02),
        (inner(&quintic(), 3), 8.738_757e-2, 0.02),
        (inner(&butterfly(), 2), 0.1923, 0.02),
    ] {
        let at_most = found.deviation.at_most;
        println!("{at_most:.6e} beside {optimum:.6e}, nothing below {:.6e}", found.optimum);
        assert!(at_most <= (1.0 + tolerance) * optimum, "{at_most} {optimum}");
        // Not below what can be, and that within a hundredth.
        assert!(
            found.optimum <= 1.001 * optimum && at_most <= 1.01 * found.optimum,
            "{at_most} {}",
            found.optimum
        );
    }
}

#[test]
fn free_end_weights_are_worth_it() {
    for (degree, published) in [(4, 5.900_362e-3), (3, 8.738_757e-2)] {
        let free = reduced(&quintic(), degree, Weights::Free);
        println!("{degree}: {:e}, nothing below {:e}", free.deviation.at_most, free.optimum);
        assert!(free.deviation.at_most < 0.91 * published && free.deviation.at_most < 1.01 * free.optimum);
    }
    let solid = reduced(&spatial(), 3, Weights::Free);
    let kept = reduced(&spatial(), 3, Weights::Inner);
    let ones = reduced(&spatial(), 3, Weights::Ones);
    println!(
        "spatial: {:e} {:e} {:e}",
        solid.deviation.at_most, kept.deviation.at_most, ones.deviation.at_most
    );
    assert!(solid.deviation.at_most <= 1.01 * kept.deviation.at_most);
    assert!(kept.deviation.at_most < ones.deviation.at_most);
    for found in [solid, kept, ones] {
        assert!(found.deviation.at_most < 1.01 * found.optimum);
    }
}

/// The optimum for fixed weights from below, by another way: Lawson's iteration on many samples, whose weighted least
/// squares are a bound in every step.
fn lawson(curve: &NurbsCurve<2>, target: &NurbsCurve<2>) -> f64 {
    let (domain, count) = (curve.domain(), 401);
    let knots = target.knots();
    let inner = knots.points() - 2;
    let mut rows = Vec::new();
    for k in 0..count {
        let u = domain.lower + (domain.upper - domain.lower) * k as f64 / (count - 1) as f64;
        let basis = knots.basis(u, Side::After);
        let mut row = vec![0.0; inner + 2];
        basis.values().iter().enumerate().for_each(|(j, value)| row[basis.first() + j] = *value);
        let weights: Vec<f64> = target.weights().collect();
        let sum: f64 = row.iter().zip(&weights).map(|(b, w)| b * w).sum();
        row.iter_mut().zip(&weights).for_each(|(b, w)| *b *= w / sum);
        let (start, end) = (curve.start(), curve.end());
        let mut rest = curve.point(u);
        for (axis, x) in rest.iter_mut().enumerate() {
            *x -= row[0] * start[axis] + row[inner + 1] * end[axis];
        }
        rows.push((row[1..=inner].to_vec(), rest));
    }
    let mut shares = vec![1.0 / count as f64; count];
    let mut bound = 0.0_f64;
    for _ in 0..3000 {
        // Normal equations by Gauss elimination without pivots: they are positive definite.
        let mut a = vec![vec![0.0; inner + 2]; inner];
        for ((row, rest), share) in rows.iter().zip(&shares) {
            for i in 0..inner {
                (0..inner).for_each(|j| a[i][j] += share * row[i] * row[j]);
                (0..2).for_each(|axis| a[i][inner + axis] += share * row[i] * rest[axis]);
            }
        }
        for i in 0..inner {
            let pivot = a[i].clone();
            for row in a.iter_mut().skip(i + 1) {
                let factor = row[i] / pivot[i];
                row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            }
        }
        for i in (0..inner).rev() {
            for axis in 0..2 {
                let known: f64 = (i + 1..inner).map(|j| a[i][j] * a[j][inner + axis]).sum();
                a[i][inner + axis] = (a[i][inner + axis] - known) / a[i][i];
            }
        }
        let distances: Vec<f64> = rows
            .iter()
            .map(|(row, rest)| {
                let off =
                    |axis: usize| rest[axis] - (0..inner).map(|j| row[j] * a[j][inner + axis]).sum::<f64>();
                off(0).hypot(off(1))
            })
            .collect();
        bound = bound.max(distances.iter().zip(&shares).map(|(d, s)| s * d * d).sum::<f64>().sqrt());
        shares.iter_mut().zip(&distances).for_each(|(share, distance)| *share *= distance);
        let sum: f64 = shares.iter().sum();
        shares.iter_mut().for_each(|share| *share /= sum);
    }
    bound
}

#[test]
fn fixed_weights_are_at_the_bound_of_another_method() {
    let quartic = cubic().raised(1).expect("valid");
    let given = Weights::Given(vec![2.0, 1.0, 3.0, 2.0]);
    for (curve, degree, weights) in
        [(quintic(), 4, Weights::Ones), (quintic(), 3, given), (quartic, 2, Weights::Ones)]
    {
        let found = reduced(&curve, degree, weights);
        let bound = lawson(&curve, &found.curve);
        println!("{:e}, Lawson's bound {bound:e}, ours {:e}", found.deviation.at_most, found.optimum);
        assert!(found.deviation.at_most <= 1.01 * bound && found.optimum <= 1.001 * found.deviation.attained);
        // Both are bounds of one optimum from below, close to it.
        assert!((found.optimum / bound - 1.0).abs() < 5e-3);
    }
}

#[test]
fn reducible_curves_are_reduced_to_rounding() {
    let circle = |degree| reduced(&quarter(), degree, Weights::Free);
    for found in [circle(3), circle(2)] {
        assert!(found.deviation.at_most < 1e-12 * 2_f64.sqrt(), "{:e}", found.deviation.at_most);
    }
    for weights in [Weights::Free, Weights::Inner] {
        let found = reduced(&cubic().raised(1).expect("valid"), 3, weights);
        assert!(found.deviation.at_most < 1e-12 * CUBIC_SIZE, "{:e}", found.deviation.at_most);
        let close = |(a, b): ([f64; 2], [f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-11 * CUBIC_SIZE;
        assert!(found.curve.control_points().zip(cubic().control_points()).all(close));
        assert!(found.curve.weights().zip(cubic().weights()).all(|(a, b)| (a - b).abs() < 1e-12));
    }
    // A parabola's point at the half way is no freedom of a line: the least largest distance is half the height.
    let parabola = NurbsCurve::bezier(&[[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]]).expect("valid");
    let line = reduced(&parabola, 1, Weights::Ones);
    assert!((line.deviation.attained - 1.0).abs() < 1e-6 && (line.deviation.at - 0.5).abs() < 1e-3);
}

#[test]
fn least_squares_alone_are_there_too() {
    let quick = Reduction { criterion: Criterion::MeanSquare, weights: Weights::Ones, ..Reduction::to(4) };
    let found = reduce_degree(&quintic(), &quick).expect("reduces");
    // Of dense least squares by another library, evenly spaced.
    let attained = found.deviation.attained;
    assert!((attained - 1.549_245_6e-2).abs() < 1e-6 * 1.549_245_6e-2, "{attained:e}");
    assert!(found.optimum.abs() < f64::MIN_POSITIVE);
}

#[test]
fn ends_and_tangents_are_kept() {
    fn unit<const D: usize>(v: [f64; D]) -> [f64; D] {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    }
    fn check<const D: usize>(curve: &NurbsCurve<D>, degree: usize) {
        for weights in [Weights::Ones, Weights::Inner, Weights::Free] {
            for criterion in [Criterion::MeanSquare, Criterion::Largest] {
                let weights = weights.clone();
                let reduction =
                    Reduction { weights, ends: Ends::Tangents, criterion, ..Reduction::to(degree) };
                let found = reduce_degree(curve, &reduction).expect("reduces");
                let free = Reduction { ends: Ends::Points, ..reduction };
                let free = reduce_degree(curve, &free).expect("reduces");
                if criterion == Criterion::Largest {
                    assert!(found.deviation.at_most >= free.optimum, "more is asked for");
                    assert!(found.deviation.at_most < 1.01 * found.optimum, "{found:?}");
                }
                let domain = curve.domain();
                for u in [domain.lower, domain.upper] {
                    let [here, tangent] = curve.derivatives(u);
                    let [there, other] = found.curve.derivatives(u);
                    // A weight that is not kept costs a rounding of the last point.
                    let off = |a: &[f64; D], b: &[f64; D]| {
                        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
                    };
                    assert!(off(&here, &there) <= 4.0 * f64::EPSILON * 100.0);
                    // Control points that are subtracted have roundings of their own size.
                    assert!(
                        off(&unit(tangent), &unit(other)) < 1e-12,
                        "{:?} {:?}",
                        unit(tangent),
                        unit(other)
                    );
                }
            }
        }
    }
    check(&quintic(), 4);
    check(&quintic(), 3);
    check(&spatial(), 4);
    check(&cubic().raised(1).expect("valid"), 2);
}

#[test]
fn tolerances_are_met_with_few_knots() {
    // Control points that bisection by least squares takes.
    for (tolerance, published) in [(0.1, 5), (1e-2, 7), (1e-3, 11), (1e-4, 18), (1e-5, 33), (1e-6, 57)] {
        let found = reduce_degree(&quintic(), &Reduction::within(tolerance, Some(3))).expect("reduces");
        let points = found.curve.homogeneous_points().len();
        println!("{tolerance:e}: {points} points, {:e}", found.deviation.at_most);
        assert!(found.deviation.at_most <= tolerance && points <= published, "{tolerance} {points}");
        assert!(sampled(&quintic(), &found.curve, 20_001) <= tolerance);
    }
    for tolerance in [1.0, 1e-2] {
        let any = reduce_degree(&spatial(), &Reduction::within(tolerance, None)).expect("reduces");
        for degree in 1..5 {
            let one =
                reduce_degree(&spatial(), &Reduction::within(tolerance, Some(degree))).expect("reduces");
            assert!(one.deviation.at_most <= tolerance);
            assert!(any.curve.homogeneous_points().len() <= one.curve.homogeneous_points().len());
        }
    }
    // What the knots of the curve allow takes no more.
    let found = reduce_degree(&cubic().raised(2).expect("valid"), &Reduction::within(1e-9, Some(3)));
    assert_eq!(found.expect("reduces").curve.knots(), cubic().knots());
    let hopeless = reduce_degree(&quintic(), &Reduction::within(1e-16, Some(2)));
    assert!(matches!(hopeless, Err(ReductionError::NotReached { tolerance: 1e-16, .. })), "{hopeless:?}");
}

#[test]
fn knots_keep_the_smoothness_or_are_given() {
    // A corner at 0.5 and a double knot at 0.7, over an interval of its own.
    let knots = Knots::clamped(4, -1.0, &[0.5, 0.5, 0.5, 0.5, 0.7, 0.7], 3.0).expect("valid");
    let points: Vec<[f64; 2]> = (0..11).map(|k| [f64::from(k), f64::from(k * k % 7)]).collect();
    let curve = NurbsCurve::with_knots(knots, &points, &[1.0; 11]).expect("valid");
    let kept = |degree| reduced(&curve, degree, Weights::Free).curve.knots().inner().to_vec();
    assert_eq!(kept(3), [0.5, 0.5, 0.5, 0.7]);
    assert_eq!(kept(2), [0.5, 0.5, 0.7]);
    assert_eq!(kept(1), [0.5, 0.7]);
    let given = Knots::clamped(3, -1.0, &[0.0, 0.5, 0.5, 0.5, 1.0], 3.0).expect("valid");
    let found = reduce_degree(&curve, &Reduction::onto(given.clone())).expect("reduces");
    assert_eq!(found.curve.knots(), &given);
    assert!(found.deviation.at_most < 1.01 * found.optimum);
    assert!(found.deviation.at_most >= sampled(&curve, &found.curve, 20_001));
}

#[test]
fn curves_without_extent_or_with_coincident_points() {
    let still = NurbsCurve::bezier(&[[3.0, -4.0]; 5]).expect("valid");
    let found = reduced(&still, 2, Weights::Free);
    assert!(found.deviation.at_most < 1e-13);
    assert!(found.curve.control_points().all(|p| (p[0] - 3.0).hypot(p[1] + 4.0) < 1e-13));
    let tangents = Reduction { ends: Ends::Tangents, ..Reduction::to(3) };
    assert_eq!(reduce_degree(&still, &tangents), Err(ReductionError::NoTangent(0.0)));
    // Standing still at the start, coming back to it at the end.
    let loops = [[0.0, 0.0], [0.0, 0.0], [8.0, 1.0], [9.0, 7.0], [1.0, 8.0], [0.0, 0.0]];
    let closed = NurbsCurve::bezier(&loops).expect("valid");
    for weights in [Weights::Ones, Weights::Inner, Weights::Free] {
        for degree in 2..5 {
            let found = reduced(&closed, degree, weights.clone());
            assert!(found.deviation.at_most < 1.02 * found.optimum, "{degree} {weights:?} {found:?}");
        }
    }
}

#[test]
fn what_cannot_be_is_named() {
    let curve = quintic();
    let error = |reduction: Reduction| reduce_degree(&curve, &reduction).expect_err("refused");
    for degree in [0, 5, 6, usize::MAX] {
        assert_eq!(error(Reduction::to(degree)), ReductionError::Degree { degree, curve: 5 });
        let tolerance = Reduction::within(1.0, Some(degree));
        assert_eq!(error(tolerance), ReductionError::Degree { degree, curve: 5 });
    }
    for tolerance in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(error(Reduction::within(tolerance, None)), ReductionError::Tolerance(tolerance));
    }
    assert!(matches!(error(Reduction::within(f64::NAN, None)), ReductionError::Tolerance(_)));
    let line = NurbsCurve::bezier(&[[0.0, 0.0], [1.0, 0.0]]).expect("valid");
    let degree = ReductionError::Degree { degree: 0, curve: 1 };
    assert_eq!(reduce_degree(&line, &Reduction::within(1.0, None)), Err(degree));
    let elsewhere = Knots::bezier(3, 0.0, 2.0).expect("valid");
    let domain = ReductionError::Domain { lower: 0.0, upper: 1.0, from: 0.0, to: 2.0 };
    assert_eq!(error(Reduction::onto(elsewhere.clone())), domain);
    let short = curve.with_domain(0.0, 2.0).expect("valid");
    assert_eq!(deviation(&curve, &short), Err(domain));
    let with = |weights: Vec<f64>| Reduction { weights: Weights::Given(weights), ..Reduction::to(3) };
    let count = NurbsError::WeightCount { weights: 3, points: 4 };
    assert_eq!(error(with(vec![1.0; 3])), ReductionError::Curve(count));
    for bad in [0.0, -1.0, f64::INFINITY] {
        let weight = NurbsError::Weight { index: 2, value: bad };
        assert_eq!(error(with(vec![1.0, 1.0, bad, 1.0])), ReductionError::Curve(weight));
    }
    let target = Target::Tolerance { tolerance: 1.0, degree: Some(3) };
    let unknown = Reduction { target, ..with(vec![1.0; 4]) };
    assert_eq!(error(unknown), ReductionError::WeightsWithoutKnots(4));
    let tangents = Reduction { ends: Ends::Tangents, ..Reduction::to(2) };
    assert_eq!(error(tangents), ReductionError::TooFewForTangents(3));
}

#[test]
fn the_unit_and_the_origin_mean_nothing() {
    let weights = [1.0, 0.7, 1.5, 1.0, 1.2, 0.9];
    let place = |factor: f64, x: f64, y: f64, weight: f64| {
        let points: Vec<[f64; 2]> =
            quintic().control_points().map(|p| [factor * p[0] + x, factor * p[1] + y]).collect();
        NurbsCurve::rational_bezier(&points, &weights.map(|w| w * weight)).expect("valid")
    };
    for weights in [Weights::Ones, Weights::Inner, Weights::Free] {
        let plain = reduced(&place(1.0, 0.0, 0.0, 1.0), 3, weights.clone());
        for (factor, x, y, weight) in [(1e-9, 0.0, 0.0, 7.0), (1e12, 0.0, 0.0, 1e-8), (1.0, 1e3, -1e3, 1.0)] {
            let other = reduced(&place(factor, x, y, weight), 3, weights.clone());
            // Coordinates of 1e3 have lost three digits of sixteen, paths of Newton steps some more.
            let ratio = other.deviation.at_most / factor / plain.deviation.at_most;
            assert!((ratio - 1.0).abs() < 1e-6, "{factor} {ratio}");
        }
        let back = reduced(&place(1.0, 0.0, 0.0, 1.0).reversed(), 3, weights.clone());
        let ratio = back.deviation.at_most / plain.deviation.at_most;
        assert!((ratio - 1.0).abs() < 2e-3, "{weights:?} {ratio}");
    }
}

/// Curves of a degree, with inner knots of any multiplicity it allows.
fn curves(degree: usize) -> impl Strategy<Value = NurbsCurve<2>> {
    let inner = prop::collection::vec((1..20_u32, 1..=degree), 0..4);
    (inner, prop::collection::vec((-10.0..10.0_f64, -10.0..10.0_f64, 0.3..3.0_f64), 40)).prop_map(
        move |(mut inner, points)| {
            inner.sort_unstable();
            inner.dedup_by_key(|(place, _)| *place);
            let inner: Vec<f64> = inner
                .into_iter()
                .flat_map(|(place, times)| std::iter::repeat_n(f64::from(place) / 10.0, times))
                .collect();
            let knots = Knots::clamped(degree, 0.0, &inner, 2.0).expect("valid");
            let count = knots.points();
            let weights: Vec<f64> = points.iter().take(count).map(|p| p.2).collect();
            let points: Vec<[f64; 2]> = points.iter().take(count).map(|p| [p.0, p.1]).collect();
            NurbsCurve::with_knots(knots, &points, &weights).expect("valid")
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn raised_and_reduced_is_the_same(
        curve in (1..5_usize).prop_flat_map(curves), times in 1..3_usize, inner in any::<bool>()
    ) {
        let raised = curve.raised(times).expect("valid");
        let weights = if inner { Weights::Inner } else { Weights::Free };
        let found = reduced(&raised, curve.degree(), weights);
        prop_assert_eq!(found.curve.knots(), curve.knots());
        // 1e-12 of a size of 28 at most.
        prop_assert!(found.deviation.at_most < 1e-12 * 28.0, "{:e}", found.deviation.at_most);
        let factor = curve.weights().next().expect("one") / found.curve.weights().next().expect("one");
        for (a, b) in found.curve.homogeneous_points().iter().zip(curve.homogeneous_points()) {
            // The basis of a raised cubic amplifies roundings by some hundreds.
            prop_assert!((a.weight * factor - b.weight).abs() < 1e-10 * b.weight);
            let off = a.point().iter().zip(b.point()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            prop_assert!(off < 1e-10 * 28.0, "{off:e}");
        }
    }

    #[test]
    fn a_deviation_is_never_below_a_sample(
        a in (1..5_usize).prop_flat_map(curves), b in (1..5_usize).prop_flat_map(curves)
    ) {
        let said = deviation(&a, &b).expect("one domain");
        let seen = sampled(&a, &b, 5001);
        prop_assert!(said.at_most >= seen, "{} {seen}", said.at_most);
        // Close from above too, and attained where it says.
        prop_assert!(said.at_most <= said.attained * (1.0 + 1.1e-6) + 1e-12);
        prop_assert!(said.attained * (1.0 + 1.1e-6) + 1e-12 >= seen);
        let (p, q) = (a.point(said.at), b.point(said.at));
        prop_assert!(((p[0] - q[0]).hypot(p[1] - q[1]) - said.attained).abs() < 1e-12);
    }

    #[test]
    fn extremes_are_answered_or_named(
        scale in -70..70_i32, spread in 0..14_i32, knot in prop_oneof![Just(1e-14), Just(1e-6), Just(0.5), Just(1.999_999)],
        points in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, 0.0..1.0_f64), 6),
        kind in 0..3_usize, degree in 1..4_usize, tangents in any::<bool>()
    ) {
        let weights: Vec<f64> = points.iter().map(|p| 10_f64.powf(f64::from(spread) * p.2)).collect();
        let factor = 10_f64.powi(scale);
        let points: Vec<[f64; 2]> = points.iter().map(|p| [factor * p.0, factor * p.1]).collect();
        let knots = Knots::clamped(4, 0.0, &[knot], 2.0).expect("valid");
        let curve = NurbsCurve::with_knots(knots, &points, &weights).expect("valid");
        let weights = [Weights::Ones, Weights::Inner, Weights::Free][kind].clone();
        let ends = if tangents { Ends::Tangents } else { Ends::Points };
        match reduce_degree(&curve, &Reduction { weights, ends, ..Reduction::to(degree) }) {
            Ok(found) => {
                let Deviation { at_most, attained, at } = found.deviation;
                prop_assert!(at_most.is_finite() && attained <= at_most && (0.0..=2.0).contains(&at));
                prop_assert!(at_most >= sampled(&curve, &found.curve, 1001));
                prop_assert!(found.optimum >= 0.0 && found.optimum <= at_most);
            }
            Err(error) => prop_assert!(matches!(
                error,
                ReductionError::TooFewForTangents(_) | ReductionError::NoTangent(_)
                    | ReductionError::Curve(NurbsError::WeightRatio { .. } | NurbsError::Weight { .. })
            ), "{error}"),
        }
    }

    #[test]
    fn any_curve_is_reduced_to_its_optimum(
        curve in (2..6_usize).prop_flat_map(curves), down in 1..3_usize, kind in 0..3_usize, tangents in any::<bool>()
    ) {
        let degree = curve.degree().saturating_sub(down).max(1);
        let weights = [Weights::Ones, Weights::Inner, Weights::Free][kind].clone();
        let ends = if tangents { Ends::Tangents } else { Ends::Points };
        let reduction = Reduction { weights, ends, ..Reduction::to(degree) };
        match reduce_degree(&curve, &reduction) {
            Ok(found) => {
                prop_assert!(found.deviation.at_most >= sampled(&curve, &found.curve, 2001));
                prop_assert!(found.optimum <= found.deviation.at_most);
                // 1 % with fixed weights, 2 % with free ones; nothing to gain below rounding.
                let tolerance = if kind == 0 { 1.01 } else { 1.02 };
                prop_assert!(
                    found.deviation.at_most <= tolerance * found.optimum + 1e-12 * 28.0,
                    "{:e} {:e}", found.deviation.at_most, found.optimum
                );
            }
            // Shrinking leads to end points that coincide with their neighbours.
            Err(ReductionError::TooFewForTangents(_) | ReductionError::NoTangent(_)) => prop_assert!(tangents),
            Err(error) => prop_assert!(false, "{error}"),
        }
    }
}

#[test]
fn the_highest_degree_is_reduced_too() {
    let points: Vec<[f64; 2]> = (0..16).map(|k| [f64::from(k), f64::from(k * k % 11)]).collect();
    let weights: Vec<f64> = (0..16).map(|k| 1.0 + 0.1 * f64::from(k * 7 % 10)).collect();
    let curve = NurbsCurve::rational_bezier(&points, &weights).expect("valid");
    for degree in [14, 11, 8, 5, 2, 1] {
        for weights in [Weights::Ones, Weights::Inner, Weights::Free] {
            let found = reduced(&curve, degree, weights.clone());
            println!("{degree} {weights:?}: {:e} {:e}", found.deviation.at_most, found.optimum);
            // At a hundred-millionth of the size the roundings of such polynomials begin.
            let rounding = 1e-8 * 15.0;
            assert!(found.deviation.at_most < 1.02 * found.optimum + rounding, "{degree} {weights:?}");
        }
    }
    let back = reduced(
        &NurbsCurve::rational_bezier(&points[..13], &weights[..13]).expect("valid").raised(3).expect("valid"),
        12,
        Weights::Free,
    );
    assert!(back.deviation.at_most < 1e-11, "{:e}", back.deviation.at_most);
}
