//! A row of K in f32, with as many entries as the widest one has.

use crate::Problem;

/// The part of the diagonal entry below which an entry takes nothing of what others are rounded by.
const LARGE: f64 = 0.01;

/// Entries beside the diagonal, those that a row has fewer being 0 times itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row<const WIDTH: usize> {
    columns: [u32; WIDTH],
    values: [f32; WIDTH],
}

impl<const WIDTH: usize> Row<WIDTH> {
    /// The rows of K/`unit` with the unknown `order[i]` at place i; its diagonal entry is taken for `diagonal[i]`.
    pub fn all(problem: &Problem, order: &[u32], unit: f64, diagonal: &[f64]) -> Vec<Self> {
        let mut place = vec![0; order.len()];
        order.iter().zip(0..).for_each(|(&unknown, at)| place[unknown as usize] = at);
        let mut lost = 0.0;
        let row = |(at, &diagonal): (usize, &f64)| {
            let entries = problem.contact.row(order[at] as usize);
            let entries = entries.map(|(column, value)| (place[column], value / unit));
            let row;
            (row, lost) = Self::of(at as u32, entries, diagonal, lost);
            row
        };
        diagonal.iter().enumerate().map(row).collect()
    }

    /// Row `at`, and what rounding takes from the sum of its entries.
    ///
    /// An entry takes what the others are rounded by, and `lost`, the same of the row before. So K times a constant is what it is in
    /// f64, over any piece of the mesh: cells of one shape are rounded alike, and a part that hardly anything holds would be held by
    /// what they are rounded by. It is the least entry that hardly changes by it: K stays symmetric to six digits.
    fn of(
        at: u32,
        entries: impl Iterator<Item = (u32, f64)>,
        diagonal: f64,
        lost: f64,
    ) -> (Self, f64) {
        let mut row = Self { columns: [at; WIDTH], values: [0.0; WIDTH] };
        let is_rounding = lost.abs() <= f64::from(f32::EPSILON) * diagonal;
        let (mut count, mut lost) = (0, if is_rounding { lost - diagonal } else { -diagonal });
        for (column, value) in entries {
            lost += value;
            if column != at && count < WIDTH {
                (row.columns[count], row.values[count]) = (column, value as f32);
                lost -= f64::from(row.values[count]);
                count += 1;
            }
        }
        let entries = row.values[..count].iter_mut();
        let large = entries.filter(|entry| f64::from(entry.abs()) >= LARGE * diagonal);
        let least = large.min_by(|a, b| a.abs().total_cmp(&b.abs()));
        if let Some(least) = least {
            let before = std::mem::replace(least, *least + lost as f32);
            lost -= f64::from(*least) - f64::from(before);
        }
        (row, lost)
    }

    /// The entry of a column.
    pub fn entry(&self, column: usize) -> f64 {
        let entries = self.columns.iter().zip(&self.values);
        let of_column = entries.filter(|entry| *entry.0 as usize == column);
        of_column.map(|(_, &value)| f64::from(value)).sum()
    }

    /// The entries times those of z.
    #[inline(always)]
    pub fn times(&self, z: &[f32]) -> f32 {
        let mut sum = 0.0;
        for k in 0..WIDTH {
            sum += self.values[k] * z[self.columns[k] as usize];
        }
        sum
    }

    /// Adds the entries times `factor` to those of their columns.
    #[inline(always)]
    pub fn scatter(&self, factor: f32, sums: &mut [f32]) {
        for k in 0..WIDTH {
            sums[self.columns[k] as usize] += self.values[k] * factor;
        }
    }
}
