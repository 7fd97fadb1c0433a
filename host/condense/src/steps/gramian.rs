//! The states: the directions in which inputs and openings leave most behind.
//!
//! With b the coordinates of what a unit of each makes in a step, ρ_j √κ_j φ_j·M(Θ, Ψ), times how much each may change, all that may have been
//! left adds up to
//! ```text
//!   P_ij = b_i·b_j / (1 − ρ_i ρ_j)
//! ```
//! whose r dominant directions W are turned so that W′ρW = diag(ω). The outputs of what is left are loads of the openings, so that P is above
//! both Gramians.

use faer::linalg::solvers::SelfAdjointEigen;
use faer::{Mat, Side};

use super::modes::Deviations;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// Part of the largest square below which P is rounding.
const ROUNDING: f64 = 1e-15;

type Eigen = SelfAdjointEigen<f64>;

/// The states that are kept.
pub(super) struct Subspace {
    /// ω
    pub fading: Vec<f64>,
    /// W by columns; nothing where every mode is a state.
    directions: Option<Vec<Vec<f64>>>,
}

/// P of what inputs and openings leave, each of which may change by its size, and a start at once: LLᵀ with the eigenvectors of LᵀL.
pub(super) struct Gramian<'d> {
    /// ρ
    fading: &'d [f64],
    /// L by columns.
    root: Vec<Vec<f64>>,
    /// Eigenvalues of LᵀL, the largest last, and its eigenvectors; nothing where they cannot be found.
    found: Option<(Vec<f64>, Mat<f64>)>,
}

impl<'d> Gramian<'d> {
    /// Of columns by their coordinates.
    pub fn new(fading: &'d [f64], (columns, sizes): (&[Vec<f64>], &[f64]), start: &[f64]) -> Self {
        let of_column = |(of, size): (&Vec<f64>, &f64)| -> Vec<f64> {
            of.iter().zip(fading).map(|(b, rho)| size * rho * b).collect()
        };
        let mut left: Vec<Vec<f64>> = columns.iter().zip(sizes).map(of_column).collect();
        left.push(start.to_vec());
        let entry = |i: usize, j: usize| -> f64 {
            left.iter().map(|b| b[i] * b[j]).sum::<f64>() / (1.0 - fading[i] * fading[j])
        };
        let root = factored(fading.len(), entry);
        let rank = root.len();
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let squares = Mat::from_fn(rank, rank, |i, j| product(&root[i], &root[j]));
        let found = squares.self_adjoint_eigen(Side::Lower).ok();
        let values = |at: &Eigen| (0..rank).map(|k| at.S()[k]).collect();
        Self { fading, found: found.map(|of| (values(&of), of.U().to_owned())), root }
    }

    /// The `memory` dominant directions.
    pub fn dominant(&self, memory: usize) -> Subspace {
        let Some((values, vectors)) = &self.found else { return Subspace::nothing() };
        let (rho, rank) = (self.fading, values.len());
        let kept = (rank.saturating_sub(memory)..rank).filter(|&at| values[at] > 0.0);
        let of_root =
            |at: usize| self.combined(|i| vectors[(i, at)] / values[at].sqrt(), &self.root);
        let mut directions: Vec<Vec<f64>> = kept.map(of_root).collect();
        orthonormal(&mut directions);
        let r = directions.len();
        let faded = |i: usize, j: usize| -> f64 {
            (0..rho.len()).map(|at| directions[i][at] * rho[at] * directions[j][at]).sum()
        };
        let matrix = Mat::from_fn(r, r, |i, j| if i < j { faded(j, i) } else { faded(i, j) });
        let Ok(found) = matrix.self_adjoint_eigen(Side::Lower) else { return Subspace::nothing() };
        let turned = (0..r).map(|at| self.combined(|i| found.U()[(i, at)], &directions)).collect();
        Subspace { fading: (0..r).map(|at| found.S()[at]).collect(), directions: Some(turned) }
    }

