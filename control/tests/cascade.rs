//! Position and velocity loop: their rates, their limits, their changes.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]
#![expect(clippy::float_cmp, reason = "numbers that are exact in binary or must be equal to the bit")]

use control::{
    AntiWindup, Cascade, CascadeError, CascadeInput, CascadeOutput, CascadeState, Feedforward, PiGains,
    PidError, Status,
};
use profiles::Sample;
use proptest::prelude::*;

/// `k = 2 / s`, `f = 1/2`, `kp = 1`, `ki = 2`, `1/4` A s^2/rad, base period 1/4 s, position every 4 ticks, velocity every 2.
fn by_hand() -> Cascade {
    let feedforward = Feedforward::NONE.with_acceleration(0.25).expect("valid");
    Cascade::new(2.0, PiGains { kp: 1.0, ki: 2.0 }, 0.25)
        .and_then(|c| c.with_divisors(4, 2))
        .and_then(|c| c.with_velocity_feedforward(0.5))
        .expect("valid")
        .with_feedforward(feedforward)
}

fn input(position: f64, velocity: f64, acceleration: f64, feedforward: f64) -> CascadeInput {
    let reference = Sample { position: 1.0, velocity: 2.0, acceleration, ..Sample::default() };
    CascadeInput { feedforward, ..CascadeInput::new(reference, position, velocity) }
}

// With the reference at 1 rad, 2 rad/s; the velocity loop's period is 1/2 s, ki h = 1:
//   x     v    a   ff | v_c = 2 (1 - x) + 1   e = v_c - v   I = I + e   i = e + I + a / 4 + ff
//   0     0    4   0  | 3                     3             3           3 + 3 + 1     = 7
//   9     9    9   9  | 3 held                                          7 held
//   9     1    4   0  | 3 held                2             5           2 + 5 + 1     = 8
//   9     9    9   9  | 3 held                                          8 held
//   0.5   2    4   0  | 2                     0             5           0 + 5 + 1     = 6
//   9     9    9   9  | 2 held                                          6 held
//   9     3    0   .5 | 2 held               -1             4          -1 + 4 + 0 + .5 = 3.5
const SEQUENCE: [(f64, f64, f64, f64, f64); 7] = [
    (0.0, 0.0, 4.0, 0.0, 7.0),
    (9.0, 9.0, 9.0, 9.0, 7.0),
    (9.0, 1.0, 4.0, 0.0, 8.0),
    (9.0, 9.0, 9.0, 9.0, 8.0),
    (0.5, 2.0, 4.0, 0.0, 6.0),
    (9.0, 9.0, 9.0, 9.0, 6.0),
    (9.0, 3.0, 0.0, 0.5, 3.5),
];

#[test]
fn a_sequence_by_hand_at_its_own_rates() {
    let mut state = CascadeState::new();
    for (position, velocity, acceleration, feedforward, current) in SEQUENCE {
        let output = by_hand().update(&mut state, input(position, velocity, acceleration, feedforward));
        assert_eq!(output, CascadeOutput { current, status: Status::Regular });
    }
}

#[test]
fn a_bad_tick_is_no_tick() {
    let mut state = CascadeState::new();
    let mut last = 0.0;
    for (position, velocity, acceleration, feedforward, current) in SEQUENCE {
        // At ticks at which no loop is due, too.
        let held = by_hand().update(&mut state, input(position, f64::NAN, acceleration, feedforward));
        assert_eq!(held, CascadeOutput { current: last, status: Status::Held });
        let output = by_hand().update(&mut state, input(position, velocity, acceleration, feedforward));
        assert_eq!(output.current, current);
        last = current;
    }
}

