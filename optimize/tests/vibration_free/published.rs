//! Durations that are known from a linear programme on a grid of 300 intervals.

use optimize::vibration_free::Robustness;
use profiles::Profile;

use super::tasks::Task;

/// What such a grid is good for, s.
const GRID: f64 = 2e-4;
/// Half of the last digit.
const DIGIT: f64 = 5.1e-5;

/// A move, its mode, and durations in s: S-curve, one zero, with ZV, two zeros, with ZVD, a mode of 2.3 times the frequency
/// more, with two ZV.
const ROWS: [(f64, f64, f64, [f64; 7]); 3] = [
    (0.1, 8.0, 0.02, [0.3250, 0.3340, 0.3875, 0.3534, 0.4500, 0.3344, 0.4147]),
    (0.1, 20.0, 0.02, [0.3250, 0.3251, 0.3500, 0.3273, 0.3750, 0.3251, 0.3609]),
    (0.02, 12.0, 0.05, [0.1539, 0.1571, 0.1956, 0.1752, 0.2373, 0.1575, 0.2137]),
];

#[test]
fn the_durations_of_the_grid_are_met() {
    for (distance, hz, z, [s_curve, one, zv, two, zvd, both, both_zv]) in ROWS {
        let task = |modes: &[(f64, f64)]| Task::new(distance, [0.5, 5.0, 200.0], modes);
        let (single, double) = (task(&[(hz, z)]), task(&[(hz, z), (2.3 * hz, z)]));
        // The columns are those of the same axis.
        assert!((single.s_curve() - s_curve).abs() < DIGIT, "{}", single.s_curve());
        for (shaped, known) in [
            (single.shaped(Robustness::None), zv),
            (single.shaped(Robustness::DoubleZero), zvd),
            (double.shaped(Robustness::None), both_zv),
        ] {
            assert!((shaped - known).abs() < 2.0 * DIGIT, "{shaped} {known}");
        }
        for (planned, known) in [
            (single.plan(Robustness::None), one),
            (single.plan(Robustness::DoubleZero), two),
            (double.plan(Robustness::None), both),
        ] {
            let duration = planned.duration();
            assert!(duration <= known + GRID, "{hz} Hz: {duration} beyond {known}");
            // A restricted grid lies above the optimum, but for the digits and the limits between its points.
            assert!(duration >= known - 2.0 * GRID, "{hz} Hz: {duration} too far below {known}");
            assert!(planned.is_proven(), "{hz} Hz, {known}");
        }
    }
}

#[test]
fn the_readme_s_move_of_two_double_zeros() {
    let task = Task::new(0.1, [0.5, 5.0, 200.0], &[(8.0, 0.02), (18.4, 0.02)]);
    let planned = task.plan(Robustness::DoubleZero);
    assert!((planned.duration() - 0.3612).abs() < DIGIT && planned.is_proven(), "{}", planned.duration());
}
