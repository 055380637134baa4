//! A curve as it is written down: points by their coordinates, weights only where they differ from one.

use alloc::vec::Vec;

use super::{Knots, NurbsCurve, NurbsError};

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct UncheckedCurve {
    degree: usize,
    points: Vec<Vec<f64>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    weights: Vec<f64>,
    knots: Vec<f64>,
}

impl<const D: usize> TryFrom<UncheckedCurve> for NurbsCurve<D> {
    type Error = NurbsError;
    fn try_from(unchecked: UncheckedCurve) -> Result<Self, NurbsError> {
        let UncheckedCurve { degree, points, weights, knots } = unchecked;
        let coordinates = |(index, point): (usize, &Vec<f64>)| {
            <[f64; D]>::try_from(point.as_slice()).map_err(|_| NurbsError::Dimension {
                index,
                found: point.len(),
                needed: D,
            })
        };
        let points = points.iter().enumerate().map(coordinates).collect::<Result<Vec<_>, _>>()?;
        if weights.is_empty() {
            Self::bspline(degree, &points, knots)
        } else {
            Self::new(degree, &points, &weights, knots)
        }
    }
}

impl<const D: usize> From<NurbsCurve<D>> for UncheckedCurve {
    fn from(curve: NurbsCurve<D>) -> Self {
        let weights: Vec<f64> = curve.weights().collect();
        let plain = weights.iter().all(|w| (*w - 1.0).abs() <= 0.0);
        Self {
            degree: curve.degree(),
            points: curve.control_points().map(|point| point.to_vec()).collect(),
            weights: if plain { Vec::new() } else { weights },
            knots: curve.into_parts().0.into_vec(),
        }
    }
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct UncheckedKnots {
    degree: usize,
    knots: Vec<f64>,
}

impl TryFrom<UncheckedKnots> for Knots {
    type Error = NurbsError;
    fn try_from(unchecked: UncheckedKnots) -> Result<Self, NurbsError> {
        Self::new(unchecked.degree, unchecked.knots)
    }
}

impl From<Knots> for UncheckedKnots {
    fn from(knots: Knots) -> Self {
        Self { degree: knots.degree(), knots: knots.into_vec() }
    }
}
