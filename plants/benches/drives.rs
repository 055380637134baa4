//! Cost of a step of a drive.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use plants::nalgebra::{SVector, vector};
use plants::{
    PmsmDrive, PmsmWindings, Rk4, Stepper, TransferFunction, TransportDelay, TwoInertia, ZeroOrderHold,
};

fn axis() -> Option<TwoInertia> {
    TwoInertia::new(0.003, 5.066e-4, 100.0).and_then(|axis| axis.with_damping(0.008, 0.006, 0.0)).ok()
}

// A run of so many steps, so that the state stays where a loop keeps it.
const STEPS: u64 = 100;

/// The two-inertia axis under a held torque, exactly.
fn exact_tick(criterion: &mut Criterion) {
    let Some(axis) = axis() else { return };
    let Ok(discrete) = axis.state_space().and_then(|system| system.discretise(1e-4)) else { return };
    let mut group = criterion.benchmark_group("two-inertia tick");
    group.throughput(Throughput::Elements(STEPS));
    let torque = vector![0.1, 0.0];
    group.bench_function("discrete state space", |b| {
        let mut x = vector![0.01, 0.0, 0.0, 0.0];
        b.iter(|| {
            for _ in 0..STEPS {
                x = discrete.step(&x, black_box(&torque));
            }
        });
    });
    group.bench_function("zero-order hold", |b| {
        let mut stepper = ZeroOrderHold::new(axis);
        let mut x = vector![0.01, 0.0, 0.0, 0.0];
        b.iter(|| {
            for _ in 0..STEPS {
                if let Ok(next) = stepper.advance(&x, black_box(&torque), black_box(1e-4)) {
                    x = next;
                }
            }
        });
    });
    group.bench_function("zero-order hold with its ledger", |b| {
        let mut stepper = ZeroOrderHold::new(axis).metered();
        let mut x = vector![0.01, 0.0, 0.0, 0.0];
        b.iter(|| {
            for _ in 0..STEPS {
                if let Ok(next) = stepper.advance(&x, black_box(&torque), black_box(1e-4)) {
                    x = next;
                }
            }
        });
    });
    group.finish();
}

/// The numbers of the hand-written drive.
#[derive(Clone, Copy)]
struct ByHand {
    r: f64,
    l: f64,
    psi: f64,
    p: f64,
    kt: f64,
    jm: f64,
    jl: f64,
    k: f64,
    cm: f64,
    cs: f64,
}

impl ByHand {
    #[inline(always)]
    fn derivative(&self, x: &[f64; 6], u: &[f64; 3]) -> [f64; 6] {
        let we = self.p * x[3];
        let ts = self.k * (x[2] - x[4]) + self.cs * (x[3] - x[5]);
        [
            (u[0] - self.r * x[0] + we * self.l * x[1]) * (1.0 / self.l),
            (u[1] - self.r * x[1] - we * (self.l * x[0] + self.psi)) * (1.0 / self.l),
            x[3],
            (self.kt * x[1] - ts - self.cm * x[3]) * (1.0 / self.jm),
            x[5],
            (ts - u[2]) * (1.0 / self.jl),
        ]
    }

    #[inline(always)]
    fn step(&self, x: &[f64; 6], u: &[f64; 3], h: f64) -> [f64; 6] {
        let along = |k: &[f64; 6], h: f64| -> [f64; 6] { std::array::from_fn(|i| x[i] + h * k[i]) };
        let k1 = self.derivative(x, u);
        let k2 = self.derivative(&along(&k1, 0.5 * h), u);
        let k3 = self.derivative(&along(&k2, 0.5 * h), u);
        let k4 = self.derivative(&along(&k3, h), u);
        std::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    }
}

