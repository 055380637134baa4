//! Linear and second-order cone programmes, row by row.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

/// One affine expression: `constant + sum of coefficient x_index`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Affine {
    pub(crate) terms: Vec<(usize, f64)>,
    pub(crate) constant: f64,
}

/// Minimise a linear cost over affine expressions that are zero, not negative, or in a cone.
#[derive(Debug, Clone, Default)]
pub(crate) struct Programme {
    cost: Vec<f64>,
    zero: Vec<Affine>,
    positive: Vec<Affine>,
    /// The length of the last two is at most the first.
    cones: Vec<[Affine; 3]>,
}

impl Programme {
    pub(crate) fn new(cost: Vec<f64>) -> Self {
        Self { cost, ..Self::default() }
    }

    pub(crate) fn zero(&mut self, expression: Affine) {
        self.zero.push(expression);
    }

    pub(crate) fn positive(&mut self, expression: Affine) {
        self.positive.push(expression);
    }

    pub(crate) fn cone(&mut self, bound: Affine, re: Affine, im: Affine) {
        self.cones.push([bound, re, im]);
    }

    /// The minimiser to eleven digits, `None` where the solver found none.
    pub(crate) fn solved(&self) -> Option<Vec<f64>> {
        self.solved_to(1e-11).map(|(x, _)| x)
    }

    /// The minimiser and the minimum to a tolerance, `None` where the solver found none.
    pub(crate) fn solved_to(&self, tolerance: f64) -> Option<(Vec<f64>, f64)> {
        let (mut rows, mut columns, mut values, mut right) = (vec![], vec![], vec![], vec![]);
        let expressions = self.zero.iter().chain(&self.positive).chain(self.cones.iter().flatten());
        for (row, expression) in expressions.enumerate() {
            // Slack s = b - A x in the cone, so that A holds the coefficients with the other sign.
            for (column, coefficient) in &expression.terms {
                rows.push(row);
                columns.push(*column);
                values.push(-coefficient);
            }
            right.push(expression.constant);
        }
        let n = self.cost.len();
        let constraints = CscMatrix::new_from_triplets(right.len(), n, rows, columns, values);
        let mut cones = vec![
            SupportedConeT::ZeroConeT(self.zero.len()),
            SupportedConeT::NonnegativeConeT(self.positive.len()),
        ];
        cones.extend(self.cones.iter().map(|_| SupportedConeT::SecondOrderConeT(3)));
        let settings = DefaultSettings {
            verbose: false,
            max_threads: 1,
            tol_gap_abs: tolerance,
            tol_gap_rel: tolerance,
            tol_feas: tolerance,
            ..DefaultSettings::default()
        };
        let none = CscMatrix::zeros((n, n));
        let mut solver =
            DefaultSolver::new(&none, &self.cost, &constraints, &right, &cones, settings).ok()?;
        solver.solve();
        let solution = &solver.solution;
        let ended = matches!(
            solution.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress
        );
        (ended && solution.x.iter().all(|x| x.is_finite())).then(|| (solution.x.clone(), solution.obj_val))
    }
}
