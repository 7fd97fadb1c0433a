//! The loads of a step by all inputs and openings that have been.
//!
//! With the states written out, y = −Σ_{i≥1} ω^{i−1}(C_x (x_{n+1−i} − x_{n−i}) + C_p (…)), a step in time is
//! ```text
//!   S_k x_n − λ = Σ_{i≥0} B_i p_{n−i} + Σ_{i≥1} H_i x_{n−i},     H_1 = H − C_xᵀC_x,    H_i = C_xᵀ ω^{i−2}(1 − ω) C_x,    ΣH_i = H
//! ```
//! H being the loads of x⁻, and B_i alike with those of p⁻ and C_p. A gap that an input moves is answered at once, and followed by u
//! later. So u counts from the lowest that the gap can be, w = x + Gp − min Gp, in the place of x:
//! ```text
//!   S_k w_n − λ = Σ B′_i p_{n−i} + Σ H_i w_{n−i} − (S_k − H) min Gp,    B′_0 = B_0 + S_k G,    B′_i = B_i − H_i G,    w ≥ Gp − min Gp
//! ```
//! Every lag has its own inputs. What bounds the loads is the sum of positive parts of all lags, and that of negative ones.

use super::enclosure::{Enclosure, EndBox};
use super::lags;
use super::sides::widened;
use super::split::product;
use crate::{Memory, SteppedModel};

/// Part of all terms of a load that the elimination of the mesh may have rounded.
const ELIMINATION: f64 = 1e-12;

/// A stepped model with all of its past, for inputs within their ranges.
pub(super) struct History<'h> {
    of: &'h SteppedModel,
    memory: &'h Memory,
    /// ν = Σ(H_i)⁻, at least.
    pub backward: Vec<f64>,
    /// Σ(H_i)⁺ = H + ν
    pub forward: Vec<f64>,
    /// min Gp
    floor: Vec<f64>,
    /// max Gp − min Gp, 0 where no input moves the gap.
    pub moves: Vec<f64>,
}

impl<'h> History<'h> {
    /// The past that `memory` keeps.
    pub fn new(of: &'h SteppedModel, memory: &'h Memory) -> Self {
        let n = of.model.contact;
        let columns: Vec<Vec<f64>> = (0..n).map(|at| column(&memory.of_contact, at)).collect();
        let mut back = vec![0.0; n * n];
        for row in 0..n {
            for at in 0..=row {
                let pair = [&columns[row][..], &columns[at]];
                let later = later(&memory.fading, pair);
                for (row, at) in [(row, at), (at, row)] {
                    back[row * n + at] = against(of.opening_load(at)[row], pair, later);
                }
            }
        }
        let carried = |(at, back): (usize, &f64)| of.opening_load(at % n)[at / n] + back;
        let forward = back.iter().enumerate().map(carried).collect();
        let mut own =
            Self { of, memory, backward: back, forward, floor: vec![0.0; n], moves: vec![0.0; n] };
        for (gap, [lo, hi]) in of.gaps.iter().zip(own.ranges().into_iter().skip(1)) {
            for (at, gap) in gap.iter().enumerate() {
                let ends = [gap * lo, gap * hi];
                own.floor[at] += ends[0].min(ends[1]);
                own.moves[at] += (ends[1] - ends[0]).abs();
            }
        }
        own
    }

    /// The ranges of the inputs of the scene, the constant first.
    pub fn ranges(&self) -> Vec<[f64; 2]> {
        widened(&self.of.model.ranges[..self.of.inputs])
    }

    /// S_k − Σ(H_i)⁺ less positive entries off the diagonal of S_k, and those with ν.
    pub fn parts(&self) -> [Vec<f64>; 2] {
        let (matrix, n) = (&self.of.model.matrix, self.of.model.contact);
        let push = |at: usize| if at / n == at % n { 0.0 } else { matrix[at].max(0.0) };
        let pull = |at: usize| matrix[at] - push(at) - self.forward[at];
        let all = 0..n * n;
        [all.clone().map(pull).collect(), all.map(|at| push(at) + self.backward[at]).collect()]
    }

