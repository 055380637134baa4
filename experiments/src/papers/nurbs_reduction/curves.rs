//! The curves, from their file.

use anyhow::{Context as _, Result, ensure};
use profiles::nurbs::NurbsCurve;
use serde::Deserialize;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// The control points, published beside the rows.
const CURVES: &str = include_str!("../../../papers/nurbs-reduction/curves.toml");

/// The unit of the file in m.
const MILLIMETRE: f64 = 1e-3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    curve: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    id: String,
    title: String,
    degree: usize,
    #[serde(default)]
    raised: usize,
    to: usize,
    knots: Vec<f64>,
    weights: Vec<f64>,
    points: Vec<Vec<f64>>,
}

/// A curve to be reduced.
pub(super) struct Named {
    /// For rows and figures.
    pub(super) id: String,
    /// In words.
    pub(super) title: String,
    /// The degree it is reduced to.
    pub(super) to: usize,
    /// The curve, in m.
    pub(super) shape: Shape,
}

/// A curve in the plane or in space.
pub(super) enum Shape {
    Planar(NurbsCurve<2>),
    Spatial(NurbsCurve<3>),
}

fn curve<const D: usize>(entry: &Entry) -> Result<NurbsCurve<D>> {
    let point = |point: &Vec<f64>| -> Result<[f64; D]> {
        let point: [f64; D] = point.as_slice().try_into().context("a point of another dimension")?;
        Ok(point.map(|x| MILLIMETRE * x))
    };
    let points = entry.points.iter().map(point).collect::<Result<Vec<_>>>()?;
    let curve = NurbsCurve::new(entry.degree, &points, &entry.weights, entry.knots.clone())?;
    Ok(curve.raised(entry.raised)?)
}

/// All curves of the file.
pub(super) fn read() -> Result<Vec<Named>> {
    let file: File = toml::from_str(CURVES).context("curves.toml")?;
    let named = |entry: Entry| -> Result<Named> {
        let dimension = entry.points.first().map_or(0, Vec::len);
        ensure!(matches!(dimension, 2 | 3), "curve '{}': {dimension} dimensions", entry.id);
        let shape =
            if dimension == 2 { Shape::Planar(curve(&entry)?) } else { Shape::Spatial(curve(&entry)?) };
        Ok(Named { id: entry.id, title: entry.title, to: entry.to, shape })
    };
    file.curve.into_iter().map(named).collect()
}
