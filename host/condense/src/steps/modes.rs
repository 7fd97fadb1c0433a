//! How u deviates from its static shape: modes of (K, M) on the free edges that store something, contact being held.
//!
//! With M the masses of a step, a part of K's diagonal like any other, and K_II⁻¹ on these edges,
//! ```text
//!   M^½ K_II⁻¹ M^½ ψ_j = ν_j ψ_j,    φ_j = M^{−½}ψ_j,    ρ_j = ν_j/(1 + ν_j),    κ_j = 1/ν_j = μ_j dt
//! ```
//! A deviation w has the coordinates √κ_j φ_j·Mw, whose squares add up to its energy; a step leaves the part ρ_j of each. Edges that store
//! nothing follow the others.

use faer::{Mat, Side};

use super::super::elimination::{failed, free_block, free_rows};
use signorini_problem::{Assembled, Problem};
use signorini_scene::error::{InputError, Result};
use signorini_solve::unfit;

/// Edges that store something beyond which the modes take too long to find: the work grows like their cube.
const MOST: usize = 3000;

/// ν below this part of the largest is its rounding.
const ROUNDING: f64 = 1e-15;

/// The modes.
pub(super) struct Deviations {
    /// ρ_j
    pub fading: Vec<f64>,
    /// κ_j^½
    roots: Vec<f64>,
    /// ψ_j by columns.
    vectors: Mat<f64>,
    /// The eliminated edges that store something, by their rows, and M^½ there.
    stored: Vec<(usize, f64)>,
    /// The edges of these rows.
    rows: Vec<usize>,
    edges: usize,
}

impl Deviations {
    /// Of a `problem` that is a step, with these contact edges as free as edges inside.
    ///
    /// # Errors
    /// More edges than there is time for; a matrix that is singular to working precision.
    pub fn new(problem: &Problem, open: &[usize]) -> Result<Self> {
        let unfit = unfit::<f64>(&problem.scene);
        let counts = problem.topology.counts;
        let topology = problem.topology.edges().map_err(&unfit)?;
        let mut masses = vec![0.0; counts.unknowns()];
        let step = problem.loads.step.as_ref().map(|step| step.storage(&topology)).transpose();
        let step = step.map_err(&unfit)?;
        step.iter().for_each(|step| step.add_to_diagonal(&topology, &mut masses));
        let rows = free_rows(problem, open);
        let of_rows = rows.iter().map(|&edge| masses[edge]).enumerate();
        let stored: Vec<_> =
            of_rows.filter(|(_, mass)| *mass > 0.0).map(|(at, mass)| (at, mass.sqrt())).collect();
        if stored.len() > MOST {
            let message = format!(
                "{} edges store something, expected at most {MOST} to condense steps in time",
                stored.len()
            );
            let hint = "take the full model (--full, model = \"full\")";
            return Err(InputError::new(message).file(&problem.scene.path).hint(hint).into());
        }
        let (count, free, edges) = (stored.len(), rows.len(), counts.edges());
        let mut own = Self {
            fading: Vec::new(),
            roots: Vec::new(),
            vectors: Mat::new(),
            stored,
            rows,
            edges,
        };
        let units: Vec<f64> =
            (0..count).flat_map(|j| own.weighed(|at| f64::from(u8::from(at == j)))).collect();
        let inverse = own.solved(problem, &units)?;
        let entry = |i: usize, j: usize| own.stored[i].1 * inverse[j * free + own.stored[i].0];
        let matrix = Mat::from_fn(count, count, |i, j| 0.5 * (entry(i, j) + entry(j, i)));
        let failed = |_| {
            InputError::new("the modes of what cells store cannot be found")
                .file(&problem.scene.path)
        };
        let found = matrix.self_adjoint_eigen(Side::Lower).map_err(failed)?;
        let values: Vec<f64> = (0..count).map(|j| found.S()[j]).collect();
        let largest = values.iter().fold(f64::MIN_POSITIVE, |most: f64, nu| most.max(*nu));
        let positive = |nu: &f64| nu.max(ROUNDING * largest);
        own.fading = values.iter().map(positive).map(|nu| nu / (1.0 + nu)).collect();
        own.roots = values.iter().map(positive).map(|nu| nu.recip().sqrt()).collect();
        own.vectors = found.U().to_owned();
        Ok(own)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.stored.len()
    }

    /// Coordinates of a deviation, or of a shape, `u` being means over all edges.
    pub fn coordinates(&self, u: &[f64]) -> Vec<f64> {
        let of_mode = |j: usize| {
            let terms = self.stored.iter().enumerate();
            let of_row = |(at, &(row, root))| self.vectors[(at, j)] * root * u[self.rows[row]];
            let sum: f64 = terms.map(of_row).sum();
            self.roots[j] * sum
        };
        (0..self.count()).map(of_mode).collect()
    }

    /// Means over all edges of the deviations with these coordinates.
    pub fn shapes(&self, problem: &Problem, all: &[Vec<f64>]) -> Result<Vec<Vec<f64>>> {
        let sum = |at: usize, factor: &dyn Fn(usize) -> f64| -> f64 {
            (0..self.count()).map(|j| self.vectors[(at, j)] * factor(j)).sum()
        };
        // K w = M^½ Σ ψ_j κ_j^½ y_j is for edges that store nothing: the others are known without its rounding.
        let right = all.iter().flat_map(|y| self.weighed(|at| sum(at, &|j| self.roots[j] * y[j])));
        let free = self.rows.len();
        let has_all = self.stored.len() == free;
        let solved =
            if has_all { Vec::new() } else { self.solved(problem, &right.collect::<Vec<_>>())? };
        let shape = |(number, y): (usize, &Vec<f64>)| {
            let mut u = vec![0.0; self.edges];
            let solved = solved.iter().skip(number * free);
            self.rows.iter().zip(solved).for_each(|(&edge, &solved)| u[edge] = solved);
            for (at, &(row, root)) in self.stored.iter().enumerate() {
                u[self.rows[row]] = sum(at, &|j| y[j] / self.roots[j]) / root;
            }
            u
        };
        Ok(all.iter().enumerate().map(shape).collect())
    }

    /// M^½ times what `of` gives of the edges that store something: a column over all that are eliminated.
    fn weighed(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut column = vec![0.0; self.rows.len()];
        self.stored.iter().enumerate().for_each(|(at, &(row, root))| column[row] = root * of(at));
        column
    }

    /// K_II⁻¹ applied to columns, K without masses.
    fn solved(&self, problem: &Problem, right: &[f64]) -> Result<Vec<f64>> {
        let mut steady = problem.clone();
        steady.loads.step = None;
        let assembled = Assembled::<f64>::new(&steady).map_err(unfit::<f64>(&problem.scene))?;
        free_block(&assembled, &self.rows, right).map_err(failed(&problem.scene))
    }
}