    /// w at the start.
    pub fn begin(&self) -> Vec<f64> {
        let (p, rest) = self.of.start().split_at(self.of.inputs - 1);
        let gap =
            |at: usize| -> f64 { self.of.gaps.iter().zip(p).map(|(gap, p)| gap[at] * p).sum() };
        let x = rest[..self.of.model.contact].iter();
        x.enumerate().map(|(at, x)| x + gap(at) - self.floor[at]).collect()
    }

    /// Whether the start leaves nothing but inputs and openings, as a steady one does.
    pub fn is_steady(&self) -> bool {
        self.memory.begin.iter().all(|&y| y == 0.0)
    }

    /// Loads without what comes of w, for all inputs that may ever have been, and all that a start may have left.
    pub fn loads(&self) -> EndBox {
        let Self { of, memory, .. } = self;
        let (model, n, ranges) = (&of.model, of.model.contact, self.ranges());
        let mut sums = vec![[[0.0; 2]; 2]; n];
        let ends: Vec<_> = (0..n).map(|at| model.end_columns(at)).collect();
        let columns: Vec<Vec<f64>> = (0..n).map(|at| column(&memory.of_contact, at)).collect();
        for (j, &[lo, hi]) in ranges.iter().enumerate() {
            let past = j.checked_sub(1).map(|j| self.past(j, &columns));
            for (at, sums) in sums.iter_mut().enumerate() {
                let ([forward, back], of_past) =
                    past.as_ref().map_or_else(Default::default, |past| past[at]);
                let later = [forward * lo - back * hi, forward * hi - back * lo];
                let (now, terms) = self.now(at, j);
                for (sum, end) in sums.iter_mut().zip(&ends[at]) {
                    let end = if end[j].is_finite() { end[j] } else { 0.0 };
                    let ends = [(now + end) * lo, (now + end) * hi];
                    let noise =
                        ELIMINATION * (terms + of_past + end.abs()) * lo.abs().max(hi.abs());
                    sum[0] += ends[0].min(ends[1]) + later[0] - noise;
                    sum[1] += ends[0].max(ends[1]) + later[1] + noise;
                }
            }
        }
        for (at, sums) in sums.iter_mut().enumerate() {
            let [below, above] = self.left(&columns[at]);
            let (base, noise) = self.base(at);
            sums.iter_mut().for_each(|[lo, hi]| {
                *lo += base - noise - below;
                *hi += base + noise + above;
            });
        }
        EndBox::of(&sums, &ends)
    }

    /// By how much loads are off at most in every step, openings being within `of`: each row by the part `rounding` of its terms, and
    /// each state by that of its own, which it keeps the part ω of.
    pub fn rounded(&self, of: &Enclosure, rounding: f64) -> Vec<f64> {
        let Self { of: own, memory, .. } = self;
        let (model, n, m) = (&own.model, own.model.contact, own.inputs);
        let x: Vec<f64> = of.lo.iter().zip(&of.hi).map(|(lo, hi)| hi.max(-lo)).collect();
        let moves: Vec<f64> = of.lo.iter().zip(&of.hi).map(|(lo, hi)| hi - lo).collect();
        let ranges = self.ranges();
        let widths: Vec<f64> = ranges.iter().skip(1).map(|[lo, hi]| hi - lo).collect();
        let states = memory.drift([&moves, &widths]);
        let of_edge = |at: usize| {
            let openings = (0..n)
                .map(|j| (model.matrix[at * n + j].abs() + own.opening_load(j)[at].abs()) * x[j]);
            // The ranges of p, and of p⁻ without the constant.
            let inputs = (0..2 * m - 1).map(|j| {
                let [lo, hi] = ranges[if j < m { j } else { j + 1 - m }];
                model.load[j][at].abs() * hi.max(-lo)
            });
            let column = column(&memory.of_contact, at);
            let of_states: f64 = column.iter().zip(&states).map(|(c, y)| c.abs() * y).sum();
            rounding * (openings.sum::<f64>() + inputs.sum::<f64>() + of_states)
        };
        (0..n).map(of_edge).collect()
    }

