//! One tick of contour error and coupling for three axes, in f64 and f32, beside the printed formulas by hand.

use control::{CommandedPath, CrossCoupling, PathFrame};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

const TICKS: u32 = 1024;

macro_rules! bench_ticks {
    ($name:ident, $real:ident) => {
        fn $name(criterion: &mut Criterion) {
            type Vector = [$real; 3];
            // Point, velocity, acceleration of the paper's helix, and a tracking error and its rate.
            let ticks: Vec<[Vector; 5]> = (0..TICKS)
                .map(|k| {
                    let t = f64::from(k) * 1e-3;
                    let (sin, cos) = t.sin_cos();
                    let error = [0.01 * (9.0 * t).cos(), 0.02 * (7.0 * t).sin(), 0.05];
                    let rate = [-0.09 * (9.0 * t).sin(), 0.14 * (7.0 * t).cos(), 0.0];
                    [[sin, cos, 5.0 * t], [cos, -sin, 5.0], [-sin, -cos, 0.0], error, rate]
                        .map(|v| v.map(|x| x as $real))
                })
                .collect();
            let Ok(coupling) = CrossCoupling::<3, $real>::new([0.01, 0.02, 0.03]) else { return };

            let mut group = criterion.benchmark_group(stringify!($name));
            group.throughput(Throughput::Elements(u64::from(TICKS)));
            group.bench_function("commanded points", |b| {
                let mut path = CommandedPath::new();
                b.iter(|| {
                    let coupling = black_box(&coupling);
                    for [point, _, _, error, rate] in black_box(&ticks) {
                        let frame = path.update(*point);
                        black_box(coupling.couple(*error, *rate, frame.as_ref()));
                    }
                });
            });
            group.bench_function("tangent", |b| {
                b.iter(|| {
                    let coupling = black_box(&coupling);
                    for [_, velocity, _, error, rate] in black_box(&ticks) {
                        let Ok(frame) = PathFrame::along(*velocity) else { continue };
                        black_box(coupling.couple(*error, *rate, frame.as_ref()));
                    }
                });
            });
            group.bench_function("circle", |b| {
                b.iter(|| {
                    let coupling = black_box(&coupling);
                    for [_, velocity, acceleration, error, rate] in black_box(&ticks) {
                        let Ok(frame) = PathFrame::osculating(*velocity, *acceleration) else { continue };
                        black_box(coupling.couple(*error, *rate, frame.as_ref()));
                    }
                });
            });
            group.bench_function("set-points from commanded points", |b| {
                let mut path = CommandedPath::new();
                b.iter(|| {
                    let coupling = black_box(&coupling);
                    for [point, _, _, error, _] in black_box(&ticks) {
                        let frame = path.update(*point);
                        black_box(coupling.setpoints(*point, *error, frame.as_ref()));
                    }
                });
            });
            // Eq. (14) and (15) as printed, without a guard; the rate alike.
            group.bench_function("by hand", |b| {
                let (mut last, gains): (Vector, Vector) = ([0.0; 3], [0.01, 0.02, 0.03]);
                b.iter(|| {
                    let gains = black_box(&gains);
                    for [point, _, _, error, rate] in black_box(&ticks) {
                        let r: Vector = std::array::from_fn(|i| point[i] - last[i]);
                        last = *point;
                        let dot = |a: &Vector, b: &Vector| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                        let couple = |x: &Vector| -> Vector {
                            let share = dot(x, &r) / dot(&r, &r);
                            std::array::from_fn(|i| x[i] + gains[i] * (x[i] - r[i] * share))
                        };
                        black_box((couple(error), couple(rate)));
                    }
                });
            });
            group.finish();
        }
    };
}

bench_ticks!(coupling_f64, f64);
bench_ticks!(coupling_f32, f32);
criterion_group!(benches, coupling_f64, coupling_f32);
criterion_main!(benches);
