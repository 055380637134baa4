//! Newton's method for the equations of a shaper.

use core::mem::swap;

/// One row of a system of linear equations: coefficients and right-hand side.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row<const N: usize> {
    pub(crate) coefficients: [f64; N],
    pub(crate) right: f64,
}

impl<const N: usize> Row<N> {
    /// A row of zeros.
    pub(crate) const ZERO: Self = Self { coefficients: [0.0; N], right: 0.0 };

    fn at(&self, column: usize) -> f64 {
        self.coefficients.get(column).copied().unwrap_or(0.0)
    }

    /// Subtracts `factor` times the columns of `other` from `column` on.
    fn subtract(&mut self, factor: f64, other: &Self, column: usize) {
        let from = self.coefficients.iter_mut().zip(&other.coefficients).skip(column);
        from.for_each(|(a, b)| *a -= factor * b);
        self.right -= factor * other.right;
    }
}

/// The solution of `N` linear equations by elimination with partial pivoting; `None` where they are singular.
pub(crate) fn solved<const N: usize>(rows: &mut [Row<N>; N]) -> Option<[f64; N]> {
    for column in 0..N {
        let (first, below) = rows.get_mut(column..)?.split_first_mut()?;
        for row in below.iter_mut() {
            if row.at(column).abs() > first.at(column).abs() {
                swap(first, row);
            }
        }
        let pivot = first.at(column);
        if !(1.0 / pivot).is_finite() {
            return None;
        }
        for row in below {
            row.subtract(row.at(column) / pivot, first, column);
        }
    }
    let mut solution = [0.0; N];
    for column in (0..N).rev() {
        let row = rows.get(column)?;
        let known: f64 = row.coefficients.iter().zip(&solution).skip(column + 1).map(|(a, x)| a * x).sum();
        *solution.get_mut(column)? = (row.right - known) / row.at(column);
    }
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

/// Residuals that count as zero: a few roundings of terms of the order of one.
const ZERO: f64 = 1e-15;
/// The largest residual that is accepted where rounding stops the method earlier.
const ACCEPTED: f64 = 1e-13;
/// A start that is worth something needs no more steps.
const STEPS: usize = 10;

/// The zero of `equations` near `start`; each row holds the gradient of one of them and, on the right, its value.
pub(crate) fn newton<const N: usize>(
    start: [f64; N],
    equations: impl Fn(&[f64; N]) -> [Row<N>; N],
) -> Option<[f64; N]> {
    let size = |rows: &[Row<N>; N]| rows.iter().fold(0.0_f64, |most, row| most.max(row.right.abs()));
    let mut unknowns = start;
    let mut rows = equations(&unknowns);
    let mut residual = size(&rows);
    for _ in 0..STEPS {
        if residual <= ZERO {
            break;
        }
        let step = solved(&mut rows)?;
        let mut next = unknowns;
        next.iter_mut().zip(&step).for_each(|(x, dx)| *x -= dx);
        let next_rows = equations(&next);
        let next_residual = size(&next_rows);
        if residual <= ACCEPTED && (next_residual >= residual || next_residual.is_nan()) {
            break;
        }
        (unknowns, rows, residual) = (next, next_rows, next_residual);
        if !residual.is_finite() || residual > 1e6 {
            return None;
        }
    }
    (residual <= ACCEPTED).then_some(unknowns)
}

/// What a way along a parameter comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Continued<const N: usize> {
    /// The solution at its end.
    Reached([f64; N]),
    /// The last value of the parameter at which there was one.
    Lost(f64),
}

/// Steps tried along a parameter before it is given up.
const TRIES: usize = 100;
/// The longest step of a way that is gone with care.
const CAREFUL: f64 = 0.03;
/// The shortest step.
const SHORTEST: f64 = 1e-5;

/// Follows the zero that `known` is at the parameter 0 to the parameter `target > 0`: in one step if `guess` is good
/// enough for that, else in as many as it takes, each from a straight line through the last two.
pub(crate) fn continued<const N: usize>(
    known: [f64; N],
    target: f64,
    guess: impl Fn(f64) -> [f64; N],
    solution: impl Fn(f64, [f64; N]) -> Option<[f64; N]>,
) -> Continued<N> {
    if let Some(found) = solution(target, guess(target)) {
        return Continued::Reached(found);
    }
    let mut before = (0.0, known);
    let mut last = (0.0, known);
    let mut step = CAREFUL;
    for _ in 0..TRIES {
        let next = if last.0 + step < target { last.0 + step } else { target };
        let start = if last.0 > 0.0 {
            let ahead = (next - last.0) / (last.0 - before.0);
            let mut line = last.1;
            line.iter_mut().zip(&before.1).for_each(|(x, old)| *x += ahead * (*x - old));
            line
        } else {
            guess(next)
        };
        match solution(next, start) {
            Some(found) if next >= target => return Continued::Reached(found),
            Some(found) => {
                before = last;
                last = (next, found);
                step = (1.5 * step).min(CAREFUL);
            }
            None => step *= 0.5,
        }
        if step < SHORTEST {
            break;
        }
    }
    Continued::Lost(last.0)
}