proptest! {
    /// Divisors that are equal are a longer period: nothing between is looked at.
    #[test]
    fn equal_divisors_are_a_longer_period(
        divisor in 1_u32..6,
        samples in prop::collection::vec(prop::array::uniform4(-10.0..10.0), 1..40),
    ) {
        let gains = PiGains { kp: 0.7, ki: 3.0 };
        let slow = Cascade::new(5.0, gains, 0.25 * f64::from(divisor)).expect("valid");
        let fast = Cascade::new(5.0, gains, 0.25).and_then(|c| c.with_divisors(divisor, divisor)).expect("valid");
        let (mut a, mut b) = (CascadeState::new(), CascadeState::new());
        for [r, v, x, w] in samples {
            let reference = Sample { position: r, velocity: v, ..Sample::default() };
            let expected = slow.update(&mut a, CascadeInput::new(reference, x, w));
            for k in 0..divisor {
                let other = f64::from(k);
                prop_assert_eq!(fast.update(&mut b, CascadeInput::new(reference, x + other, w + other)), expected);
            }
        }
    }

    /// With the last input again the current moves by `ki h e` of the new law alone, whatever gains and share changed.
    #[test]
    fn gains_change_without_a_bump(
        old in (0.0..50.0, -3.0..3.0, -20.0..20.0, 0.0..1.0),
        new in (0.0..50.0, -3.0..3.0, -20.0..20.0, 0.0..1.0),
        samples in prop::collection::vec(prop::array::uniform4(-1.0..1.0), 1..20),
    ) {
        let config = |(k, kp, ki, share): (f64, f64, f64, f64)| {
            Cascade::new(k, PiGains { kp, ki }, 1e-3)
                .and_then(|c| c.with_velocity_feedforward(share))
                .and_then(|c| c.with_velocity_limit(20.0))
                .expect("valid")
        };
        let (old, new) = (config(old), config(new));
        let mut state = CascadeState::new();
        let (mut before, mut last) = (0.0, CascadeInput::default());
        for [r, v, x, w] in samples {
            last = CascadeInput::new(Sample { position: r, velocity: v, ..Sample::default() }, x, w);
            before = old.update(&mut state, last).current;
        }
        new.take_over(&old, &mut state);
        let own = 1e-3 * new.velocity_gains().ki * (state.velocity_command() - last.velocity);
        let after = new.update(&mut state, last).current;
        // Some twenty roundings of terms up to kp 21 rad/s and the integral of 20 ticks.
        prop_assert!((after - before - own).abs() < 20.0 * 3.0 * 41.0 * f64::EPSILON, "{before} -> {after}, own {own}");
    }
}

/// A speed of 100 rad/s asked of `v' = 100 i` with 10 A: by how much is it exceeded?
fn overshoot(anti_windup: AntiWindup, realised_limit: f64) -> f64 {
    let period = 1e-5;
    let limit = if realised_limit < 10.0 { 100.0 } else { 10.0 };
    let cascade = Cascade::new(0.0, PiGains { kp: 1.0, ki: 25.0 }, period)
        .and_then(|c| c.with_velocity_feedforward(1.0))
        .and_then(|c| c.with_current_limit(limit))
        .and_then(|c| c.with_anti_windup(anti_windup))
        .expect("valid");
    let reference = Sample { velocity: 100.0, ..Sample::default() };
    let mut state = CascadeState::new();
    let (mut velocity, mut top, mut realised) = (0.0_f64, 0.0_f64, None);
    for _ in 0..60_000 {
        let input = CascadeInput { realised, ..CascadeInput::new(reference, 0.0, velocity) };
        let current = cascade.update(&mut state, input).current.clamp(-realised_limit, realised_limit);
        realised = Some(current);
        velocity += 100.0 * period * current;
        top = top.max(velocity);
    }
    top - 100.0
}

#[test]
fn the_velocity_loop_does_not_wind_up_at_the_current_limit() {
    // Clamped, the integral starts where kp e comes off the limit, at e = 10 rad/s. From there e' = -100 (e + I) and
    // I' = 25 e: e = 10 (1 - 50 t) e^(-50 t), -10 e^-2 at worst.
    let exact = 10.0 * (-2.0_f64).exp();
    let clamped = overshoot(AntiWindup::Clamping, 10.0);
    // Order one in the period: 100 h and the like of the range of 10.
    assert!((clamped - exact).abs() < 0.02, "{clamped} rad/s instead of {exact}");
    // Unclamped it has by then gathered 25 A/rad times 5 rad.
    let unclamped = overshoot(AntiWindup::None, 10.0);
    assert!(unclamped > 30.0, "{unclamped} rad/s");
}

#[test]
fn it_goes_by_the_current_that_was_realised() {
    // No limit of its own that matters; something behind it leaves 5 A.
    let with = overshoot(AntiWindup::BackCalculation { tracking_time: 0.01 }, 5.0);
    let without = overshoot(AntiWindup::None, 5.0);
    // With e' = -500 rad/s^2 what is asked beyond 5 A tends to 10 ms (ki e - kp 500 rad/s^2): the limit is left near
    // e = 20 rad/s, far ahead of the target.
    assert!(with < 1.0, "{with} rad/s");
    assert!(without > 30.0, "{without} rad/s");
}

