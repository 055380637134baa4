//! Moves out of a table beside planned ones.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]
#![expect(clippy::float_cmp, reason = "what is promised exactly")]

use optimize::vibration_free::{MoveTableBuildError, OwnedMoveTable, Robustness, plan, plan_table};
use profiles::switched::{Arc, MoveTable, MoveTableError, Zero};
use profiles::{Limits, Mode, Profile, SCurve, Sample, residual_vibration};
use proptest::strategy::{Strategy, ValueTree};

const SHORTEST: f64 = 0.1;
const LONGEST: f64 = 0.12;
const TOLERANCE: f64 = 1e-3;

fn limits() -> Limits {
    Limits::new(0.5, 5.0, 200.0).expect("limits")
}

fn mode() -> Mode {
    Mode::from_hz(8.0, 0.02).expect("mode")
}

fn built(robustness: Robustness) -> OwnedMoveTable<32> {
    plan_table(SHORTEST, LONGEST, &limits(), &[mode()], robustness, TOLERANCE).expect("built")
}

/// End, zero and limits of a move over `distance`.
fn check(table: &MoveTable<'_, 32>, distance: f64) -> f64 {
    let found = table.rest_to_rest(distance).expect("within the range");
    let end = found.duration();
    assert_eq!(found.sample(end), Sample::at_rest(distance));
    assert!(residual_vibration(&found, mode()) < 1e-12 * distance.abs(), "{distance}");
    let extrema = found.extrema();
    // What the table promises; jerks are those of the plan.
    let held = 1.0 + 1e-12;
    assert!(extrema.velocity.magnitude() <= 0.5 * held);
    assert!(extrema.acceleration.magnitude() <= 5.0 * held);
    assert!(extrema.jerk.magnitude() <= 200.0 * held);
    // No jump that the end could hide.
    for k in 0..=400 {
        let (t, step) = (end * f64::from(k) / 400.0, 1e-9);
        let moved = found.sample(t + step).position - found.sample(t - step).position;
        assert!(moved.abs() <= 0.5 * 2.0 * step * held + 1e-14, "{distance} at {t}");
    }
    end
}

#[test]
fn moves_are_exact_and_last_no_longer_than_planned_ones() {
    for robustness in [Robustness::None, Robustness::DoubleZero] {
        let owned = built(robustness);
        let table = owned.as_table().expect("as it was built");
        let mut runner = proptest::test_runner::TestRunner::deterministic();
        for _ in 0..64 {
            let distance = (SHORTEST..LONGEST).new_tree(&mut runner).expect("a number").current();
            let duration = check(&table, distance);
            // The way back is the same motion.
            assert_eq!(check(&table, -distance).to_bits(), duration.to_bits());
            let planned = plan(distance, &limits(), &[mode()], robustness).expect("plan");
            // Quarters of each gap were compared, what lies between is not much longer.
            let most = planned.duration() * (1.0 + 1.5 * TOLERANCE);
            assert!(duration <= most, "{distance}: {duration}, planned {}", planned.duration());
        }
    }
}

#[test]
fn moves_of_the_table_are_the_planned_ones() {
    let owned = built(Robustness::None);
    let (table, family) = (owned.as_table().expect("table"), owned.as_family());
    let mut durations = family.durations;
    let arcs = family.runs.iter().flat_map(|run| vec![run.arcs; run.moves]);
    for (distance, arcs) in family.distances.iter().zip(arcs) {
        let (these, rest) = durations.split_at(arcs);
        durations = rest;
        let whole: f64 = these.iter().sum();
        // Roundings of a sum of so many durations.
        assert!(check(&table, *distance) <= whole * (1.0 + 1e-14), "{distance}");
    }
    assert!(durations.is_empty());
    assert_eq!(family.distances.first(), Some(&SHORTEST));
    assert_eq!(family.distances.last(), Some(&LONGEST));
}

/// If interpolation were all there is: this is what the correction is for.
#[test]
fn without_the_correction_modes_would_vibrate() {
    let owned = built(Robustness::None);
    let family = owned.as_family();
    let (mut most, mut first, mut jerks) = (0.0_f64, 0, family.jerks);
    let mut durations = family.durations;
    for run in family.runs {
        let (signs, rest) = jerks.split_at(run.arcs);
        jerks = rest;
        let (moves, rest) = durations.split_at(run.arcs * run.moves);
        durations = rest;
        for (k, (a, b)) in moves.chunks(run.arcs).zip(moves.chunks(run.arcs).skip(1)).enumerate() {
            let arcs: Vec<Arc> = (a.iter().zip(b).zip(signs))
                .map(|((a, b), jerk)| Arc { jerk: *jerk, duration: 0.5 * (a + b) })
                .collect();
            let distance = 0.5 * (family.distances[first + k] + family.distances[first + k + 1]);
            let zero = Zero::new(mode(), false);
            let [left, _] = arcs.iter().fold(Default::default(), |q, arc| zero.after(q, arc));
            let amplitude = left.norm() / (zero.pole().norm() * zero.pole().im);
            most = most.max(amplitude / distance);
        }
        first += run.moves;
    }
    assert!(most > 1e-9, "the interpolation alone leaves {most:e}");
}

