//! Planning and sampling, beside rsruckig in the same run.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use profiles::{Cosine, Cursor, FivePhase, Limits, Profile, SCurve, Sectioned, SnapLimited, Trapezoid};
use rsruckig::prelude::*;

/// Moves that between them meet every regime: distance, velocity, acceleration, jerk, snap.
fn moves() -> Vec<(f64, Limits)> {
    // A multiplicative lattice: same moves in every run, no two regimes in a row.
    (0..1024_u32)
        .map(|k| {
            let part = |stride: f64| (f64::from(k) * stride).fract();
            let (ramp, jerk, snap) =
                (0.02 + 0.2 * part(0.618), 0.1 + 2.4 * part(0.414), 0.1 + 2.4 * part(0.732));
            let velocity = 0.05 + part(0.302);
            let acceleration = velocity / ramp;
            let jerk_limit = acceleration / (ramp * jerk);
            let limits = Limits::new(velocity, acceleration, jerk_limit)
                .and_then(|l| l.with_snap(jerk_limit / (ramp * jerk * snap)));
            (4.0 * velocity * ramp * part(0.236), limits.expect("limits"))
        })
        .collect()
}

fn plan(criterion: &mut Criterion) {
    let moves = moves();
    let mut group = criterion.benchmark_group("plan");
    group.throughput(Throughput::Elements(moves.len() as u64));
    group.bench_function("trapezoid", |b| {
        b.iter(|| {
            for (distance, limits) in &moves {
                black_box(Trapezoid::rest_to_rest(*black_box(distance), limits).expect("plan"));
            }
        });
    });
    group.bench_function("s-curve", |b| {
        b.iter(|| {
            for (distance, limits) in &moves {
                black_box(SCurve::rest_to_rest(*black_box(distance), limits).expect("plan"));
            }
        });
    });
    group.bench_function("s-curve, slower deceleration", |b| {
        let moves: Vec<_> = moves
            .iter()
            .map(|(d, l)| (*d, l.with_deceleration(0.6 * l.acceleration().upper).expect("limits")))
            .collect();
        b.iter(|| {
            for (distance, limits) in &moves {
                black_box(SCurve::rest_to_rest(*black_box(distance), limits).expect("plan"));
            }
        });
    });
    group.bench_function("snap-limited", |b| {
        b.iter(|| {
            for (distance, limits) in &moves {
                black_box(SnapLimited::rest_to_rest(*black_box(distance), limits).expect("plan"));
            }
        });
    });
    group.bench_function("cosine", |b| {
        b.iter(|| {
            for (distance, limits) in &moves {
                black_box(Cosine::rest_to_rest(*black_box(distance), limits).expect("plan"));
            }
        });
    });
    group.bench_function("five-phase", |b| {
        b.iter(|| {
            for (distance, limits) in &moves {
                black_box(FivePhase::rest_to_rest(*black_box(distance), limits).expect("plan"));
            }
        });
    });
    group.bench_function("five-phase by jerk and phase time", |b| {
        b.iter(|| {
            for (distance, _) in &moves {
                black_box(FivePhase::new(0.0, black_box(38_564.0), 1.0 + distance, 2.0).expect("plan"));
            }
        });
    });
    group.bench_function("rsruckig, rest to rest", |b| {
        let inputs: Vec<InputParameter<1>> = moves
            .iter()
            .map(|(distance, limits)| {
                let mut input = InputParameter::new(None);
                input.target_position[0] = *distance;
                input.max_velocity[0] = limits.velocity().upper;
                input.max_acceleration[0] = limits.acceleration().upper;
                input.max_jerk[0] = limits.jerk().upper;
                input
            })
            .collect();
        let mut otg = Ruckig::<1, ThrowErrorHandler>::new(None, 1e-3);
        let mut trajectory = Trajectory::new(None);
        b.iter(|| {
            for input in &inputs {
                otg.calculate(black_box(input), &mut trajectory).expect("plan");
                black_box(trajectory.get_duration());
            }
        });
    });
    group.finish();
}

