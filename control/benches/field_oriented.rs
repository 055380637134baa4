//! One base tick of field-oriented control, in f64 and f32, beside a loop written by hand without checks; in each the
//! winding, two multiplications and additions an axis, closes the loop from voltage to current.

use control::{
    Cascade, CurrentLoop, Dq, Feedforward, FieldOriented, FieldOrientedInput, FieldOrientedState, PiGains,
    Rotation, Windings,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use profiles::Sample;
use std::hint::black_box;

const TICKS: u32 = 1024;

macro_rules! bench_ticks {
    ($name:ident, $real:ident) => {
        fn $name(criterion: &mut Criterion) {
            /// What one writes by hand: every loop at every tick, clamped integrals, the voltage scaled into the circle.
            #[derive(Default)]
            struct HandWritten {
                velocity_integral: $real,
                d_integral: $real,
                q_integral: $real,
            }
            impl HandWritten {
                #[inline]
                fn update(&mut self, input: &FieldOrientedInput<$real>) -> Dq<$real> {
                    let reference = &input.reference;
                    let command = 180.0 * (reference.position - input.position) + reference.velocity;
                    let error = command - input.velocity;
                    self.velocity_integral = (self.velocity_integral + 33e-4 * error).clamp(-20.0, 20.0);
                    let feedforward = 5.2e-3 * reference.acceleration;
                    let wanted = (2.3 * error + self.velocity_integral + feedforward).clamp(-20.0, 20.0);
                    let w = 3.0 * input.velocity;
                    let (d_error, q_error) = (-input.current.d, wanted - input.current.q);
                    self.d_integral = (self.d_integral + 0.566 * d_error).clamp(-180.0, 180.0);
                    self.q_integral = (self.q_integral + 0.566 * q_error).clamp(-180.0, 180.0);
                    let d = 16.7 * d_error + self.d_integral - w * 8.5e-3 * input.current.q;
                    let q = 16.7 * q_error + self.q_integral + w * (8.5e-3 * input.current.d + 0.175);
                    let squared = d * d + q * q;
                    if squared > 32400.0 {
                        let scale = 180.0 / squared.sqrt();
                        return Dq { d: scale * d, q: scale * q };
                    }
                    Dq { d, q }
                }
            }

            let inputs: Vec<FieldOrientedInput<$real>> = (0..TICKS)
                .map(|k| {
                    let t = f64::from(k) * 1e-4;
                    let reference = Sample {
                        position: (20.0 * t).sin() as $real,
                        velocity: 20.0 * (20.0 * t).cos() as $real,
                        acceleration: -400.0 * (20.0 * t).sin() as $real,
                        ..Sample::default()
                    };
                    let position = (20.0 * t - 0.01).sin() as $real;
                    let velocity = 20.0 * (20.0 * t - 0.01).cos() as $real;
                    FieldOrientedInput::new(reference, position, velocity, Dq::default())
                })
                .collect();
            /// `i + h / L (v - R i - emf)` on a decoupled axis.
            #[inline]
            fn flowing(i: Dq<$real>, v: Dq<$real>, emf: $real) -> Dq<$real> {
                Dq { d: 0.966 * i.d + 0.0118 * v.d, q: 0.966 * i.q + 0.0118 * (v.q - emf) }
            }

            let windings =
                Windings { resistance: 2.875, d_inductance: 8.5e-3, q_inductance: 8.5e-3, flux: 0.175 };
            let current_loop = CurrentLoop::<$real>::tuned(windings, 1970.0, 1e-4)
                .and_then(|l| l.with_voltage_limit(180.0))
                .expect("valid");
            let feedforward = Feedforward::NONE.with_acceleration(5.2e-3).expect("valid");
            let cascade = Cascade::new(180.0, PiGains { kp: 2.3, ki: 33.0 }, 1e-4)
                .and_then(|c| c.with_velocity_feedforward(1.0))
                .and_then(|c| c.with_current_limit(20.0))
                .expect("valid")
                .with_feedforward(feedforward);
            let divided = cascade.with_divisors(10, 2).expect("valid");

            let mut group = criterion.benchmark_group(stringify!($name));
            group.throughput(Throughput::Elements(u64::from(TICKS)));
            for (id, cascade) in [("every tick", cascade), ("divisors 10 and 2", divided)] {
                let control = FieldOriented::new(cascade, current_loop, 3).expect("valid");
                group.bench_function(id, |b| {
                    let mut state = FieldOrientedState::new();
                    let mut current = Dq::default();
                    b.iter(|| {
                        let control = black_box(&control);
                        for input in black_box(&inputs) {
                            let output = control.update(&mut state, FieldOrientedInput { current, ..*input });
                            current = flowing(current, output.voltage, 0.525 * input.velocity);
                        }
                        current
                    });
                });
            }
            let control = FieldOriented::new(cascade, current_loop, 3).expect("valid");
            group.bench_function("every tick, in phases, with the angle", |b| {
                let mut state = FieldOrientedState::new();
                let mut current = Dq::default();
                b.iter(|| {
                    let control = black_box(&control);
                    for input in black_box(&inputs) {
                        let rotor = Rotation::by(3.0 * input.position);
                        let currents = current.to_phases(rotor);
                        let (_, voltages) = control.update_phases(&mut state, *input, currents, rotor);
                        current = flowing(current, voltages.to_dq(rotor), 0.525 * input.velocity);
                    }
                    current
                });
            });
            group.bench_function("by hand, every tick", |b| {
                let mut control = HandWritten::default();
                let mut current = Dq::default();
                b.iter(|| {
                    for input in black_box(&inputs) {
                        let voltage = control.update(&FieldOrientedInput { current, ..*input });
                        current = flowing(current, voltage, 0.525 * input.velocity);
                    }
                    current
                });
            });
            group.finish();
        }
    };
}

bench_ticks!(tick_f64, f64);
bench_ticks!(tick_f32, f32);
criterion_group!(benches, tick_f64, tick_f32);
criterion_main!(benches);
