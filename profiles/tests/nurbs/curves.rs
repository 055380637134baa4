//! Random curves, and how far apart two points may be.

use profiles::nurbs::{Knots, NurbsCurve};
use proptest::prelude::*;

/// Cases per property.
pub(crate) const CASES: u32 = 256;

/// Any curve: degree 1 to 8, up to six spans of very different lengths with inner knots of any multiplicity, weights
/// from 1/5 to 5, and a scale of anything from 1e-6 to 1e6.
pub(crate) fn a_curve<const D: usize>() -> impl Strategy<Value = NurbsCurve<D>> {
    (1..=8_usize, 0..6_usize).prop_flat_map(|(degree, inner)| {
        let spans = prop::collection::vec(0.01..1.0, inner + 1);
        let multiplicities = prop::collection::vec(1..=degree, inner);
        (spans, multiplicities, -6..=6_i32, -3.0..3.0).prop_flat_map(
            move |(spans, multiplicities, scale, start)| {
                let mut knots = vec![start; degree + 1];
                let mut at = start;
                for (length, multiplicity) in spans.iter().zip(multiplicities.iter().chain([&(degree + 1)])) {
                    at += length;
                    knots.extend(std::iter::repeat_n(at, *multiplicity));
                }
                let count = knots.len() - degree - 1;
                let scale = 10.0_f64.powi(scale);
                let point = prop::array::uniform(-1.0..1.0).prop_map(move |p: [f64; D]| p.map(|x| x * scale));
                let weight = (-1.0..1.0).prop_map(|x: f64| 5.0_f64.powf(x));
                (prop::collection::vec(point, count), prop::collection::vec(weight, count)).prop_map(
                    move |(points, weights)| {
                        let knots = Knots::new(degree, knots.clone()).expect("knots");
                        NurbsCurve::with_knots(knots, &points, &weights).expect("curve")
                    },
                )
            },
        )
    })
}

/// The same with weights from 1e-14 to 1.
pub(crate) fn a_light_curve<const D: usize>() -> impl Strategy<Value = NurbsCurve<D>> {
    a_curve().prop_flat_map(|curve| {
        let exponents = prop::collection::vec(-14.0..0.0, curve.homogeneous_points().len());
        exponents.prop_map(move |exponents: Vec<f64>| {
            let weights: Vec<f64> = exponents.iter().map(|x| 10.0_f64.powf(*x)).collect();
            let points: Vec<[f64; D]> = curve.control_points().collect();
            NurbsCurve::with_knots(curve.knots().clone(), &points, &weights).expect("curve")
        })
    })
}

/// The parameter that lies `place` of the domain from its start.
pub(crate) fn at<const D: usize>(curve: &NurbsCurve<D>, place: f64) -> f64 {
    let domain = curve.domain();
    domain.lower + place * (domain.upper - domain.lower)
}

/// Largest magnitude of a coordinate of the control points.
pub(crate) fn size<const D: usize>(curve: &NurbsCurve<D>) -> f64 {
    curve.control_points().flatten().fold(0.0, |most, x| x.abs().max(most))
}

/// Largest weight over smallest: by so much a quotient can magnify roundings of the sums above and below it.
pub(crate) fn unevenness<const D: usize>(curve: &NurbsCurve<D>) -> f64 {
    curve.weights().fold(0.0, f64::max) / curve.weights().fold(f64::INFINITY, f64::min)
}

pub(crate) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

pub(crate) fn norm<const D: usize>(a: &[f64; D]) -> f64 {
    distance(a, &[0.0; D])
}

/// Both curves are the same at every one of 97 parameters, to `roundings` of the size.
pub(crate) fn are_the_same<const D: usize>(
    one: &NurbsCurve<D>,
    other: &NurbsCurve<D>,
    roundings: f64,
) -> Result<(), TestCaseError> {
    prop_assert_eq!(one.domain(), other.domain());
    for k in 0..97 {
        let u = at(one, f64::from(k) / 96.0);
        let apart = distance(&one.point(u), &other.point(u));
        let allowed = roundings * f64::EPSILON * size(one);
        prop_assert!(apart <= allowed, "at {}: {} apart, allowed {}", u, apart, allowed);
    }
    Ok(())
}
