//! Cholesky's factorisation inside the envelope of a matrix: A = L Lᵀ with
//! L_ij = (A_ij − Σ_{k<j} L_ik L_jk) / L_jj, where row i begins at its first nonzero entry.

/// A symmetric matrix, later its factor: row i holds the columns `first[i]..=i`.
#[derive(Clone, Debug)]
pub struct Envelope {
    first: Vec<usize>,
    rows: Vec<Vec<f64>>,
}

/// The factor L of a positive definite matrix.
#[derive(Clone, Debug)]
pub struct Factor(Envelope);

impl Envelope {
    /// The matrix with these entries (row, column, value); those above the diagonal are ignored.
    pub fn new(n: usize, entries: &[(usize, usize, f64)]) -> Self {
        let mut first: Vec<usize> = (0..n).collect();
        for &(i, j, _) in entries {
            first[i] = first[i].min(j);
        }
        let mut rows: Vec<Vec<f64>> = (0..n).map(|i| vec![0.0; i + 1 - first[i]]).collect();
        for &(i, j, value) in entries.iter().filter(|(i, j, _)| j <= i) {
            rows[i][j - first[i]] += value;
        }
        Self { first, rows }
    }

    /// L, or `None` unless the matrix is positive definite.
    pub fn factor(mut self) -> Option<Factor> {
        for i in 0..self.rows.len() {
            let (above, rest) = self.rows.split_at_mut(i);
            let (row, start) = (&mut rest[0], self.first[i]);
            for j in start..i {
                let from = start.max(self.first[j]);
                let other = &above[j][from - self.first[j]..];
                let known: f64 =
                    row[from - start..j - start].iter().zip(other).map(|(a, b)| a * b).sum();
                row[j - start] = (row[j - start] - known) / above[j][j - self.first[j]];
            }
            let known: f64 = row[..i - start].iter().map(|l| l * l).sum();
            let square = row[i - start] - known;
            if square <= 0.0 || square.is_nan() {
                return None;
            }
            row[i - start] = square.sqrt();
        }
        Some(Factor(self))
    }
}

impl Factor {
    /// x with L Lᵀ x = b.
    pub fn solve(&self, mut x: Vec<f64>) -> Vec<f64> {
        let Envelope { first, rows } = &self.0;
        for (i, row) in rows.iter().enumerate() {
            let known: f64 = row.iter().zip(&x[first[i]..i]).map(|(l, x)| l * x).sum();
            x[i] = (x[i] - known) / row[i - first[i]];
        }
        for (i, row) in rows.iter().enumerate().rev() {
            x[i] /= row[i - first[i]];
            let value = x[i];
            for (x, l) in x[first[i]..i].iter_mut().zip(row) {
                *x -= l * value;
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::Envelope;
    use signorini_tolerances::twins::OWN_SOLVE;

    #[test]
    fn solves_the_second_difference_matrix_with_a_far_corner() {
        let n = 6;
        let mut entries: Vec<_> = (0..n).map(|i| (i, i, 3.0)).collect();
        entries.extend((1..n).map(|i| (i, i - 1, -1.0)));
        entries.push((n - 1, 0, 0.5));
        let mut full = vec![vec![0.0; n]; n];
        for &(i, j, value) in &entries {
            full[i][j] = value;
            full[j][i] = value;
        }
        let x: Vec<f64> = (0..n).map(|i| i as f64 - 2.0).collect();
        let b: Vec<f64> =
            full.iter().map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect();
        let solved = Envelope::new(n, &entries).factor().expect("diagonally dominant").solve(b);
        OWN_SOLVE.check_each("x", &solved, &x);
    }

    #[test]
    fn an_indefinite_matrix_has_no_factor() {
        let entries = [(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)];
        assert!(Envelope::new(2, &entries).factor().is_none());
    }
}
