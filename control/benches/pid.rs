//! One PID tick, in f64 and f32, beside a loop written by hand without checks.

use control::{AntiWindup, Pid, PidGains, PidInput, PidState};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

const TICKS: u32 = 1024;

macro_rules! bench_ticks {
    ($name:ident, $real:ident) => {
        fn $name(criterion: &mut Criterion) {
            /// What one writes by hand: filtered derivative on the error, limits, the integral clamped.
            struct HandWritten {
                kp: $real,
                ki_h: $real,
                kd: $real,
                memory: $real,
                gain: $real,
                integral: $real,
                derivative: $real,
                error: $real,
            }
            impl HandWritten {
                #[inline]
                fn update(&mut self, setpoint: $real, measurement: $real) -> $real {
                    let error = setpoint - measurement;
                    self.integral = (self.integral + self.ki_h * error).max(-10.0).min(10.0);
                    self.derivative = self.memory * self.derivative + self.gain * (error - self.error);
                    self.error = error;
                    (self.kp * error + self.integral + self.kd * self.derivative).max(-10.0).min(10.0)
                }
            }

            let inputs: Vec<($real, $real)> = (0..TICKS)
                .map(|k| {
                    let t = f64::from(k) * 1e-3;
                    ((7.0 * t).sin() as $real, (7.0 * t - 0.2).sin() as $real)
                })
                .collect();
            let gains = PidGains { kp: 20.0, ki: 50.0, kd: 0.1 };
            let pid = Pid::<$real>::new(gains, 1e-3)
                .and_then(|p| p.with_derivative_filter(5e-3))
                .and_then(|p| p.with_output_limits(-10.0, 10.0))
                .expect("valid");
            let back =
                pid.with_anti_windup(AntiWindup::BackCalculation { tracking_time: 0.1 }).expect("valid");

            let mut group = criterion.benchmark_group(stringify!($name));
            group.throughput(Throughput::Elements(u64::from(TICKS)));
            for (id, pid) in [("clamping", pid), ("back-calculation", back)] {
                group.bench_function(id, |b| {
                    let mut state = PidState::new();
                    b.iter(|| {
                        let pid = black_box(&pid);
                        for (r, y) in black_box(&inputs) {
                            black_box(pid.update(&mut state, PidInput::new(*r, *y)));
                        }
                    });
                });
            }
            group.bench_function("by hand", |b| {
                let mut pid = black_box(HandWritten {
                    kp: 20.0,
                    ki_h: 0.05,
                    kd: 0.1,
                    memory: 5.0 / 6.0,
                    gain: 1.0 / 6e-3,
                    integral: 0.0,
                    derivative: 0.0,
                    error: 0.0,
                });
                b.iter(|| {
                    for (r, y) in black_box(&inputs) {
                        black_box(pid.update(*r, *y));
                    }
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
