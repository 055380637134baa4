//! Moves out of a table in flash: exact, within limits, free of vibration, and checked before they are used.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]
#![expect(clippy::float_cmp, reason = "what is promised exactly")]

#[path = "common/moves.rs"]
#[expect(unreachable_pub, reason = "as it is written for a controller")]
mod moves;

use moves::MOVES;
use profiles::switched::{Contact, MoveFamily, MoveTable, MoveTableError, Run};
use profiles::{Limits, Mode, Profile, SCurve, Sample, residual_vibration};
use proptest::prelude::*;

fn limits() -> Limits {
    Limits::new(0.5, 5.0, 200.0).expect("limits")
}

fn mode() -> Mode {
    Mode::from_hz(8.0, 0.02).expect("mode")
}

fn table() -> MoveTable<'static, 12> {
    MoveTable::new(MOVES, &limits(), &[mode()], false).expect("checked")
}

proptest! {
    #[test]
    fn any_distance_of_the_range_has_its_move(distance in 0.1..0.12_f64, back: bool) {
        let distance = if back { -distance } else { distance };
        let found = table().rest_to_rest(distance).expect("within");
        prop_assert_eq!(found.sample(found.duration()), Sample::at_rest(distance));
        prop_assert!(residual_vibration(&found, mode()) < 1e-12 * distance.abs());
        let extrema = found.extrema();
        prop_assert!(extrema.velocity.magnitude() <= 0.5 * (1.0 + 1e-12));
        prop_assert!(extrema.acceleration.magnitude() <= 5.0 * (1.0 + 1e-12));
        prop_assert_eq!(extrema.jerk.magnitude(), 200.0);
        // The next longer move of the table is an upper bound.
        let above = MOVES.distances.iter().find(|d| **d >= distance.abs()).expect("within");
        let longest = table().rest_to_rest(*above).expect("of the table").duration();
        prop_assert!(found.duration() <= longest);
    }
}

#[test]
fn half_a_gap_takes_half_the_time() {
    // Within a run the duration is smooth: the middle lasts about as long as the mean, far from either end.
    let [.., a, b] = MOVES.distances else { panic!("two moves") };
    let duration = |d: f64| table().rest_to_rest(d).expect("within").duration();
    let (before, middle, after) = (duration(*a), duration(0.5 * (a + b)), duration(*b));
    assert!((middle - 0.5 * (before + after)).abs() < 0.1 * (after - before));
}

#[test]
fn what_is_outside_is_refused_with_its_number() {
    for distance in [0.0, 0.0999, -0.1201, f64::INFINITY] {
        let error = MoveTableError::Distance { distance, shortest: 0.1, longest: 0.12 };
        assert_eq!(table().rest_to_rest(distance), Err(error));
    }
    assert!(matches!(table().rest_to_rest(f64::NAN), Err(MoveTableError::Distance { .. })));
}

#[test]
fn a_table_of_other_modes_or_limits_is_refused() {
    let new =
        |limits: Limits, modes: &[Mode], double| MoveTable::<12>::new(MOVES, &limits, modes, double).err();
    let other = Mode::from_hz(8.001, 0.02).expect("mode");
    assert!(matches!(new(limits(), &[other], false), Some(MoveTableError::Residual { distance: 0.1, .. })));
    assert!(matches!(new(limits(), &[mode()], true), Some(MoveTableError::Residual { .. })));
    assert_eq!(new(limits(), &[mode(); 5], false), Some(MoveTableError::Modes { modes: 5, most: 4 }));
    for [v, a, j] in [[0.49, 5.0, 200.0], [0.5, 4.9, 200.0], [0.5, 5.0, 190.0]] {
        let tighter = Limits::new(v, a, j).expect("limits");
        assert!(matches!(new(tighter, &[mode()], false), Some(MoveTableError::Limits { distance: 0.1, .. })));
    }
    // Wider limits are held too; the other direction needs the same ones.
    let wider = limits().with_deceleration(6.0).expect("limits");
    let table = MoveTable::<12>::new(MOVES, &wider, &[mode()], false).expect("held");
    assert!(table.rest_to_rest(0.11).is_ok());
    assert_eq!(table.rest_to_rest(-0.11), Err(MoveTableError::Direction(-0.11)));
}