/// One Runge-Kutta step of a synchronous motor on a two-inertia axis.
fn drive_step(criterion: &mut Criterion) {
    let windings = PmsmWindings::surface(2.875, 8.5e-3, 0.175, 3);
    let (Some(axis), Ok(windings)) = (axis(), windings) else { return };
    let Ok(limited) = windings.with_voltage_limit(300.0) else { return };
    let hand = ByHand {
        r: 2.875,
        l: 8.5e-3,
        psi: 0.175,
        p: 3.0,
        kt: 0.7875,
        jm: 0.003,
        jl: 5.066e-4,
        k: 100.0,
        cm: 0.008,
        cs: 0.006,
    };
    let voltage = [1.0, 12.0, 0.1];
    let mut group = criterion.benchmark_group("PMSM drive, one RK4 step");
    group.throughput(Throughput::Elements(STEPS));
    group.bench_function("by hand", |b| {
        let (mut x, hand) = ([0.0; 6], black_box(hand));
        b.iter(|| {
            for _ in 0..STEPS {
                x = hand.step(&x, black_box(&voltage), black_box(1e-4));
            }
        });
    });
    for (name, windings) in [("Rk4", windings), ("Rk4, voltage limit", limited)] {
        let Ok(mut stepper) = Rk4::fixed(PmsmDrive::new(windings, axis), 1, 500.0) else { return };
        group.bench_function(name, |b| {
            let mut x = SVector::<f64, 6>::zeros();
            let voltage = SVector::from(voltage);
            b.iter(|| {
                for _ in 0..STEPS {
                    if let Ok(next) = stepper.advance(&x, black_box(&voltage), black_box(1e-4)) {
                        x = next;
                    }
                }
            });
        });
        let mut metered = stepper.metered();
        group.bench_function(format!("{name}, with its ledger"), |b| {
            let mut x = SVector::<f64, 6>::zeros();
            let voltage = SVector::from(voltage);
            b.iter(|| {
                for _ in 0..STEPS {
                    if let Ok(next) = metered.advance(&x, black_box(&voltage), black_box(1e-4)) {
                        x = next;
                    }
                }
            });
        });
    }
    group.finish();
}

fn delay(criterion: &mut Criterion) {
    let Ok(mut line) = TransportDelay::new(3.3e-3, 1e-4) else { return };
    criterion.bench_function("transport delay", |b| b.iter(|| line.update(black_box(1.0)).mean()));
}

/// A vibration with a lead under a held input, exactly.
fn transfer_tick(criterion: &mut Criterion) {
    let Ok(belt) = TransferFunction::second_order(1.15, 7.54, 0.2, 0.092) else { return };
    let discrete = belt.to_state_space::<2>().and_then(|system| system.discretise(1e-3));
    let (Ok(discrete), Ok(mut held)) = (discrete, belt.held(1e-3)) else { return };
    let mut group = criterion.benchmark_group("transfer function of order 2, a tick");
    group.throughput(Throughput::Elements(STEPS));
    group.bench_function("by hand", |b| {
        let (phi, gamma, c) = (discrete.transition().state, discrete.transition().input, discrete.c());
        let hand = [phi[(0, 0)], phi[(0, 1)], phi[(1, 0)], phi[(1, 1)], gamma[0], gamma[1], c[0], c[1]];
        let ([p, q, r, s, g, h, c, d], mut x, mut y) = (black_box(hand), 0.0, 0.0);
        b.iter(|| {
            for _ in 0..STEPS {
                let u = black_box(1.0);
                black_box(c * x + d * y);
                (x, y) = (p * x + q * y + g * u, r * x + s * y + h * u);
            }
        });
    });
    group.bench_function("DiscreteStateSpace", |b| {
        let mut x = vector![0.0, 0.0];
        b.iter(|| {
            for _ in 0..STEPS {
                let u = vector![black_box(1.0)];
                black_box(discrete.output(&x, &u));
                x = discrete.step(&x, &u);
            }
        });
    });
    group.bench_function("HeldTransferFunction", |b| {
        b.iter(|| {
            for _ in 0..STEPS {
                black_box(held.update(black_box(1.0)));
            }
        });
    });
    group.finish();
    criterion.bench_function("transfer function of order 2, discretise", |b| {
        b.iter(|| {
            black_box(&belt).to_state_space::<2>().and_then(|system| system.discretise(black_box(1e-3)))
        })
    });
}

criterion_group!(benches, exact_tick, drive_step, transfer_tick, delay);
criterion_main!(benches);
