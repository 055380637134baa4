//! One tick of three cross-coupled axes under terminal sliding mode with the improved double power law and the integral, in
//! f64 and f32, beside the same law written by hand with a power of libm for every power in it.

use control::{
    AxisModel, CrossCoupling, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState, PathFrame,
    ReachingLaw, Sampling, SlidingMode, SlidingModeInput, SlidingModeState, SlidingSurface, SuperTwisting,
    SuperTwistingState,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use profiles::{Real, Sample};
use std::hint::black_box;

const TICKS: u32 = 1024;

/// Reference, position and velocity of three axes.
struct Tick<F> {
    references: [Sample<F>; 3],
    positions: [F; 3],
    velocities: [F; 3],
}

macro_rules! bench_axes {
    ($name:ident, $real:ident) => {
        fn $name(criterion: &mut Criterion) {
            /// The law without sharing: three axes, lambda times the contour error added, no checks.
            struct ByHand {
                lambda: $real,
                integral: [$real; 3],
            }
            impl ByHand {
                #[inline]
                fn update(&mut self, tick: &Tick<$real>) -> [$real; 3] {
                    let errors: [$real; 3] =
                        core::array::from_fn(|i| tick.references[i].position - tick.positions[i]);
                    let rates: [$real; 3] =
                        core::array::from_fn(|i| tick.references[i].velocity - tick.velocities[i]);
                    let along: [$real; 3] = core::array::from_fn(|i| tick.references[i].velocity);
                    let dot = |a: &[$real; 3], b: &[$real; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                    let squared = dot(&along, &along);
                    let (t, t_rate) = (dot(&errors, &along) / squared, dot(&rates, &along) / squared);
                    core::array::from_fn(|i| {
                        let e = errors[i] + self.lambda * (errors[i] - t * along[i]);
                        let rate = rates[i] + self.lambda * (rates[i] - t_rate * along[i]);
                        let power = |x: $real, a: $real| Real::powf(x.abs(), a);
                        let (five_ninths, third) = (5.0 / 9.0, 1.0 / 3.0);
                        let s = rate + 10.0 * e + power(e, five_ninths).copysign(e);
                        self.integral[i] += 0.02 * e;
                        let u = tick.references[i].acceleration
                            + 10.0 * tick.velocities[i]
                            + tick.positions[i]
                            + 10.0 * rate
                            + five_ninths * power(e, five_ninths - 1.0) * rate
                            + 20.0 * power(s, 5.0 / 3.0).copysign(s)
                            + 20.0 * power(s, third).copysign(s)
                            + 200.0 * power(e, third) * s
                            + self.integral[i];
                        u.max(-400.0).min(400.0)
                    })
                }
            }

            let ticks: Vec<Tick<$real>> = (0..TICKS)
                .map(|k| {
                    let t = f64::from(k) * 1e-2;
                    let sample = |p: f64, v: f64, a: f64| Sample {
                        position: p as $real,
                        velocity: v as $real,
                        acceleration: a as $real,
                        ..Sample::default()
                    };
                    let (sine, cosine) = t.sin_cos();
                    let references = [
                        sample(sine, cosine, -sine),
                        sample(cosine, -sine, -cosine),
                        sample(5.0 * t, 5.0, 0.0),
                    ];
                    // Errors from a metre to a micrometre, of either sign.
                    let error = |phase: f64| (7.3 * t + phase).sin() * 10_f64.powf(-6.0 * (0.37 * t).fract());
                    let positions =
                        core::array::from_fn(|i| references[i].position - error(i as f64) as $real);
                    let velocities = core::array::from_fn(|i| {
                        references[i].velocity - 10.0 * error(2.0 + i as f64) as $real
                    });
                    Tick { references, positions, velocities }
                })
                .collect();

            let third = 1.0 / 3.0;
            let surface = SlidingSurface::<$real>::terminal(10.0, 1.0, 9, 5).expect("valid");
            let law = ReachingLaw::improved_double_power(20.0, 20.0, 200.0, third, third).expect("valid");
            let model = AxisModel::new(10.0, 1.0, 1.0).expect("valid");
            let printed = SlidingMode::new(surface, law, model, 1e-3)
                .and_then(|c| c.with_integral_compensation(20.0))
                .and_then(|c| c.with_output_limits(-400.0, 400.0))
                .expect("valid");
            let matched = printed.with_sampling(Sampling::Matched).expect("valid");
            let coupling = CrossCoupling::uniform(0.01).expect("valid");
            let flat = SlidingSurface::linear(10.0).expect("valid");
            let twisting = SuperTwisting::for_load_rate(flat, 100.0, model, 1e-3)
                .and_then(|c| c.with_sampling(Sampling::Matched).with_output_limits(-400.0, 400.0))
                .expect("valid");
            let observer = DisturbanceObserver::new(model, 300.0, 1e-3).expect("valid");
            let linear =
                SlidingMode::new(flat, ReachingLaw::exponential(50.0, 0.0).expect("valid"), model, 1e-3)
                    .and_then(|c| c.with_output_limits(-400.0, 400.0))
                    .expect("valid");

            let inputs = |tick: &Tick<$real>, coupling: &CrossCoupling<3, $real>| {
                let path = PathFrame::along(tick.references.map(|r| r.velocity)).unwrap_or_default();
                let single: [SlidingModeInput<$real>; 3] = core::array::from_fn(|i| {
                    SlidingModeInput::new(&tick.references[i], tick.positions[i], tick.velocities[i])
                });
                let coupled =
                    coupling.couple(single.map(|s| s.error), single.map(|s| s.error_rate), path.as_ref());
                let pair: [SlidingModeInput<$real>; 3] =
                    core::array::from_fn(|i| single[i].with_error(coupled.errors[i], coupled.rates[i]));
                pair
            };

            let mut group = criterion.benchmark_group(stringify!($name));
            group.throughput(Throughput::Elements(u64::from(TICKS)));
            for (id, controller) in [("shared logarithms", printed), ("shared logarithms, matched", matched)]
            {
                group.bench_function(id, |b| {
                    let mut axes = [SlidingModeState::new(); 3];
                    b.iter(|| {
                        let (controller, coupling) = black_box((&controller, &coupling));
                        for tick in black_box(&ticks) {
                            for (axis, input) in axes.iter_mut().zip(inputs(tick, coupling)) {
                                black_box(controller.update(axis, input));
                            }
                        }
                    });
                });
            }
            group.bench_function("by hand, five powers an axis", |b| {
                let mut axes = ByHand { lambda: black_box(0.01), integral: [0.0; 3] };
                b.iter(|| {
                    for tick in black_box(&ticks) {
                        black_box(axes.update(tick));
                    }
                });
            });
            group.bench_function("super-twisting", |b| {
                let mut axes = [SuperTwistingState::new(); 3];
                b.iter(|| {
                    let (controller, coupling) = black_box((&twisting, &coupling));
                    for tick in black_box(&ticks) {
                        for (axis, input) in axes.iter_mut().zip(inputs(tick, coupling)) {
                            black_box(controller.update(axis, input));
                        }
                    }
                });
            });
            group.bench_function("linear law with observers", |b| {
                let mut axes = [(SlidingModeState::new(), DisturbanceObserverState::new()); 3];
                b.iter(|| {
                    let (controller, coupling) = black_box((&linear, &coupling));
                    for tick in black_box(&ticks) {
                        for ((axis, seen), input) in axes.iter_mut().zip(inputs(tick, coupling)) {
                            let measured =
                                DisturbanceInput { position: input.position, realised: axis.output() };
                            let load = observer.update(seen, measured).load;
                            black_box(controller.update(axis, SlidingModeInput { load, ..input }));
                        }
                    }
                });
            });
            group.finish();
        }
    };
}

bench_axes!(three_axes_f64, f64);
bench_axes!(three_axes_f32, f32);
criterion_group!(benches, three_axes_f64, three_axes_f32);
criterion_main!(benches);
