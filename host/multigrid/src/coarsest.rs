//! The coarsest matrix, dense: a Cholesky factor in f64.

use crate::sparse::Sparse;

/// A pivot that has lost all but this part of its diagonal entry counts as 0: nothing but contact holds that part, and nothing touches there.
const SINGULAR: f64 = 1e-12;

/// A = LLᵀ, row by row; an infinite pivot keeps its unknown at 0.
#[derive(Debug, Default)]
pub(crate) struct Coarsest {
    matrix: Vec<f64>,
    factor: Vec<f64>,
    n: usize,
    x: Vec<f64>,
}

impl Coarsest {
    pub fn new(sparse: &Sparse) -> Self {
        let n = sparse.rows();
        let mut matrix = vec![0.0; n * n];
        for row in 0..n {
            for &(column, value) in sparse.row(row) {
                matrix[row * n + column as usize] = value;
            }
        }
        let mut new = Self { matrix, factor: Vec::new(), n, x: vec![0.0; n] };
        new.hold(&[]);
        new
    }

    /// Factors the matrix with these unknowns held at 0.
    pub fn hold(&mut self, held: &[u32]) {
        let n = self.n;
        self.factor.clone_from(&self.matrix);
        for &at in held {
            self.drop_unknown(at as usize);
        }
        for j in 0..n {
            let (above, below) = self.factor.split_at_mut((j + 1) * n);
            let row = &mut above[j * n..];
            let pivot = row[j] - dot(&row[..j], &row[..j]);
            // An infinite pivot makes all of its column 0, and its unknown.
            row[j] = if pivot > SINGULAR * row[j] { pivot.sqrt() } else { f64::INFINITY };
            for other in below.chunks_mut(n) {
                other[j] = (other[j] - dot(&other[..j], &row[..j])) / row[j];
            }
        }
    }

    /// Puts other values into a row; a row of 0 holds its unknown.
    pub fn set_row(&mut self, row: u32, value: impl Fn(u32) -> f64) {
        let start = row as usize * self.n;
        let row = self.matrix[start..start + self.n].iter_mut();
        row.zip(0..).for_each(|(entry, column)| *entry = value(column));
    }

    fn drop_unknown(&mut self, at: usize) {
        let n = self.n;
        self.factor[at * n..(at + 1) * n].fill(0.0);
        self.factor[at..].iter_mut().step_by(n).for_each(|entry| *entry = 0.0);
        self.factor[at * n + at] = f64::INFINITY;
    }

    /// x with A x = `load`, written over it.
    pub fn solve(&mut self, load: &mut [f32]) {
        let n = self.n;
        for i in 0..n {
            let row = &self.factor[i * n..(i + 1) * n];
            self.x[i] = (f64::from(load[i]) - dot(&row[..i], &self.x[..i])) / row[i];
        }
        for i in (0..n).rev() {
            let row = &self.factor[i * n..(i + 1) * n];
            self.x[i] /= row[i];
            let own = self.x[i];
            self.x[..i].iter_mut().zip(row).for_each(|(x, entry)| *x -= entry * own);
            load[i] = own as f32;
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
