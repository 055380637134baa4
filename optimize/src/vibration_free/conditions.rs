//! The conditions of a structure: value, gradient and second derivatives by the durations.

use nalgebra::{DMatrix, DVector};
use profiles::switched::{Condition, Zero};

use super::structure::Structure;
use super::task::{Place, Task};
use super::{MOST_ARCS, Motion};

/// Conditions `g`, each scaled by its largest derivative.
pub(super) struct Conditions {
    exact: Vec<Condition<MOST_ARCS>>,
    bands: Vec<Amplitude>,
    pub(super) values: DVector<f64>,
    /// A row of derivatives for each condition.
    pub(super) gradients: DMatrix<f64>,
    /// What each was divided by.
    pub(super) scales: DVector<f64>,
}

/// `(|q|^2 / r^2 - 1) / 2 = 0`: what is left at a pole is as much as is tolerated.
struct Amplitude {
    parts: [Condition<MOST_ARCS>; 2],
    tolerated: f64,
}

impl Amplitude {
    fn of(motion: &Motion, task: &Task, place: &Place) -> Option<Self> {
        let mut parts = Vec::with_capacity(6);
        motion
            .conditions(&task.goal, &[Zero::at(place.pole, false)], &[], |condition| parts.push(*condition));
        let (im, re) = (parts.pop()?, parts.pop()?);
        Some(Self { parts: [re, im], tolerated: place.tolerated })
    }

    fn value(&self) -> f64 {
        let squares: f64 = self.parts.iter().map(|part| (part.value / self.tolerated).powi(2)).sum();
        0.5 * (squares - 1.0)
    }

    fn gradient(&self, k: usize) -> f64 {
        self.parts.iter().map(|part| part.value * part.gradient[k]).sum::<f64>() / self.tolerated.powi(2)
    }
}

impl Conditions {
    /// None where the arcs do not determine them.
    pub(super) fn of(task: &Task, motion: &Motion, structure: &Structure) -> Option<Self> {
        let n = motion.arcs().len();
        let mut exact = Vec::with_capacity(n);
        motion.conditions(&task.goal, &task.zeros, &structure.contacts, |condition| exact.push(*condition));
        let bands: Vec<Amplitude> =
            structure.places.iter().map(|place| Amplitude::of(motion, task, place)).collect::<Option<_>>()?;
        let (first, m) = (exact.len(), exact.len() + bands.len());
        if m > n {
            return None;
        }
        let mut gradients = DMatrix::from_fn(m, n, |i, k| match exact.get(i) {
            Some(condition) => condition.gradient[k],
            None => bands[i - first].gradient(k),
        });
        let mut values = DVector::from_iterator(
            m,
            exact.iter().map(|condition| condition.value).chain(bands.iter().map(Amplitude::value)),
        );
        let scales = DVector::from_iterator(m, gradients.row_iter().map(|row| row.amax()));
        if scales.iter().any(|scale| !(*scale > 0.0 && scale.is_finite())) {
            return None;
        }
        for (i, scale) in scales.iter().enumerate() {
            gradients.row_mut(i).unscale_mut(*scale);
            values[i] /= scale;
        }
        Some(Self { exact, bands, values, gradients, scales })
    }

    /// `sum of l_i H_i`, with `H_i` the second derivatives of the scaled conditions.
    pub(super) fn curvature(&self, motion: &Motion, multipliers: &DVector<f64>) -> DMatrix<f64> {
        let n = motion.arcs().len();
        let jerks: Vec<f64> = motion.arcs().iter().map(|arc| arc.jerk).collect();
        let mut sum = DMatrix::zeros(n, n);
        let mut add = |condition: &Condition<MOST_ARCS>, factor: f64| {
            for k in 0..condition.arcs {
                for l in 0..condition.arcs {
                    let bend = condition.bend * jerks[k] * jerks[l];
                    sum[(k, l)] += factor * (condition.curvature[k.min(l)] - bend);
                }
            }
        };
        let weights = multipliers.component_div(&self.scales);
        for (condition, weight) in self.exact.iter().zip(weights.iter()) {
            add(condition, *weight);
        }
        for (band, weight) in self.bands.iter().zip(weights.iter().skip(self.exact.len())) {
            let weight = weight / band.tolerated.powi(2);
            band.parts.iter().for_each(|part| add(part, weight * part.value));
        }
        for (band, weight) in self.bands.iter().zip(weights.iter().skip(self.exact.len())) {
            let weight = weight / band.tolerated.powi(2);
            for part in &band.parts {
                let gradient = DVector::from_column_slice(&part.gradient[..n]);
                sum.ger(weight, &gradient, &gradient, 1.0);
            }
        }
        sum
    }
}
