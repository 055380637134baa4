//! What runs in a control tick leaves the heap alone, whatever the degree.

use allocation_counter::measure;
use profiles::nurbs::{ArcLength, Knots, NurbsCurve, Side};

#[test]
fn evaluation_does_not_allocate() {
    for degree in [1, 2, 3, 5, 6, 15] {
        let knots = Knots::uniform(degree, degree + 5).expect("knots");
        let points: Vec<[f64; 3]> = knots.greville().map(|u| [u, u * u, 1.0 / (1.0 + u)]).collect();
        let weights: Vec<f64> = (0..points.len()).map(|k| 1.0 + 0.1 * (k % 3) as f64).collect();
        let curve = NurbsCurve::with_knots(knots, &points, &weights).expect("curve");
        let path = ArcLength::new(curve, 1e-9).expect("table");
        let curve = path.curve();
        let mut sum = 0.0;
        let counted = measure(|| {
            for k in 0..100 {
                let u = f64::from(k) / 99.0;
                sum += curve.point(u)[0] + curve.derivatives::<4>(u)[3][1];
                sum += curve.knots().basis(u, Side::After).values()[0];
                sum += curve.curvature(u, Side::Before).unwrap_or(0.0);
                sum += curve.torsion(u, Side::Before).unwrap_or(0.0);
                sum += curve.tangent(u, Side::After).map_or(0.0, |t| t[0]);
                sum += curve.by_length(u, Side::After).map_or(0.0, |d| d[3][2]);
                sum += path.parameter_at(path.length_at(u));
            }
        });
        assert_eq!(counted.count_total, 0, "degree {degree}");
        assert!(sum.is_finite());
    }
}
