//! A mass moved over 0.2 m in half a second against friction and a load that the feedforward does not know.

use control::{Feedforward, Pid, PidGains, PidInput, PidState};
use profiles::Sample;

/// Rest to rest over `distance` in m within `duration` in s: `10 s^3 - 15 s^4 + 6 s^5`.
fn reference(t: f64, distance: f64, duration: f64) -> Sample {
    let s = (t / duration).clamp(0.0, 1.0);
    let position = distance * s.powi(3) * (10.0 + s * (6.0 * s - 15.0));
    let velocity = distance / duration * 30.0 * (s * (1.0 - s)).powi(2);
    let acceleration = distance / duration.powi(2) * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s);
    Sample { position, velocity, acceleration, ..Sample::default() }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (period, mass, damping, load) = (1e-3, 2.0, 15.0, 6.0);
    let pid = Pid::new(PidGains { kp: 8e3, ki: 6e4, kd: 180.0 }, period)?
        .with_derivative_filter(2e-3)?
        .with_output_limits(-60.0, 60.0)?;

    for (name, feedforward) in
        [("feedback alone", Feedforward::NONE), ("with feedforward", Feedforward::rigid(mass, damping)?)]
    {
        let mut state = PidState::new();
        let (mut x, mut v, mut worst) = (0.0, 0.0, 0.0_f64);
        for tick in 0..1000 {
            let t = f64::from(tick) * period;
            let wanted = reference(t, 0.2, 0.5);
            let input =
                PidInput { feedforward: feedforward.force(&wanted), ..PidInput::new(wanted.position, x) };
            let force = pid.update(&mut state, input).output;
            // Semi-implicit Euler is enough for a picture of the plant; the load comes on at 0.6 s.
            let disturbance = if t < 0.6 { 0.0 } else { load };
            v += period * (force - damping * v - disturbance) / mass;
            x += period * v;
            if t < 0.5 {
                worst = worst.max((wanted.position - x).abs());
            }
        }
        println!(
            "{name}: {:.3} mm at worst while moving, {:.3} mm at the end, {:.2} N against the load",
            1e3 * worst,
            1e3 * (0.2 - x),
            state.integral()
        );
    }
    Ok(())
}