#[test]
fn tables_of_one_direction_and_of_limits_that_differ() {
    let limits = limits().with_deceleration(4.0).expect("limits");
    let owned: OwnedMoveTable<32> =
        plan_table(-0.1, -0.11, &limits, &[mode()], Robustness::None, 1e-2).expect("built");
    let table = owned.as_table().expect("table");
    let found = table.rest_to_rest(-0.104).expect("within");
    assert_eq!(found.sample(found.duration()).position, -0.104);
    // A move downwards speeds up with what slows one down upwards.
    assert!(found.extrema().acceleration.lower >= -4.0 * (1.0 + 1e-12));
    assert!(residual_vibration(&found, mode()) < 1e-12 * 0.104);
    assert_eq!(table.rest_to_rest(0.104), Err(MoveTableError::Direction(0.104)));
    assert_eq!(table.range(), (-0.1, -0.11));
}

#[test]
fn without_modes_a_table_holds_s_curves() {
    let owned: OwnedMoveTable<7> =
        plan_table(0.002, 0.4, &limits(), &[], Robustness::None, TOLERANCE).expect("built");
    let table = owned.as_table().expect("table");
    for k in 0..200 {
        let distance = 0.002 * 200_f64.powf((f64::from(k) + 0.31) / 200.0);
        let (found, planned) = (table.rest_to_rest(distance), SCurve::rest_to_rest(distance, &limits()));
        let (found, planned) = (found.expect("within").duration(), planned.expect("planned").duration());
        // As short as the optimum but for its rounding.
        assert!(found <= planned * (1.0 + 1.5 * TOLERANCE) && found >= planned * (1.0 - 1e-12), "{distance}");
    }
}

#[test]
fn what_cannot_be_a_table_is_refused_with_its_number() {
    let build = |shortest, longest, robustness, tolerance| {
        plan_table::<32>(shortest, longest, &limits(), &[mode()], robustness, tolerance).map(|_| ())
    };
    for (shortest, longest) in [(0.1, 0.1), (0.2, 0.1), (-0.1, 0.2), (0.0, 0.1), (0.1, f64::INFINITY)] {
        let error = build(shortest, longest, Robustness::None, 1e-3);
        assert_eq!(error, Err(MoveTableBuildError::Range { shortest, longest }));
    }
    assert!(matches!(build(0.1, f64::NAN, Robustness::None, 1e-3), Err(MoveTableBuildError::Range { .. })));
    assert_eq!(build(0.1, 0.2, Robustness::None, 0.0), Err(MoveTableBuildError::Tolerance(0.0)));
    let band = Robustness::Band { half_width: 0.1, residual: 1e-3 };
    assert_eq!(build(0.1, 0.2, band, 1e-3), Err(MoveTableBuildError::Band(0.1)));
    let small = plan_table::<8>(0.1, 0.12, &limits(), &[mode()], Robustness::None, 1e-3);
    assert!(matches!(
        small,
        Err(MoveTableBuildError::Table(MoveTableError::Run { run: 0, arcs: 12, most: 8, .. }))
    ));
    let many = plan_table::<8>(0.1, 0.12, &limits(), &[mode(); 5], Robustness::None, 1e-3);
    assert!(matches!(many, Err(MoveTableBuildError::Move(_))));
}

#[test]
fn what_is_written_is_what_a_controller_was_given() {
    let owned = built(Robustness::None);
    let mut text = String::new();
    owned.write_rust("MOVES", &mut text).expect("written");
    // The file that the firmware example and the tests of the table itself are compiled with.
    assert!(text.starts_with("use profiles::switched::{Contact, MoveFamily, Run};\n\n/// "));
    assert!(text.contains(
        "pub static MOVES: MoveFamily<'static> = MoveFamily {\n    runs: &[\n        Run { arcs: "
    ));
    let numbers = |from: &str| {
        let body = text.split(from).nth(1).expect("the slice").split(']').next().expect("its end");
        let numbers = body.split([',', '\n']).map(str::trim).filter(|number| !number.is_empty());
        numbers.map(|number| number.parse().expect("a number")).collect::<Vec<f64>>()
    };
    let family = owned.as_family();
    assert_eq!(numbers("jerks: &["), family.jerks);
    assert_eq!(numbers("distances: &["), family.distances);
    assert_eq!(numbers("durations: &["), family.durations);
    for name in ["", "moves", "2FAST", "A B"] {
        assert_eq!(owned.write_rust(name, &mut text), Err(MoveTableBuildError::Name));
    }
}