/// Instants scattered over a profile.
fn instants(duration: f64) -> Vec<f64> {
    (0..4096_u32).map(|k| duration * (f64::from(k) * 0.618_033_988_749_895).fract()).collect()
}

fn at_random<P: Profile>(profile: &P, instants: &[f64]) {
    for t in instants {
        black_box(profile.sample(*t));
    }
}

fn sample(criterion: &mut Criterion) {
    let limits = Limits::new(0.2, 4.0, 200.0).and_then(|l| l.with_snap(12_500.0)).expect("limits");
    let s_curve = SCurve::rest_to_rest(0.04, &limits).expect("plan");
    let snap_limited = SnapLimited::rest_to_rest(0.04, &limits).expect("plan");
    let cosine = Cosine::rest_to_rest(0.04, &limits).expect("plan");
    let five_phase = FivePhase::rest_to_rest(0.04, &limits).expect("plan");
    let mut group = criterion.benchmark_group("sample");
    let times = instants(s_curve.duration());
    group.throughput(Throughput::Elements(times.len() as u64));
    group.bench_function("s-curve at random times", |b| b.iter(|| at_random(black_box(&s_curve), &times)));
    group.bench_function("snap-limited at random times", |b| {
        b.iter(|| at_random(black_box(&snap_limited), &times))
    });
    group.bench_function("five-phase at random times", |b| {
        b.iter(|| at_random(black_box(&five_phase), &times))
    });
    group.bench_function("cosine at random times", |b| b.iter(|| at_random(black_box(&cosine), &times)));
    group.bench_function("rsruckig at random times", |b| {
        let mut input = InputParameter::<1>::new(None);
        input.target_position[0] = 0.04;
        input.max_velocity[0] = 0.2;
        input.max_acceleration[0] = 4.0;
        input.max_jerk[0] = 200.0;
        let mut trajectory = Trajectory::new(None);
        Ruckig::<1, ThrowErrorHandler>::new(None, 1e-3).calculate(&input, &mut trajectory).expect("plan");
        let (mut p, mut v, mut a) = (daov_stack![0.0], daov_stack![0.0], daov_stack![0.0]);
        b.iter(|| {
            for t in &times {
                trajectory.at_time(
                    *t,
                    &mut Some(&mut p),
                    &mut Some(&mut v),
                    &mut Some(&mut a),
                    &mut None,
                    &mut None,
                );
                black_box((&p, &v, &a));
            }
        });
    });
    group.finish();

    let mut group = criterion.benchmark_group("cursor");
    let period = s_curve.duration() / 4096.0;
    group.throughput(Throughput::Elements(4096));
    run_cursor(&mut group, "s-curve f64", Cursor::<_, f64>::new(s_curve, period).expect("clock"));
    run_cursor(&mut group, "s-curve f32", Cursor::<_, f32>::new(s_curve, period).expect("clock"));
    run_cursor(&mut group, "snap-limited f64", Cursor::<_, f64>::new(snap_limited, period).expect("clock"));
    run_cursor(&mut group, "snap-limited f32", Cursor::<_, f32>::new(snap_limited, period).expect("clock"));
    run_cursor(&mut group, "five-phase f64", Cursor::<_, f64>::new(five_phase, period).expect("clock"));
    run_cursor(&mut group, "five-phase f32", Cursor::<_, f32>::new(five_phase, period).expect("clock"));
    run_cursor(&mut group, "cosine f64", Cursor::<_, f64>::new(cosine, period).expect("clock"));
    group.finish();
}

fn run_cursor<P: Sectioned + Copy, F: profiles::Real>(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    name: &str,
    cursor: Cursor<P, F>,
) {
    group.bench_function(name, |b| {
        b.iter_batched_ref(
            || cursor,
            |cursor| {
                for _ in 0..4096 {
                    black_box(cursor.tick());
                }
            },
            BatchSize::SmallInput,
        );
    });
}

criterion_group! {
    name = laws;
    config = Criterion::default();
    targets = plan, sample
}
criterion_main!(laws);
