//! Points, derivatives, lengths and bounds of curves, points beside the recursion as it is written down in the same run.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use profiles::nurbs::{ArcLength, Knots, NurbsCurve, Side};

/// A rational curve in space with so many control points and uneven knots.
fn curve(degree: usize, count: u32) -> NurbsCurve<3> {
    let part = |k: u32, stride: f64| (f64::from(k) * stride).fract();
    let points: Vec<[f64; 3]> =
        (0..count).map(|k| [f64::from(k), 10.0 * part(k, 0.618), 5.0 * part(k, 0.414)]).collect();
    let weights: Vec<f64> = (0..count).map(|k| 0.5 + part(k, 0.732)).collect();
    let spans = count - degree as u32;
    let inner: Vec<f64> =
        (1..spans).map(|k| (f64::from(k) + 0.8 * part(k, 0.302)) / f64::from(spans)).collect();
    let knots = Knots::clamped(degree, 0.0, &inner, 1.0).expect("knots");
    NurbsCurve::with_knots(knots, &points, &weights).expect("curve")
}

/// Parameters scattered over the curve, so that no span can be guessed from the one before.
fn parameters() -> Vec<f64> {
    (0..4096_u32).map(|k| (f64::from(k) * 0.618_033_988_749_895).fract()).collect()
}

/// The basis function by Cox and de Boor's recursion.
fn recursion(knots: &[f64], i: usize, p: usize, u: f64) -> f64 {
    if p == 0 {
        return f64::from(u8::from(knots[i] <= u && u < knots[i + 1]));
    }
    let (below, above) = (knots[i + p] - knots[i], knots[i + p + 1] - knots[i + 1]);
    let left = if below > 0.0 { (u - knots[i]) / below * recursion(knots, i, p - 1, u) } else { 0.0 };
    let right =
        if above > 0.0 { (knots[i + p + 1] - u) / above * recursion(knots, i + 1, p - 1, u) } else { 0.0 };
    left + right
}

fn by_recursion(curve: &NurbsCurve<3>, u: f64) -> [f64; 3] {
    let knots = curve.knots();
    let first = knots.inner().partition_point(|knot| *knot <= u);
    let (mut above, mut below) = ([0.0; 3], 0.0);
    for (k, point) in curve.homogeneous_points()[first..=first + curve.degree()].iter().enumerate() {
        let basis = recursion(knots.as_slice(), first + k, curve.degree(), u);
        above.iter_mut().zip(point.weighted).for_each(|(sum, x)| *sum += basis * x);
        below += basis * point.weight;
    }
    above.map(|x| x / below)
}

fn evaluate(criterion: &mut Criterion) {
    let parameters = parameters();
    let mut group = criterion.benchmark_group("nurbs");
    group.throughput(Throughput::Elements(parameters.len() as u64));
    for degree in [2, 3, 5, 7] {
        let curve = curve(degree, 51);
        group.bench_function(format!("point, degree {degree}"), |b| {
            b.iter(|| parameters.iter().for_each(|u| _ = black_box(curve.point(black_box(*u)))));
        });
        group.bench_function(format!("two derivatives, degree {degree}"), |b| {
            b.iter(|| parameters.iter().for_each(|u| _ = black_box(curve.derivatives::<3>(black_box(*u)))));
        });
    }
    let cubic = curve(3, 51);
    group.bench_function("three derivatives, degree 3", |b| {
        b.iter(|| parameters.iter().for_each(|u| _ = black_box(cubic.derivatives::<4>(black_box(*u)))));
    });
    group.bench_function("point by recursion, degree 3", |b| {
        b.iter(|| parameters.iter().for_each(|u| _ = black_box(by_recursion(&cubic, black_box(*u)))));
    });
    group.finish();
}

fn geometry(criterion: &mut Criterion) {
    let cubic = curve(3, 51);
    let parameters: Vec<f64> = parameters().into_iter().take(256).collect();
    let path = ArcLength::new(cubic.clone(), 1e-9).expect("table");
    let mut group = criterion.benchmark_group("nurbs geometry, degree 3");
    group.bench_function("arc length table of 48 spans", |b| {
        b.iter(|| ArcLength::new(black_box(&cubic).clone(), 1e-9));
    });
    group.bench_function("raise the degree of 48 spans", |b| b.iter(|| black_box(&cubic).raised(1)));
    group.bench_function("curvature bound of 48 spans", |b| {
        b.iter(|| black_box(&cubic).curvature_bound(0.0, 1.0))
    });
    group.throughput(Throughput::Elements(parameters.len() as u64));
    group.bench_function("parameter at an arc length", |b| {
        b.iter(|| {
            parameters.iter().for_each(|u| _ = black_box(path.parameter_at(black_box(*u) * path.length())))
        });
    });
    group.bench_function("derivatives by arc length", |b| {
        b.iter(|| parameters.iter().for_each(|u| _ = black_box(cubic.by_length(black_box(*u), Side::After))));
    });
    group.bench_function("closest point of 48 spans", |b| {
        let targets: Vec<[f64; 3]> = parameters.iter().map(|u| [50.0 * u, 5.0 + 3.0 * u, 2.0]).collect();
        b.iter(|| targets.iter().for_each(|target| _ = black_box(cubic.closest(black_box(*target)))));
    });
    group.finish();
}

criterion_group! {
    name = nurbs;
    config = Criterion::default();
    targets = evaluate, geometry
}
criterion_main!(nurbs);