    /// A sum of columns with these weights.
    fn combined(&self, weights: impl Fn(usize) -> f64, of: &[Vec<f64>]) -> Vec<f64> {
        let mut sum = vec![0.0; self.fading.len()];
        for (at, column) in of.iter().enumerate() {
            sum.iter_mut().zip(column).for_each(|(sum, entry)| *sum += weights(at) * entry);
        }
        sum
    }
}

/// Columns of L with LLᵀ = P to rounding, by pivots.
fn factored(count: usize, entry: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    let mut rest: Vec<f64> = (0..count).map(|at| entry(at, at)).collect();
    let largest = rest.iter().fold(0.0, |most: f64, x| most.max(*x));
    let mut columns: Vec<Vec<f64>> = Vec::new();
    while columns.len() < count {
        let at = (0..count).max_by(|&a, &b| rest[a].total_cmp(&rest[b])).unwrap_or_default();
        if rest[at].is_nan() || rest[at] <= ROUNDING * largest {
            break;
        }
        let root = rest[at].sqrt();
        let known = |i: usize| columns.iter().map(|column| column[i] * column[at]).sum::<f64>();
        let column: Vec<f64> = (0..count).map(|i| (entry(i, at) - known(i)) / root).collect();
        rest.iter_mut().zip(&column).for_each(|(rest, x)| *rest -= x * x);
        rest[at] = 0.0;
        columns.push(column);
    }
    columns
}

/// Gram and Schmidt, twice; the largest come last.
fn orthonormal(vectors: &mut [Vec<f64>]) {
    for at in (0..vectors.len()).rev() {
        let (own, known) = vectors.split_at_mut(at + 1);
        let own = &mut own[at];
        for known in known.iter().chain(&*known) {
            let part: f64 = own.iter().zip(known).map(|(a, b)| a * b).sum();
            own.iter_mut().zip(known).for_each(|(a, b)| *a -= part * b);
        }
        let size = own.iter().map(|a| a * a).sum::<f64>().sqrt();
        own.iter_mut().for_each(|a| *a /= size);
    }
}

impl Subspace {
    fn nothing() -> Self {
        Self { fading: Vec::new(), directions: Some(Vec::new()) }
    }

    /// Every mode as a state.
    pub fn all(deviations: &Deviations) -> Self {
        Self { fading: deviations.fading.clone(), directions: None }
    }

    /// W′z
    pub fn inner(&self, z: &[f64]) -> Vec<f64> {
        let Some(directions) = &self.directions else { return z.to_vec() };
        directions.iter().map(|w| w.iter().zip(z).map(|(w, z)| w * z).sum()).collect()
    }

    /// Wy over so many modes.
    pub fn outer(&self, y: &[f64], count: usize) -> Vec<f64> {
        let Some(directions) = &self.directions else { return y.to_vec() };
        let mut z = vec![0.0; count];
        for (y, w) in y.iter().zip(directions) {
            z.iter_mut().zip(w).for_each(|(z, w)| *z += y * w);
        }
        z
    }

    /// Rows of W′ρ√κ φ·M over columns with these coordinates: what a change of each takes from every state.
    pub fn changes(&self, rho: &[f64], columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let of_column = |left: &Vec<f64>| {
            let left: Vec<f64> = left.iter().zip(rho).map(|(b, rho)| rho * b).collect();
            self.inner(&left)
        };
        let all: Vec<Vec<f64>> = columns.iter().map(of_column).collect();
        (0..self.fading.len()).map(|state| all.iter().map(|of| of[state]).collect()).collect()
    }

    /// Means over all edges of a unit of every state.
    pub fn shapes(&self, deviations: &Deviations, problem: &Problem) -> Result<Vec<Vec<f64>>> {
        let count = deviations.count();
        let unit = |j: usize| (0..count).map(|at| f64::from(u8::from(at == j))).collect();
        let units = || (0..count).map(unit).collect();
        deviations.shapes(problem, &self.directions.clone().unwrap_or_else(units))
    }
}
