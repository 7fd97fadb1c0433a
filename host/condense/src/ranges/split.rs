//! A symmetric matrix as N + P, and the proof that N is an M-matrix.
//!
//! N has the diagonal and the entries ≤ 0, P those > 0. N is a nonsingular M-matrix exactly where a vector w > 0 has
//! Nw > 0. The solution of the contact problem x ≥ 0, Nx ≥ b, xᵀ(Nx − b) = 0 grows with b then, and
//! ```text
//!   x ≥ 0, Nx ≥ b                               lies above it,
//!   x ≥ 0, (Nx)_i ≤ b_i wherever x_i > 0        lies below it.
//! ```
//! So whatever solves the problem nearly is moved along w until it is a bound, rounding included. Where Nx has two ends, as in
//! [`Split::above`], the solution grows with both, and
//! ```text
//!   (Nx)_i ≥ least_i, or greatest_i where x_i < 0       lies above it,
//!   (Nx)_i ≤ greatest_i, or least_i where x_i > 0       lies below it.
//! ```

use faer::linalg::solvers::Solve;
use faer::{Mat, MatRef, Side};

use signorini_reference::ReferenceError;

/// A matrix whose part N is a nonsingular M-matrix.
#[derive(Debug)]
pub struct Split {
    n: usize,
    /// N, row by row.
    pub(super) negative: Vec<f64>,
    /// P, row by row.
    pub(super) positive: Vec<f64>,
    /// w
    direction: Vec<f64>,
    /// At most min (Nw)_i, and above 0.
    slope: f64,
}

impl Split {
    /// Splits `matrix`, n × n row by row; nothing where its part N is not proved to be a nonsingular M-matrix.
    pub fn new(matrix: &[f64], n: usize) -> Option<Self> {
        // The lesser of a NaN and 0 is 0.
        if matrix.iter().any(|entry| entry.is_nan()) {
            return None;
        }
        let is_diagonal = |at: usize| at / n == at % n;
        let entries = || matrix.iter().copied().enumerate();
        let negative = entries().map(|(at, s)| if is_diagonal(at) { s } else { s.min(0.0) });
        let positive = entries().map(|(at, s)| if is_diagonal(at) { 0.0 } else { s.max(0.0) });
        Self::of(negative.collect(), positive.collect(), n)
    }

    /// N and P themselves, n × n row by row, N without positive entries off the diagonal and P without negative ones; nothing
    /// where N is not proved to be a nonsingular M-matrix.
    pub(super) fn of(negative: Vec<f64>, positive: Vec<f64>, n: usize) -> Option<Self> {
        if !negative.iter().chain(&positive).all(|entry| entry.is_finite()) {
            return None;
        }
        let factor = MatRef::from_row_major_slice(&negative, n, n).llt(Side::Lower).ok()?;
        let w = factor.solve(Mat::from_fn(n, 1, |_, _| 1.0));
        let direction: Vec<f64> = (0..n).map(|i| w[(i, 0)]).collect();
        let slope = least(&direction, &negative);
        let is_proved = direction.iter().all(|&w| w > 0.0 && w.is_finite()) && slope > 0.0;
        is_proved.then_some(Self { n, negative, positive, direction, slope })
    }

    /// Whether P = 0: the matrix itself is an M-matrix.
    pub fn has_all_signs(&self) -> bool {
        self.positive.iter().all(|&entry| entry == 0.0)
    }

    /// Px, from below and from above.
    pub fn push(&self, x: &[f64]) -> [Vec<f64>; 2] {
        if self.has_all_signs() {
            return [vec![0.0; self.n], vec![0.0; self.n]];
        }
        let rows = || self.positive.chunks(self.n.max(1)).map(|row| product(row, x));
        let side = |sign: f64| rows().map(|(sum, noise)| sum + sign * noise).collect();
        [side(-1.0), side(1.0)]
    }

    /// The rows of N without the diagonal.
    pub(super) fn off_diagonal(&self) -> impl Iterator<Item = Vec<f64>> {
        let n = self.n.max(1);
        self.negative.chunks(n).enumerate().map(|(i, row)| {
            row.iter().enumerate().map(|(j, &entry)| if i == j { 0.0 } else { entry }).collect()
        })
    }

