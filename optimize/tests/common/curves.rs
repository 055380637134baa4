//! Curves with known reductions.
#![allow(unreachable_pub, reason = "shared by test programs")]
#![allow(dead_code, reason = "every test program uses its part")]

use profiles::nurbs::{Knots, NurbsCurve};

/// A free planar quintic of one piece.
pub fn quintic() -> NurbsCurve<2> {
    let points = [[-5.0, 0.0], [-7.0, 2.0], [-3.0, 5.0], [2.0, 6.0], [5.0, 3.0], [3.0, 0.0]];
    NurbsCurve::bezier(&points).expect("valid")
}

/// A cubic with three inner knots and weights between 0.6 and 2.
pub fn cubic() -> NurbsCurve<2> {
    let points =
        [[0.0, 0.0], [10.0, 25.0], [30.0, 35.0], [45.0, 5.0], [60.0, -5.0], [80.0, 20.0], [100.0, 0.0]];
    let knots = Knots::clamped(3, 0.0, &[0.3, 0.55, 0.8], 1.0).expect("valid");
    NurbsCurve::with_knots(knots, &points, &[1.0, 1.5, 0.8, 2.0, 1.0, 0.6, 1.0]).expect("valid")
}

/// A quarter of the unit circle as a quartic.
pub fn quarter() -> NurbsCurve<2> {
    let weights = [1.0, 0.5_f64.sqrt(), 1.0];
    let circle = NurbsCurve::rational_bezier(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &weights);
    circle.and_then(|circle| circle.raised(2)).expect("valid")
}

/// A spatial quintic with two inner knots.
pub fn spatial() -> NurbsCurve<3> {
    let points = [
        [0.0, 0.0, 0.0],
        [10.0, 40.0, 5.0],
        [35.0, 45.0, 20.0],
        [50.0, 0.0, 35.0],
        [60.0, -30.0, 30.0],
        [75.0, 10.0, 10.0],
        [90.0, 30.0, 0.0],
        [100.0, 0.0, -5.0],
    ];
    let knots = Knots::clamped(5, 0.0, &[0.4, 0.7], 1.0).expect("valid");
    let weights = [1.0, 1.2, 0.9, 1.5, 0.8, 1.1, 1.3, 1.0];
    NurbsCurve::with_knots(knots, &points, &weights).expect("valid")
}

/// The butterfly that interpolators are tried on: 51 points, 48 spans.
pub fn butterfly() -> NurbsCurve<2> {
    let inner = [
        0.0083, 0.015, 0.0361, 0.0855, 0.1293, 0.1509, 0.1931, 0.2273, 0.2435, 0.2561, 0.2692, 0.2889, 0.317,
        0.3316, 0.3482, 0.3553, 0.3649, 0.3837, 0.4005, 0.4269, 0.451, 0.466, 0.4891, 0.5, 0.5109, 0.534,
        0.5489, 0.5731, 0.5994, 0.6163, 0.6351, 0.6447, 0.6518, 0.6683, 0.683, 0.7111, 0.7307, 0.7439,
        0.7565, 0.7729, 0.8069, 0.8491, 0.8707, 0.9145, 0.9639, 0.985, 0.9917,
    ];
    let points = [
        [54.493, 52.139],
        [55.507, 52.139],
        [56.082, 49.615],
        [56.78, 44.971],
        [69.575, 51.358],
        [77.786, 58.573],
        [90.526, 67.081],
        [105.973, 63.801],
        [100.4, 47.326],
        [94.567, 39.913],
        [92.369, 30.485],
        [83.44, 33.757],
        [91.892, 28.509],
        [89.444, 20.393],
        [83.218, 15.446],
        [87.621, 4.83],
        [80.945, 9.267],
        [79.834, 14.535],
        [76.074, 8.522],
        [70.183, 12.55],
        [64.171, 16.865],
        [59.993, 22.122],
        [55.68, 36.359],
        [56.925, 24.995],
        [59.765, 19.828],
        [54.493, 14.94],
        [49.22, 19.828],
        [52.06, 24.994],
        [53.305, 36.359],
        [48.992, 22.122],
        [44.814, 16.865],
        [38.802, 12.551],
        [32.911, 8.521],
        [29.152, 14.535],
        [28.04, 9.267],
        [21.364, 4.83],
        [25.768, 15.447],
        [19.539, 20.391],
        [17.097, 28.512],
        [25.537, 33.75],
        [16.602, 30.496],
        [14.199, 39.803],
        [8.668, 47.408],
        [3.0, 63.794],
        [18.465, 67.084],
        [31.197, 58.572],
        [39.411, 51.358],
        [52.204, 44.971],
        [52.904, 49.614],
        [53.478, 52.139],
        [54.492, 52.139],
    ];
    let mut weights = [1.0; 51];
    for (index, weight) in
        [(3, 1.2), (11, 2.0), (14, 5.0), (15, 3.0), (17, 1.1), (33, 1.1), (35, 3.0), (36, 5.0)]
    {
        weights[index] = weight;
    }
    weights[39] = 2.0;
    weights[47] = 1.2;
    let knots = Knots::clamped(3, 0.0, &inner, 1.0).expect("valid");
    NurbsCurve::with_knots(knots, &points, &weights).expect("valid")
}

/// The largest distance at evenly spaced parameters.
pub fn sampled<const D: usize>(a: &NurbsCurve<D>, b: &NurbsCurve<D>, samples: usize) -> f64 {
    let domain = a.domain();
    let distance = |k: usize| {
        let u = domain.lower + (domain.upper - domain.lower) * k as f64 / (samples - 1) as f64;
        let square: f64 = a.point(u).iter().zip(b.point(u)).map(|(x, y)| (x - y) * (x - y)).sum();
        square.sqrt()
    };
    (0..samples).map(distance).fold(0.0, f64::max)
}