#[test]
fn numbers_that_do_not_belong_together_are_refused() {
    let new = |family: MoveFamily<'_>| MoveTable::<12>::new(family, &limits(), &[mode()], false).err();
    let small = MoveTable::<11>::new(MOVES, &limits(), &[mode()], false).err();
    assert_eq!(small, Some(MoveTableError::Run { run: 0, arcs: 12, contacts: 5, most: 11 }));
    let empty = MoveFamily { runs: &[], jerks: &[], contacts: &[], distances: &[], durations: &[] };
    assert_eq!(new(empty), Some(MoveTableError::Length { what: "distances", needed: 1, given: 0 }));
    let length = |what, needed, given| Some(MoveTableError::Length { what, needed, given });
    assert_eq!(new(MoveFamily { jerks: &MOVES.jerks[1..], ..MOVES }), length("jerks", 34, 33));
    assert_eq!(new(MoveFamily { durations: &MOVES.durations[1..], ..MOVES }), length("durations", 146, 145));
    assert_eq!(new(MoveFamily { runs: &MOVES.runs[1..], ..MOVES }), length("jerks", 22, 34));
    let huge = [Run { arcs: 12, contacts: 5, moves: usize::MAX }; 2];
    assert_eq!(new(MoveFamily { runs: &huge, ..MOVES }), length("jerks", 24, 34));
    let mut distances = MOVES.distances.to_vec();
    distances.swap(0, 1);
    let first = distances[1];
    assert!(matches!(
        new(MoveFamily { distances: &distances, ..MOVES }),
        Some(MoveTableError::Residual { .. })
    ));
    let single = [Run { moves: 1, ..MOVES.runs[0] }, Run { moves: 1, ..MOVES.runs[0] }];
    let twice = [MOVES.distances[0]; 2];
    let (arcs, contacts) = (MOVES.runs[0].arcs, MOVES.runs[0].contacts);
    let family = MoveFamily {
        runs: &single,
        jerks: &[&MOVES.jerks[..arcs], &MOVES.jerks[..arcs]].concat(),
        contacts: &[&MOVES.contacts[..contacts], &MOVES.contacts[..contacts]].concat(),
        distances: &twice,
        durations: &[&MOVES.durations[..arcs], &MOVES.durations[..arcs]].concat(),
    };
    assert_eq!(new(family), Some(MoveTableError::Order(first)));
    let mut durations = MOVES.durations.to_vec();
    durations[3] *= 1.0 + 1e-9;
    assert!(matches!(
        new(MoveFamily { durations: &durations, ..MOVES }),
        Some(MoveTableError::Residual { .. })
    ));
    durations[3] = f64::NAN;
    assert!(matches!(
        new(MoveFamily { durations: &durations, ..MOVES }),
        Some(MoveTableError::Residual { .. })
    ));
}

#[test]
fn a_single_move_is_a_table() {
    let (arcs, contacts) = (MOVES.runs[0].arcs, MOVES.runs[0].contacts);
    let family = MoveFamily {
        runs: &[Run { moves: 1, ..MOVES.runs[0] }],
        jerks: &MOVES.jerks[..arcs],
        contacts: &MOVES.contacts[..contacts],
        distances: &MOVES.distances[..1],
        durations: &MOVES.durations[..arcs],
    };
    let table = MoveTable::<12>::new(family, &limits(), &[mode()], false).expect("checked");
    assert_eq!(table.range(), (0.1, 0.1));
    assert!(table.rest_to_rest(-0.1).is_ok() && table.rest_to_rest(0.1001).is_err());
}

#[test]
fn where_no_structure_leads_the_longer_move_is_made_smaller() {
    // S-curves that meet no limit of velocity and acceleration, and all of them; in between lie others.
    let (short, stay) = ((0.002_f64 / 400.0).cbrt(), 0.075);
    let family = MoveFamily {
        runs: &[Run { arcs: 3, contacts: 0, moves: 1 }, Run { arcs: 7, contacts: 4, moves: 1 }],
        jerks: &[200.0, -200.0, 200.0, 200.0, 0.0, -200.0, 0.0, -200.0, 0.0, 200.0],
        contacts: &[
            Contact::Acceleration { arc: 1, value: 5.0 },
            Contact::Acceleration { arc: 3, value: 0.0 },
            Contact::Velocity { arc: 3, value: 0.5 },
            Contact::Acceleration { arc: 5, value: -5.0 },
        ],
        distances: &[0.002, 0.4],
        durations: &[short, 2.0 * short, short, 0.025, stay, 0.025, 0.675, 0.025, stay, 0.025],
    };
    let table = MoveTable::<7>::new(family, &limits(), &[], false).expect("checked");
    // Both ends have a stretch of their own structure; from 2 A^3 / J^2 to V^2 / A + V A / J there is neither.
    for (distance, found) in [(0.003, true), (0.0061, true), (0.0063, false), (0.062, false), (0.063, true)] {
        for distance in [distance, -distance] {
            let motion = table.rest_to_rest(distance).expect("within");
            let shortest = SCurve::rest_to_rest(distance, &limits()).expect("planned").duration();
            let expected = if found { shortest } else { 0.925 };
            // Roundings of the sum of seven durations.
            assert!((motion.duration() - expected).abs() < 1e-14, "{distance}: {}", motion.duration());
            assert_eq!(motion.sample(1.0), Sample::at_rest(distance));
            let extrema = motion.extrema();
            assert!(extrema.acceleration.magnitude() <= 5.0 * (1.0 + 1e-12));
            // All of it in proportion, so that it is 0.4 m made smaller.
            let speed = if found { extrema.velocity.magnitude() } else { 0.5 * distance.abs() / 0.4 };
            assert!((extrema.velocity.magnitude() - speed).abs() < 1e-15);
        }
    }
}
