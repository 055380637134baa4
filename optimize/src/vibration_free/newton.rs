//! The optimum of a structure, by Newton's method on its conditions and on the stationarity of the duration.

use nalgebra::{DMatrix, DVector};
use profiles::switched::Arc;

use super::Motion;
use super::conditions::Conditions;
use super::structure::Structure;
use super::task::Task;

/// Steps before a structure is given up.
const STEPS: usize = 30;
/// A step after which a method that converges quadratically has got to rounding.
const CLOSE: f64 = 1e-8;
/// A step that leads nowhere, as a part of the S-curve's duration.
const WILD: f64 = 2.0;

/// A motion with the multipliers of its conditions: what the duration costs by each.
#[derive(Debug, Clone)]
pub(super) struct Optimum {
    pub(super) motion: Motion,
    pub(super) multipliers: Vec<f64>,
}

/// A stationary point of the Lagrangian `sum of d_k - sum of l_i g_i` in the durations `d` and the multipliers `l` of the
/// conditions `g`, from the durations of the structure and, where they are known, from multipliers.
///
/// None where the method does not converge or where conditions depend on each other. A duration may come out negative:
/// then the structure is not that of an optimum.
pub(super) fn stationary(task: &Task, structure: &Structure, multipliers: Option<&[f64]>) -> Option<Optimum> {
    let mut motion = Motion::new(task.from, &structure.arcs)?;
    let mut multipliers = multipliers.map(DVector::from_column_slice);
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let n = motion.arcs().len();
        let conditions = Conditions::of(task, &motion, structure)?;
        let m = conditions.values.len();
        let gradients = &conditions.gradients;
        let scaled = match multipliers.take() {
            Some(known) if known.len() == m => known.component_mul(&conditions.scales),
            // Those that leave the least of the gradient.
            _ => {
                let gram = gradients * gradients.transpose();
                gram.lu().solve(&(gradients * DVector::from_element(n, 1.0)))?
            }
        };
        let mut system = DMatrix::zeros(n + m, n + m);
        system.view_mut((0, 0), (n, n)).copy_from(&-conditions.curvature(&motion, &scaled));
        system.view_mut((n, 0), (m, n)).copy_from(gradients);
        system.view_mut((0, n), (n, m)).copy_from(&-gradients.transpose());
        let mut right = DVector::zeros(n + m);
        right.rows_mut(0, n).copy_from(&(DVector::from_element(n, 1.0) - gradients.tr_mul(&scaled)));
        right.rows_mut(n, m).copy_from(&conditions.values);
        let step = system.lu().solve(&right)?;
        let length = step.rows(0, n).amax();
        if length.is_nan() || length > WILD {
            return None;
        }
        let changed = motion.arcs().iter().zip(step.iter());
        let arcs: Vec<Arc> =
            changed.map(|(arc, change)| Arc { duration: arc.duration - change, ..*arc }).collect();
        motion = Motion::new(task.from, &arcs)?;
        let next = (scaled - step.rows(n, m)).component_div(&conditions.scales);
        if length < CLOSE && (length >= 0.5 * before || length < 1e-14) {
            return Some(Optimum { motion, multipliers: next.iter().copied().collect() });
        }
        multipliers = Some(next);
        before = length;
    }
    None
}
