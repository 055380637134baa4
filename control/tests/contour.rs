//! Contour errors against distances known in closed form, and their orders.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]
#![expect(clippy::float_cmp, reason = "numbers that are exact in binary")]

use control::{CommandedPath, ContourBasis, ContourError, ContourFault, PathFrame};
use proptest::prelude::*;

type Vector = [f64; 3];

fn zip(a: Vector, b: Vector, f: impl Fn(f64, f64) -> f64) -> Vector {
    std::array::from_fn(|i| f(a[i], b[i]))
}

fn add(a: Vector, factor: f64, b: Vector) -> Vector {
    zip(a, b, |a, b| a + factor * b)
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn length(a: Vector) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The helix of radius `radius` that climbs `pitch` per rad: point, derivative, second derivative.
fn helix(radius: f64, pitch: f64, angle: f64) -> [Vector; 3] {
    let (sin, cos) = angle.sin_cos();
    [
        [radius * cos, radius * sin, pitch * angle],
        [-radius * sin, radius * cos, pitch],
        [-radius * cos, -radius * sin, 0.0],
    ]
}

fn vector(size: f64) -> impl Strategy<Value = Vector> {
    prop::array::uniform3(-size..size)
}

proptest! {
    #[test]
    fn of_a_line_it_is_the_distance(
        start in vector(2.0), step in vector(1.0), actual in vector(2.0), log_size in -30..30_i32,
        commanded in -5.0..5.0_f64,
    ) {
        prop_assume!(length(step) > 1e-3);
        // A power of two: the same roundings at every size.
        let size = 2_f64.powi(log_size);
        let [start, step, actual] = [start, step, actual].map(|v| v.map(|x| size * x));
        let reference = add(start, commanded, step);
        let truth = length(cross(add(actual, -1.0, reference), step)) / length(step);
        let error = add(reference, -1.0, actual);
        // Some ten roundings of the tracking error.
        let tolerance = 10.0 * f64::EPSILON * length(error);

        let tangent = ContourError::from_tangent(error, step).expect("finite");
        prop_assert_eq!(tangent.basis(), ContourBasis::Line);
        prop_assert!((tangent.magnitude() - truth).abs() <= tolerance, "{} {}", tangent.magnitude(), truth);
        // It ends on the line, at a right angle.
        let foot = add(actual, 1.0, tangent.vector());
        prop_assert!(length(cross(add(foot, -1.0, reference), step)) <= tolerance * length(step));
        prop_assert!(dot(tangent.vector(), step).abs() <= tolerance * length(step));
        // Acceleration along the line does not bend it.
        let circle = ContourError::from_circle(error, step, step.map(|x| -7.0 * x)).expect("finite");
        prop_assert_eq!(circle, tangent);

        // The paper's formula from the last two points, as it is printed.
        let current = add(reference, 1.0, step);
        let (e, r) = (add(current, -1.0, actual), add(current, -1.0, reference));
        let printed = add(e, -dot(e, r) / dot(r, r), r);
        let points = ContourError::from_points(reference, current, actual).expect("finite");
        let difference = length(add(printed, -1.0, points.vector()));
        prop_assert!(difference <= 10.0 * f64::EPSILON * length(e), "{} {:?}", difference, points);
    }

    #[test]
    fn of_a_circle_it_is_the_distance(
        axis in vector(1.0), toward in vector(1.0), offset in vector(1.0), log_size in -30..30_i32,
        (radius, speed, along) in (0.1..3.0_f64, 0.1..3.0_f64, -9.0..9.0_f64),
    ) {
        let normal = cross(axis, toward);
        prop_assume!(length(normal) > 0.05);
        let unit = |v: Vector| v.map(|x| x / length(v));
        let (toward, axis) = (unit(cross(normal, axis)), unit(axis));
        let tangent = cross(axis, toward);
        // The circle about the origin; the reference is on it, the actual position anywhere.
        let size = 2_f64.powi(log_size);
        let radius = size * radius;
        let (reference, actual) = (toward.map(|x| radius * x), offset.map(|x| 2.0 * size * x));
        let height = dot(actual, axis);
        let truth = (length(add(actual, -height, axis)) - radius).hypot(height);
        let error = add(reference, -1.0, actual);
        // Any speed, with an acceleration along the path.
        let velocity = tangent.map(|x| speed * x);
        let acceleration = add(toward.map(|x| -speed * speed / radius * x), along, tangent);
        let contour = ContourError::from_circle(error, velocity, acceleration).expect("finite");
        prop_assert_eq!(contour.basis(), ContourBasis::Circle);
        // Rounding of the frame times the lag, and of the curvature, worse where most of the acceleration is along.
        let share = 1.0 + along.abs() * radius / (speed * speed);
        let tolerance = 20.0 * f64::EPSILON * share * (radius + length(error));
        prop_assert!((contour.magnitude() - truth).abs() <= tolerance, "{} {}", contour.magnitude(), truth);
        // It ends on the circle, unless the position is too near the axis to say where.
        let foot = add(actual, 1.0, contour.vector());
        if length(add(actual, -height, axis)) > 0.01 * radius {
            prop_assert!((length(foot) - radius).abs() <= tolerance && dot(foot, axis).abs() <= tolerance);
        }
    }

    #[test]
    fn the_rate_is_that_of_the_error(
        error in vector(1.0), rate in vector(1.0), velocity in vector(1.0), acceleration in vector(1.0),
    ) {
        prop_assume!(length(velocity) > 0.1);
        // A line is linear: any step.
        let at = |time: f64| ContourError::from_tangent(add(error, time, rate), velocity).expect("finite");
        let difference = add(at(1.0).vector(), -1.0, at(0.0).vector());
        let linear = at(0.0).across(rate);
        prop_assert!(length(add(difference, -1.0, linear)) <= 10.0 * f64::EPSILON * (1.0 + length(error)));
        // About a circle the position at the foot turns, by no more than the distance over the radius.
        let frame = PathFrame::osculating(velocity, acceleration).expect("finite").expect("moves");
        let small = 0.1 / frame.curvature().max(1.0);
        let at = |time: f64| {
            ContourError::new(add(error.map(|x| small * x), time * small, rate), Some(&frame)).expect("finite")
        };
        let step = 1e-4;
        let difference = add(at(step).vector(), -1.0, at(-step).vector()).map(|x| x / (2.0 * step * small));
        let held = at(0.0).across(rate);
        let bound = 2.0 * frame.curvature() * small * length(error) * length(rate);
        prop_assert!(length(add(difference, -1.0, held)) <= bound + 1e-6, "{:?} {:?}", difference, held);
    }
}

/// The magnitudes from points `spacing` of arc apart, from the tangent and from the circle, for an actual position `lag`
/// of arc behind on the path itself: all of it is error of the method.
fn on_the_path(radius: f64, pitch: f64, lag: f64, spacing: f64) -> [f64; 3] {
    let per_arc = 1.0 / radius.hypot(pitch);
    let [reference, velocity, acceleration] = helix(radius, pitch, 0.7);
    let [actual, ..] = helix(radius, pitch, 0.7 - lag * per_arc);
    let [previous, ..] = helix(radius, pitch, 0.7 - spacing * per_arc);
    let error = add(reference, -1.0, actual);
    [
        ContourError::from_points(previous, reference, actual).expect("finite"),
        ContourError::from_tangent(error, velocity).expect("finite"),
        ContourError::from_circle(error, velocity, acceleration).expect("finite"),
    ]
    .map(|e| e.magnitude())
}

#[test]
fn the_orders_on_a_circle_and_on_a_helix() {
    for (radius, pitch) in [(0.8, 0.0), (0.8, 0.5)] {
        let squared: f64 = radius * radius + pitch * pitch;
        let (curvature, torsion) = (radius / squared, pitch / squared);
        for k in 3..9 {
            let lag = 0.5_f64.powi(k);
            let [points, tangent, circle] = on_the_path(radius, pitch, lag, 0.25 * lag);
            // The next term is smaller by the lag over the radius.
            let near = |value: f64, leading: f64| (value / leading - 1.0).abs() < lag;
            assert!(near(points, 0.5 * curvature * lag * (0.75 * lag)), "{points} {lag}");
            assert!(near(tangent, 0.5 * curvature * lag * lag), "{tangent} {lag}");
            if pitch > 0.0 {
                assert!(near(circle, curvature * torsion * lag * lag * lag / 6.0), "{circle} {lag}");
            } else {
                // Exact: roundings of the coordinates.
                assert!(circle < 4.0 * f64::EPSILON, "{circle} {lag}");
            }
        }
    }
}

#[test]
fn closer_points_are_the_tangent_with_order_one() {
    for (radius, pitch) in [(0.8, 0.0), (0.8, 0.5)] {
        let off = |spacing: f64| {
            let [points, tangent, _] = on_the_path(radius, pitch, 0.1, spacing);
            tangent - points
        };
        for k in 4..9 {
            let spacing = 0.1 * 0.5_f64.powi(k);
            let ratio = off(spacing) / off(0.5 * spacing);
            assert!((ratio - 2.0).abs() < 0.1, "{ratio}");
        }
    }
}

/// The largest error of the magnitude over offsets all around the path, from tangent and circle.
fn beside_the_path(lag: f64) -> [f64; 2] {
    let (radius, pitch, offset): (f64, f64, f64) = (0.8, 0.5, 0.05);
    let per_arc = 1.0 / radius.hypot(pitch);
    let [reference, velocity, acceleration] = helix(radius, pitch, 0.7);
    let [foot, along, inwards] = helix(radius, pitch, 0.7 - lag * per_arc);
    let (normal, binormal) = (inwards.map(|x| x / radius), cross(along, inwards));
    let binormal = binormal.map(|x| x / length(binormal));
    let mut worst = [0.0_f64; 2];
    for n in 0..16 {
        let (sin, cos) = (f64::from(n) * 0.4).sin_cos();
        // In the plane across the path at the foot, and nearer than its radius: the distance is the offset.
        let error = add(reference, -1.0, add(add(foot, offset * cos, normal), offset * sin, binormal));
        let found = [
            ContourError::from_tangent(error, velocity).expect("finite"),
            ContourError::from_circle(error, velocity, acceleration).expect("finite"),
        ];
        for (worst, found) in worst.iter_mut().zip(found) {
            *worst = worst.max((found.magnitude() - offset).abs());
        }
    }
    worst
}

#[test]
fn the_orders_hold_beside_the_path() {
    for k in 4..9 {
        let lag = 0.5_f64.powi(k);
        let (coarse, fine) = (beside_the_path(lag), beside_the_path(0.5 * lag));
        for (coarse, fine, order) in [(coarse[0], fine[0], 2.0), (coarse[1], fine[1], 3.0)] {
            assert!(((coarse / fine).log2() - order).abs() < 0.1, "{} for {order}", (coarse / fine).log2());
        }
    }
}

#[test]
fn a_path_without_a_direction_is_a_point() {
    let whole = |found: Result<ContourError<3>, ContourFault>, error: Vector| {
        let found = found.expect("finite");
        assert_eq!((found.vector(), found.basis()), (error, ContourBasis::Point));
        assert_eq!(found.across([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
    };
    let (here, actual, error) = ([1.0, 2.0, 3.0], [0.5, 4.0, 3.0], [0.5, -2.0, 0.0]);
    whole(ContourError::from_points(here, here, actual), error);
    whole(ContourError::from_tangent(error, [0.0, -0.0, 0.0]), error);
    whole(ContourError::from_circle(error, [0.0; 3], [1.0, 0.0, 0.0]), error);
    // The next number after is a direction.
    let next = [1.0 + f64::EPSILON, 2.0, 3.0];
    assert_eq!(ContourError::from_points(here, next, actual).expect("finite").basis(), ContourBasis::Line);
}

#[test]
fn steps_of_any_size_are_directions() {
    let error = [3.0, 4.0, 0.0];
    for size in [5e-324_f64, 1e-310, 1e-200, 1.0, 1e200, 1.7e308] {
        let found = ContourError::from_tangent(error, [0.0, size, 0.0]).expect("finite");
        assert_eq!(found.vector(), [3.0, 0.0, 0.0]);
        let found = ContourError::from_points([0.0, -size, 0.0], [0.0, size, 0.0], [0.0; 3]);
        // The tracking error is all along.
        assert_eq!(found.expect("finite").magnitude().to_bits(), 0.0_f64.to_bits());
    }
    // A distance whose square has no representation.
    for size in [1e-310_f64, 1e-200, 1e200, 8e307] {
        let found = ContourError::from_tangent([3.0, 4.0, 9.0].map(|x| 0.1 * size * x), [0.0, 0.0, 1.0]);
        let magnitude = found.expect("finite").magnitude();
        // Subnormal numbers are spaced by 5e-324.
        assert!((magnitude - 0.5 * size).abs() <= 4.0 * f64::EPSILON * size + 5e-324, "{magnitude} {size}");
    }
}

#[test]
fn a_circle_of_any_size_and_its_axis() {
    for size in [1e-150_f64, 1e-5, 1.0, 1e5, 1e150] {
        // At the axis all of the circle is as near: the way to the commanded point will do.
        let found = ContourError::from_circle([size, 0.0], [0.0, 1.0], [1.0 / -size, 0.0]).expect("finite");
        assert_eq!(found.basis(), ContourBasis::Circle);
        assert!((found.magnitude() / size - 1.0).abs() < 4.0 * f64::EPSILON);
        // Beyond the axis the near side is the other one.
        let found =
            ContourError::from_circle([1.5 * size, 0.0], [0.0, 1.0], [1.0 / -size, 0.0]).expect("finite");
        assert!((found.vector()[0] / size + 0.5).abs() < 4.0 * f64::EPSILON, "{found:?}");
    }
    // A radius below the smallest number is no circle.
    let found = ContourError::from_circle([1.0, 0.0], [0.0, 1e-200], [1.0, 0.0]);
    assert!(matches!(found, Err(ContourFault::Range { quantity: "curvature", .. })), "{found:?}");
}

#[test]
fn single_precision_is_as_exact() {
    // Around a circle of 2 m at every degree, 0.125 m inside, 0.3 rad late.
    for degree in 0..360_u16 {
        let angle = f32::from(degree).to_radians();
        let at = |angle: f32, radius: f32| [radius * angle.cos(), radius * angle.sin()];
        let (reference, actual) = (at(angle, 2.0), at(angle - 0.3, 1.875));
        let error = [reference[0] - actual[0], reference[1] - actual[1]];
        let [x, y] = at(angle, 1.0);
        let found = ContourError::from_circle(error, [-y, x], [-0.5 * x, -0.5 * y]).expect("finite");
        // Twenty roundings of numbers of the size of the radius.
        assert!((found.magnitude() - 0.125).abs() < 20.0 * f32::EPSILON * 2.0, "{found:?}");
    }
}

#[test]
fn what_is_not_finite_is_named() {
    let fault = ContourError::from_tangent([0.0, f64::INFINITY, 0.0], [1.0, 0.0, 0.0]);
    let quantity = "tracking error";
    assert_eq!(fault, Err(ContourFault::NotFinite { quantity, axis: 1, value: f64::INFINITY }));
    let fault = ContourError::from_points([0.0; 2], [1.0, 0.0], [0.0, f64::NAN]);
    assert!(matches!(
        fault,
        Err(ContourFault::NotFinite { quantity: "actual position", axis: 1, value }) if value.is_nan()
    ));
    assert!(PathFrame::along([f64::NAN, 0.0]).is_err());
    assert!(PathFrame::osculating([1.0, 0.0], [f64::NAN, 0.0]).is_err());
    // Positions at opposite ends of the range have a direction, but no tracking error.
    assert!(PathFrame::between([-f64::MAX, 0.0], [f64::MAX, 0.0]).expect("finite").is_some());
    let fault = ContourError::from_points([0.0; 2], [f64::MAX, 0.0], [-f64::MAX, 0.0]);
    assert!(matches!(fault, Err(ContourFault::Range { quantity: "tracking error", .. })));
}

#[test]
fn commanded_points_keep_their_direction() {
    let mut path = CommandedPath::default();
    assert_eq!(
        (path.update([f64::NAN, 0.0]), path.update([2.0, 1.0]), path.update([2.0, 1.0])),
        (None, None, None)
    );
    let frame = path.update([2.0, 3.0]).expect("a direction");
    assert_eq!((frame.tangent(), frame.curvature()), ([0.0, 1.0], 0.0));
    assert_eq!(path.update([2.0, 3.0]), Some(frame));
    assert_eq!(path.update([2.0, f64::INFINITY]), Some(frame));
    // From the last point that was finite.
    assert_eq!(path.update([1.0, 3.0]).expect("a direction").tangent(), [-1.0, 0.0]);
    assert_eq!(path.frame().map(PathFrame::tangent), Some([-1.0, 0.0]));
}
