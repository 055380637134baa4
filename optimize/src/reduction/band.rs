//! Symmetric positive definite systems with a band.

/// A symmetric matrix that is zero further than `width - 1` off its diagonal: rows of the lower triangle, each with
/// `width` entries of which the last is the diagonal's.
#[derive(Debug, Clone)]
pub(super) struct Band {
    width: usize,
    rows: Vec<f64>,
}

impl Band {
    pub(super) fn new(size: usize, width: usize) -> Self {
        Self { width, rows: vec![0.0; size * width] }
    }

    pub(super) fn clear(&mut self) {
        self.rows.fill(0.0);
    }

    /// The entries of `row` in the columns from `column` to at most the diagonal; both in the band.
    #[inline]
    pub(super) fn entries(&mut self, row: usize, column: usize) -> &mut [f64] {
        let end = (row + 1) * self.width;
        let start = end - 1 - (row - column);
        self.rows.get_mut(start..end).unwrap_or_default()
    }

    /// The entry, wherever it lies in the band.
    pub(super) fn at(&mut self, a: usize, b: usize) -> Option<&mut f64> {
        let (row, column) = (a.max(b), a.min(b));
        if row - column < self.width { self.entries(row, column).first_mut() } else { None }
    }

    /// Replaces the matrix by its factors `L D L'`. A pivot that roundings have left without meaning becomes so large
    /// that the unknown stays where it is.
    pub(super) fn factor(&mut self) {
        let width = self.width;
        let size = self.rows.len() / width;
        let most = self.rows.iter().skip(width - 1).step_by(width).fold(0.0, |most: f64, d| most.max(*d));
        for row in 0..size {
            let (done, rest) = self.rows.split_at_mut(row * width);
            let Some(current) = rest.get_mut(..width) else { return };
            let reach = row.min(width - 1);
            // Column by column of this row: entry = (entry - sum L D L) / D.
            for column in row - reach..row {
                let above = &done[column * width..(column + 1) * width];
                let shared = reach.min(width - 1 - (row - column));
                let first = row - column;
                let mut sum = current[width - 1 - first];
                let overlap = shared.min(column);
                let mine = &current[width - 1 - first - overlap..width - 1 - first];
                let theirs = &above[width - 1 - overlap..width - 1];
                sum -= mine.iter().zip(theirs).map(|(x, y)| x * y).sum::<f64>();
                current[width - 1 - first] = sum;
            }
            // The row holds L D now: the diagonal, and then L.
            let mut pivot = current[width - 1];
            for column in row - reach..row {
                let diagonal = done[(column + 1) * width - 1];
                let entry = &mut current[width - 1 - (row - column)];
                let scaled = *entry / diagonal;
                pivot -= *entry * scaled;
                *entry = scaled;
            }
            let trusted = pivot > 1e-15 * current[width - 1].abs() && pivot > f64::MIN_POSITIVE;
            current[width - 1] = if trusted { pivot } else { 1e30 * most.max(1.0) };
        }
    }

    /// Solves for a right side in place, once the matrix is factored.
    pub(super) fn solve(&self, right: &mut [f64]) {
        let width = self.width;
        for (row, factors) in self.rows.chunks_exact(width).enumerate() {
            let reach = row.min(width - 1);
            let known = &right[row - reach..row];
            let sum: f64 = known.iter().zip(&factors[width - 1 - reach..width - 1]).map(|(x, y)| x * y).sum();
            right[row] -= sum;
        }
        for (x, factors) in right.iter_mut().zip(self.rows.chunks_exact(width)) {
            *x /= factors[width - 1];
        }
        for (row, factors) in self.rows.chunks_exact(width).enumerate().rev() {
            let reach = row.min(width - 1);
            let x = right[row];
            let above = &mut right[row - reach..row];
            above.iter_mut().zip(&factors[width - 1 - reach..width - 1]).for_each(|(y, l)| *y -= l * x);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stream;

    #[test]
    fn solves_what_it_was_made_of() {
        // A = B B' + I with B lower banded: positive definite, and the band of B.
        for (size, width) in [(1, 1), (2, 4), (9, 1), (12, 5), (30, 9), (7, 7)] {
            let mut stream = Stream::new(3, size as u64, width as u64);
            let mut b = vec![vec![0.0; size]; size];
            for (row, entries) in b.iter_mut().enumerate() {
                for entry in &mut entries[row.saturating_sub((width - 1) / 2)..=row] {
                    *entry = 2.0 * stream.uniform() - 1.0;
                }
            }
            let entry = |r: usize, c: usize| {
                (0..size).map(|k| b[r][k] * b[c][k]).sum::<f64>() + if r == c { 1.0 } else { 0.0 }
            };
            let mut band = Band::new(size, width);
            for row in 0..size {
                for column in row.saturating_sub(width - 1)..=row {
                    *band.at(column, row).expect("in the band") = entry(row, column);
                }
            }
            assert!(size < 2 || width > 1 || band.at(0, 1).is_none());
            let x: Vec<f64> = (0..size).map(|_| stream.uniform()).collect();
            let mut right: Vec<f64> =
                (0..size).map(|r| (0..size).map(|c| entry(r, c) * x[c]).sum()).collect();
            band.factor();
            band.solve(&mut right);
            // Conditions are of the order of ten.
            assert!(right.iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-13), "{size} {width}");
        }
    }

    #[test]
    fn an_unknown_without_meaning_stays() {
        let mut band = Band::new(2, 2);
        for (row, column) in [(0, 0), (1, 0), (1, 1)] {
            *band.at(row, column).expect("inside") = 1.0;
        }
        let mut right = [1.0, 1.0];
        band.factor();
        band.solve(&mut right);
        assert!((right[0] - 1.0).abs() < 1e-15 && right[1].abs() < 1e-15);
    }
}