#[test]
fn limits_hold_and_say_so() {
    let cascade = Cascade::new(10.0, PiGains { kp: 1.0, ki: 0.0 }, 0.5)
        .and_then(|c| c.with_velocity_limit(3.0))
        .and_then(|c| c.with_current_limit(2.0))
        .expect("valid");
    let mut state = CascadeState::new();
    let output = cascade.update(&mut state, CascadeInput::new(Sample::at_rest(1.0), 0.0, 0.0));
    assert_eq!(state.velocity_command(), 3.0);
    assert_eq!(output, CascadeOutput { current: 2.0, status: Status::AtUpper });
    let output = cascade.update(&mut state, CascadeInput::new(Sample::at_rest(-1.0), 0.0, -2.5));
    assert_eq!(state.velocity_command(), -3.0);
    assert_eq!(output, CascadeOutput { current: -0.5, status: Status::Regular });
}

#[test]
fn a_smaller_divisor_does_not_wait_for_the_old_one() {
    let gains = PiGains { kp: 1.0, ki: 0.0 };
    let slow = Cascade::new(0.0, gains, 0.5).and_then(|c| c.with_divisors(1000, 1000)).expect("valid");
    let fast = slow.with_divisors(2, 2).expect("valid");
    let mut state = CascadeState::new();
    let tick = |cascade: &Cascade, state: &mut CascadeState, v| {
        cascade.update(state, CascadeInput::new(Sample::default(), 0.0, v)).current
    };
    assert_eq!(tick(&slow, &mut state, 1.0), -1.0);
    assert_eq!(tick(&fast, &mut state, 2.0), -2.0);
    assert_eq!(tick(&fast, &mut state, 3.0), -2.0);
    assert_eq!(tick(&fast, &mut state, 4.0), -4.0);
}

#[test]
fn bad_numbers_are_named() {
    let gains = PiGains { kp: 1.0, ki: 2.0 };
    assert_eq!(Cascade::new(-1.0, gains, 1.0), Err(CascadeError::PositionGain(-1.0)));
    assert_eq!(Cascade::new(1.0, gains, 0.0), Err(CascadeError::VelocityLoop(PidError::Period(0.0))));
    let cascade = Cascade::new(1.0, gains, 1.0).expect("valid");
    assert_eq!(cascade.with_divisors(0, 1), Err(CascadeError::Divisor("position")));
    assert_eq!(cascade.with_divisors(1, 0), Err(CascadeError::Divisor("velocity")));
    assert_eq!(cascade.with_velocity_feedforward(1.25), Err(CascadeError::VelocityFeedforward(1.25)));
    assert!(cascade.with_velocity_feedforward(f64::NAN).is_err());
    assert_eq!(cascade.with_velocity_limit(0.0), Err(CascadeError::VelocityLimit(0.0)));
    assert_eq!(cascade.with_current_limit(-2.0), Err(CascadeError::CurrentLimit(-2.0)));
    let tracking = AntiWindup::BackCalculation { tracking_time: -1.0 };
    assert_eq!(
        cascade.with_anti_windup(tracking),
        Err(CascadeError::VelocityLoop(PidError::TrackingTime(-1.0)))
    );
}

#[test]
fn one_absurd_sample_does_not_hold_for_good() {
    let cascade = Cascade::<f32>::new(1.0, PiGains { kp: 2.0, ki: 30.0 }, 1e-4)
        .and_then(|c| c.with_current_limit(20.0))
        .expect("valid");
    let mut state = CascadeState::new();
    let mut status =
        |position| cascade.update(&mut state, CascadeInput::new(Sample::at_rest(position), 0.0, 0.0)).status;
    assert_eq!(status(5e34), Status::AtUpper);
    assert_eq!(status(0.0), Status::Held, "the velocity loop differences 5e34 over 1e-4 s");
    assert_eq!(status(0.0), Status::Regular);
    // A command that overflows is not taken; the velocity loop goes on with the one before.
    let fast = cascade.with_gains(1e10, PiGains { kp: 2.0, ki: 30.0 }).expect("valid");
    let output = fast.update(&mut state, CascadeInput::new(Sample::at_rest(1e30), 0.0, 1.0));
    assert_eq!((output.status, output.current < 0.0), (Status::Held, true));
}
