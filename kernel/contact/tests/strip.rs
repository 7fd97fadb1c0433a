//! A strip of squares condensed to its lower edge by plain elimination: a realistic dense problem.

use signorini_contact::dense::blocks::{Block, Blocks, SIDE, padded};
use signorini_kernel::{Error, Real};

use crate::memory::Draw;

/// Five-point Laplacian on n × n points above the contact points, zero along the top.
pub struct Strip<R> {
    pub order: usize,
    entries: Vec<Vec<R>>,
    blocks: Vec<Block<R>>,
}

impl<R: Real> Strip<R> {
    pub fn new(order: usize) -> Self {
        Self::of(&condensed(order))
    }

    /// A strip, and beside it a string that nothing holds but contact: constants cost no energy there.
    pub fn partly_loose(order: usize) -> Self {
        let held = condensed(order);
        // Springs of any stiffness between neighbours, and a few further on: their sums round.
        let stiffness = |i: usize, j: usize| match i.abs_diff(j) {
            1 | 3 | 7 => 1.0 + 0.9 * ((i + j) as f64 * 1.7).sin(),
            _ => 0.0,
        };
        let all = order..2 * order;
        let string = |i: usize, j: usize| match i == j {
            true => all.clone().map(|k| stiffness(i, k)).sum(),
            false => -stiffness(i, j),
        };
        let entry = |i: usize, j: usize| match (i < order, j < order) {
            (true, true) => held[i][j],
            (false, false) => string(i, j),
            _ => 0.0,
        };
        let row = |i| (0..2 * order).map(|j| entry(i, j)).collect();
        Self::of(&(0..2 * order).map(row).collect::<Vec<_>>())
    }

    /// Scales to a unit diagonal.
    fn of(dense: &[Vec<f64>]) -> Self {
        let order = dense.len();
        let scaled = |i: usize, j: usize| dense[i][j] / (dense[i][i] * dense[j][j]).sqrt();
        let narrow = |x: f64| R::from_f64(x).unwrap_or(R::ZERO);
        let entries: Vec<Vec<R>> =
            (0..order).map(|i| (0..order).map(|j| narrow(scaled(i, j))).collect()).collect();
        let blocks = in_blocks(order, |i, j| entries[i][j]);
        Self { order, entries, blocks }
    }

    pub fn blocks(&self) -> &[Block<R>] {
        &self.blocks
    }

    pub fn matrix(&self) -> Result<Blocks<'_, R>, Error> {
        Blocks::new(&self.blocks, self.order)
    }

    pub fn at(&self, row: usize, column: usize) -> R {
        self.entries[row][column]
    }

    /// Lifts one side and presses the other, with noise; `shift` moves the border between them.
    pub fn load(&self, shift: f64, random: &mut Draw) -> Vec<R> {
        let at = |i: usize| (i as f64 + 0.5) / self.order as f64;
        let load = |i: usize| (6.0 * at(i)).sin() * 0.5 + shift + 0.2 * random.signed();
        let mut all: Vec<R> =
            (0..self.order).map(load).map(|x| R::from_f64(x).unwrap_or(R::ZERO)).collect();
        all.resize(padded(self.order), R::ZERO);
        all
    }
}

/// A symmetric matrix in blocks, with 0 in the padding.
pub fn in_blocks<R: Real>(order: usize, entry: impl Fn(usize, usize) -> R) -> Vec<Block<R>> {
    let entry = |i: usize, j: usize| if i.max(j) < order { entry(i, j) } else { R::ZERO };
    let block = |(row, column): (usize, usize)| {
        let line = |r: usize| std::array::from_fn(|c| entry(SIDE * row + r, SIDE * column + c));
        std::array::from_fn(line)
    };
    let rows = 0..order.div_ceil(SIDE);
    rows.flat_map(|row| (0..=row).map(move |column| (row, column))).map(block).collect()
}

fn condensed(n: usize) -> Vec<Vec<f64>> {
    let rows = n.max(2);
    let size = n * rows;
    let mut matrix = vec![vec![0.0; size]; size];
    // The contact points last.
    let number = |i: usize, j: usize| (rows - 1 - j) * n + i;
    for j in 0..rows {
        for i in 0..n {
            let here = number(i, j);
            let half = if j == 0 { 0.5 } else { 1.0 };
            let mut join = |other: Option<usize>, weight: f64| {
                matrix[here][here] += weight;
                if let Some(other) = other {
                    matrix[here][other] -= weight;
                }
            };
            if i > 0 {
                join(Some(number(i - 1, j)), half);
            }
            if i + 1 < n {
                join(Some(number(i + 1, j)), half);
            }
            if j > 0 {
                join(Some(number(i, j - 1)), 1.0);
            }
            join((j + 1 < rows).then(|| number(i, j + 1)), 1.0);
        }
    }
    for pivot in 0..size - n {
        let (done, rest) = matrix.split_at_mut(pivot + 1);
        let eliminated = &done[pivot];
        for row in rest {
            let factor = row[pivot] / eliminated[pivot];
            let entries = row.iter_mut().zip(eliminated).skip(pivot);
            entries.for_each(|(entry, of)| *entry -= factor * of);
        }
    }
    (0..n).map(|i| matrix[size - n + i][size - n..].to_vec()).collect()
}