    /// Upper solution where Nx is `least` with x > 0, `greatest` with x < 0, and between them with x = 0; either may be infinite,
    /// and where `greatest` is, this is the contact problem (N, `least`).
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn above(&self, least: &[f64], greatest: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        self.bounded(least, greatest, 1.0)
    }

    /// Lower solution, as for [`Split::above`]; not negative where `greatest` is infinite.
    ///
    /// # Errors
    /// As for [`Split::above`].
    pub fn below(&self, least: &[f64], greatest: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        self.bounded(least, greatest, -1.0)
    }

    /// At least the solution for a sign of 1, and at most that for −1, entry by entry.
    fn bounded(
        &self,
        least: &[f64],
        greatest: &[f64],
        sign: f64,
    ) -> Result<Vec<f64>, ReferenceError> {
        let x = self.solve(least, greatest)?;
        let [own, other] = if sign > 0.0 { [least, greatest] } else { [greatest, least] };
        let wrong = |at: usize| {
            let (sum, noise) = product(self.row(at), &x);
            let b = if sign * x[at] < 0.0 { other[at] } else { own[at] };
            let off = sign * (b - sum) + noise + 2.0 * f64::EPSILON * b.abs();
            if b.is_infinite() { 0.0 } else { off }
        };
        Ok(self.moved(&x, [least, greatest], wrong, sign))
    }

    fn row(&self, at: usize) -> &[f64] {
        &self.negative[at * self.n..][..self.n]
    }

    fn solve(&self, least: &[f64], greatest: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        let matrix = MatRef::from_row_major_slice(&self.negative, self.n, self.n);
        let ends = || least.iter().zip(greatest);
        let from_above = |(least, _): &(&f64, &f64)| **least == f64::NEG_INFINITY;
        let load: Vec<f64> =
            ends().map(|ends| if from_above(&ends) { *ends.1 } else { *ends.0 }).collect();
        let span = |ends: (&f64, &f64)| match from_above(&ends) {
            true => f64::NEG_INFINITY,
            false => (ends.1 - ends.0).max(0.0),
        };
        let spans: Vec<f64> = ends().map(span).collect();
        signorini_reference::minimise_between(matrix, &[], &load, &spans)
    }

    /// x ± t w, where t is so large that no row is wrong any more, as far as there is that side of 0; the step is rounded away
    /// from x. What overflows bounds nothing: ∞ above, −∞ below.
    fn moved(
        &self,
        x: &[f64],
        [least, greatest]: [&[f64]; 2],
        wrong: impl Fn(usize) -> f64,
        sign: f64,
    ) -> Vec<f64> {
        let within = |at: usize, x: f64| {
            let x = if greatest[at] == f64::INFINITY { x.max(0.0) } else { x };
            if least[at] == f64::NEG_INFINITY { x.min(0.0) } else { x }
        };
        // A NaN among them is not lost, as the larger of it and 0 would be 0.
        let most = (0..x.len()).map(wrong).fold(0.0, |most: f64, wrong| match wrong.is_nan() {
            true => f64::INFINITY,
            false => most.max(wrong),
        });
        let step = most / self.slope * (1.0 + 8.0 * f64::EPSILON);
        if !step.is_finite() {
            return (0..self.n).map(|at| within(at, sign * f64::INFINITY)).collect();
        }
        let moved = |(at, (&x, &w)): (usize, (&f64, &f64))| {
            let rounding = 2.0 * f64::EPSILON * (x.abs() + step * w);
            within(at, x + sign * (step * w + rounding))
        };
        x.iter().zip(&self.direction).enumerate().map(moved).collect()
    }
}

/// min (Nw)_i, from below.
fn least(w: &[f64], matrix: &[f64]) -> f64 {
    let rows = matrix.chunks(w.len().max(1)).map(|row| product(row, w));
    rows.map(|(sum, noise)| sum - noise).fold(f64::INFINITY, f64::min)
}

/// A sum of products, and by how much rounding may have put it off.
pub(super) fn product(row: &[f64], x: &[f64]) -> (f64, f64) {
    let terms = row.iter().zip(x).map(|(a, x)| a * x);
    let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
    (sum, (row.len() as f64 + 2.0) * f64::EPSILON * size)
}
