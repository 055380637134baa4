//! A stepper behind a vibrating load: a trapezoid with start and stop speed, shaped, as pulses of a timer.

use profiles::{Direction, Limits, Mode, Profile, PulseTrain, Trapezoid, transform};
use shaping::{DelayFilter, Shaped};

use crate::board::Registers;

/// Rate of the timer, Hz.
const TIMER: f64 = 72e6;
/// Length of a pulse, m.
const PULSE: f64 = 1e-6;
/// The shortest time from one pulse to the next that the drive takes, s.
const SHORTEST: f64 = 2e-6;

/// Moves by `distance` in m, starting and stopping with a tenth of the speed limit; the timer is fed a period at a time.
pub fn step(distance: f64, limits: &Limits, registers: &mut Registers) -> Option<()> {
    let (frequency, damping_ratio, delay) = registers.mode();
    let mode = Mode::from_hz(frequency, damping_ratio).ok()?;
    let speed = 0.1 * limits.velocity().magnitude();
    let move_ = Trapezoid::with_speeds(distance, speed, speed, limits).ok()?;
    let filter = DelayFilter::positive(mode, delay).ok()?;
    let shaped = Shaped::new(move_, *filter.train());
    // What the shaped move holds at the mode, and how fast it is: nothing that the drive could not do is begun.
    if transform(&shaped, mode.pole()).norm_sqr() > 1e-12
        || shaped.extrema().velocity.magnitude() * SHORTEST > PULSE
    {
        return None;
    }
    let train = PulseTrain::new(shaped, PULSE).and_then(|t| t.with_shortest_interval(SHORTEST)).ok()?;
    let mut sent = 0_i64;
    for period in train.periods(TIMER).ok()? {
        let forward = period.direction == Direction::Forward;
        registers.pulse(u32::try_from(period.ticks).unwrap_or(u32::MAX), forward);
        sent += if forward { 1 } else { -1 };
    }
    // A drive that takes pulses per tick would be given these.
    let counted: i64 = train.counts(1e-3).ok()?.map(i64::from).sum();
    (sent == train.total() && counted == sent).then_some(())
}