    /// −(S_k − H) min Gp, and by how much rounding may have put it off.
    fn base(&self, at: usize) -> (f64, f64) {
        let (model, n) = (&self.of.model, self.of.model.contact);
        let row: Vec<f64> =
            (0..n).map(|j| self.of.opening_load(j)[at] - model.matrix[at * n + j]).collect();
        let (sum, noise) = product(&row, &self.floor);
        let size: f64 = row.iter().zip(&self.floor).map(|(a, b)| (a * b).abs()).sum();
        (sum, noise + ELIMINATION * size)
    }

    /// An entry of B′_0 without ends, and the size of its terms.
    fn now(&self, at: usize, j: usize) -> (f64, f64) {
        let (model, n) = (&self.of.model, self.of.model.contact);
        let own = model.load[j][at];
        let Some(gap) = j.checked_sub(1).map(|j| &self.of.gaps[j]) else { return (own, own.abs()) };
        let terms = || model.matrix[at * n..][..n].iter().zip(gap).map(|(s, gap)| s * gap);
        (own + terms().sum::<f64>(), own.abs() + terms().map(f64::abs).sum::<f64>())
    }

    /// Σ(B′_i)⁺ and Σ(B′_i)⁻ over i ≥ 1 of input j, and the size of their terms, edge by edge.
    fn past(&self, j: usize, columns: &[Vec<f64>]) -> Vec<([f64; 2], f64)> {
        let Self { of, memory, .. } = self;
        let (n, m) = (of.model.contact, of.inputs);
        let gap = &of.gaps[j];
        let of_state = |(row, of_contact): (&Vec<f64>, &Vec<f64>)| {
            row[j] - of_contact.iter().zip(gap).map(|(c, gap)| c * gap).sum::<f64>()
        };
        let changes: Vec<f64> =
            memory.of_inputs.iter().zip(&memory.of_contact).map(of_state).collect();
        let of_edge = |at: usize| {
            let carried = || (0..n).map(|i| of.opening_load(i)[at] * gap[i]);
            let own = of.model.load[m + j][at];
            let total = own - carried().sum::<f64>();
            let pair = [&columns[at][..], &changes];
            let back = backward(total, &memory.fading, pair);
            let terms = own.abs() + carried().map(f64::abs).sum::<f64>() + 2.0 * back;
            ([total + back, back], terms)
        };
        (0..n).map(of_edge).collect()
    }

    /// By how much the load of an edge is below and above what it would be by what the start has left, in any step.
    fn left(&self, column: &[f64]) -> [f64; 2] {
        let (mut sum, mut size, mut ends) = (0.0_f64, 0.0, [0.0_f64; 2]);
        for (c, y) in column.iter().zip(&self.memory.begin) {
            (sum, size) = (sum + c * y, size + (c * y).abs());
            ends = [ends[0].max(-sum), ends[1].max(sum)];
        }
        // The same argument by parts as of lags.
        ends.map(|end| end + ELIMINATION * size)
    }
}

impl SteppedModel {
    /// The load of x⁻ of one edge: a column of H.
    fn opening_load(&self, at: usize) -> &[f64] {
        &self.model.load[2 * self.inputs - 1 + at]
    }
}

/// Σ_i max(−a_i, 0) of lags that add up to `total`, at least: a first one, total − Σ_j a_j b_j, and those of `later`.
pub(crate) fn backward(total: f64, fading: &[f64], pair: [&[f64]; 2]) -> f64 {
    against(total, pair, later(fading, pair))
}

/// A sum of [`backward`] where `later` is the part of it that the other lags have.
fn against(total: f64, [a, b]: [&[f64]; 2], later: f64) -> f64 {
    let (sum, noise) = product(a, b);
    let first = sum - total + noise + 2.0 * f64::EPSILON * total.abs();
    (first.max(0.0) + later).max(-total)
}

/// Σ_i max(−a_i, 0) of the later lags, a_i = Σ_j a_j b_j (1 − ω_j) ω_j^i.
fn later(fading: &[f64], [a, b]: [&[f64]; 2]) -> f64 {
    let weights = a.iter().zip(b).zip(fading).map(|((a, b), omega)| (1.0 - omega) * a * b);
    lags::backward(&weights.collect::<Vec<f64>>(), fading)
}

pub(crate) fn column(rows: &[Vec<f64>], at: usize) -> Vec<f64> {
    rows.iter().map(|row| row[at]).collect()
}
