//! The rate λ at which what is stored decays at least, guaranteed.
//!
//! ```text
//!   ‖A^½∇v‖² + ∫_R h v² ≥ λ ‖c^½v‖²    for all v with v = 0 on D
//! ```
//! With the least eigenvalue λ_h of the Crouzeix–Raviart matrices (K, M) on triangles,
//! ```text
//!   λ = λ_h / (1 + max_T (κ² h² c/α) λ_h),      κ = 0.1893, h the longest side of T
//! ```
//! is a lower bound: the means over edges Iv have ∇Iv ⊥ ∇(v − Iv) in cells of constant A, and ‖v − Iv‖ ≤ κh‖∇(v − Iv)‖
//! (Liu, Applied Mathematics and Computation 267, 2015). Quads are cut in two. Where A varies in a cell its least eigenvalue α stands
//! for it, and h stands for its least value along an edge, whatever inputs are in their ranges. Contact counts as free. λ_h is rounded down: K − μM with a smaller μ
//! has a Cholesky factor.

use std::sync::Arc;

use signorini_kernel::Tensor;
use signorini_kernel::assembly;
use signorini_kernel::mesh::Mesh as KernelMesh;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::stiffness::{Coefficient, Stiffness, fill};

use signorini_certify::cell::Cell;
use signorini_certify::conductivity::Conductivity;
use signorini_problem::Problem;
use signorini_reference::LinearFactor;
use signorini_scene::error::{Error, Result};
use signorini_scene::mesh::adapted::adapted;
use signorini_scene::setting::CellKind;

/// ‖v − Iv‖ ≤ κ h ‖∇(v − Iv)‖ on a triangle.
const KAPPA: f64 = 0.1893;

/// Rounds of inverse iteration: the guess is proved afterwards.
const ROUNDS: u32 = 16;

/// The part of the largest eigenvalue up to which the least one may be 0: what the matrices and the factor round.
const ROUNDED: f64 = 1e-12;

/// Rounds of power iteration, whose result is proved nowhere.
const POWERS: u32 = 100;

/// By which part the guess is lowered for its proof, at first: more than rounding of matrices and factor.
const LOWERED: f64 = 1e-6;

/// λ of `problem`, whose materials store something; 0 where neither D nor R holds some part.
///
/// # Errors
/// A mesh that cannot be cut into triangles; data that are not finite.
pub fn decay_rate(problem: &Problem) -> Result<f64> {
    let pencil = Pencil::on_triangles(problem)?;
    Ok(pencil.rate(pencil.largest()))
}

/// How fast what is stored follows its data, in the scene's unit of time. Contact counts as free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeConstants {
    /// 1/λ: nothing takes longer to fall by a factor of e, guaranteed; infinite where contact alone holds a part.
    pub slowest: f64,
    /// That of the fastest mode on the mesh, estimated.
    pub fastest: f64,
}

/// The time constants of `problem`; nothing where no material stores u.
///
/// # Errors
/// Those of [`decay_rate`].
pub fn time_constants(problem: &Problem) -> Result<Option<TimeConstants>> {
    if problem.capacities.is_empty() {
        return Ok(None);
    }
    let pencil = Pencil::on_triangles(problem)?;
    let largest = pencil.largest();
    let [slowest, fastest] = [pencil.rate(largest), largest].map(f64::recip);
    Ok(Some(TimeConstants { slowest, fastest }))
}

/// K, M and max κ²h²c/α.
struct Pencil {
    /// The columns and entries of K, the diagonal first in every row.
    rows: Vec<Vec<(u32, f64)>>,
    /// Diagonal of M.
    mass: Vec<f64>,
    coarseness: f64,
}

impl Pencil {
    /// Of `problem`, whose quads are cut in two.
    fn on_triangles(problem: &Problem) -> Result<Self> {
        if problem.mesh.quads.is_empty() {
            return Self::of(problem);
        }
        let mesh = adapted((*problem.mesh).clone(), Some(CellKind::Triangles), 0)?;
        Self::of(&Problem::new(&problem.scene, Arc::new(mesh))?)
    }

    /// λ, where the largest eigenvalue is about `largest`.
    fn rate(&self, largest: f64) -> f64 {
        let is_above = |guess: &f64| *guess > ROUNDED * largest;
        let Some(guess) = self.guess().filter(is_above) else { return 0.0 };
        let mut lowered = LOWERED;
        let of_mesh = loop {
            let least = guess * (1.0 - lowered);
            if least <= 0.0 || self.exceeds(least) {
                break least.max(0.0);
            }
            lowered *= 4.0;
        };
        of_mesh / (1.0 + self.coarseness * of_mesh) * (1.0 - LOWERED)
    }

    /// The largest eigenvalue nearly, by power iteration; edges that store nothing stay at 0.
    fn largest(&self) -> f64 {
        let of_stored = |at: usize, x: f64| if self.mass[at] > 0.0 { x } else { 0.0 };
        let count = self.mass.len();
        let mut v: Vec<f64> =
            (0..count).map(|at| of_stored(at, ((at * at) as f64).sin())).collect();
        let mut largest = 0.0;
        for _ in 0..POWERS {
            let product = |row: &[(u32, f64)]| -> f64 {
                row.iter().map(|&(column, entry)| entry * v[column as usize]).sum()
            };
            let rows = self.rows.iter().enumerate();
            let next: Vec<f64> =
                rows.map(|(at, row)| of_stored(at, product(row) / self.mass[at])).collect();
            let weighed = |a: &[f64], b: &[f64]| -> f64 {
                self.mass.iter().zip(a).zip(b).map(|((mass, a), b)| mass * a * b).sum()
            };
            largest = weighed(&v, &next) / weighed(&v, &v);
            let size = weighed(&next, &next).sqrt();
            v = next.into_iter().map(|x| x / size).collect();
        }
        largest
    }

    fn of(problem: &Problem) -> Result<Self> {
        let refused = |error: signorini_kernel::Error| {
            Error::from(problem.scene.error(&problem.scene.mesh, error))
        };
        let mesh = &problem.mesh;
        let edges = problem.topology.edges().map_err(refused)?;
        let unknowns = edges.counts().unknowns();
        let (mut tensors, mut mass, mut coarseness) =
            (Vec::new(), vec![0.0; edges.counts().edges()], 0.0_f64);
        for at in 0..problem.cells() {
            let (tensor, alpha) = tensor_below(problem, at);
            tensors.push(tensor);
            let (cell, share) = (Cell::of(problem, at), problem.capacities[at]);
            let area = 0.5 * cell.local([1.0 / 3.0; 3]).determinant;
            coarseness =
                coarseness.max((KAPPA * cell.diameter()).powi(2) * 3.0 * share / (area * alpha));
            problem.topology.edges_of(at).iter().for_each(|&edge| mass[edge as usize] += share);
        }
        mass.truncate(unknowns);
        let kernel_mesh =
            KernelMesh::new(&mesh.vertices, &mesh.triangles, &mesh.quads).map_err(refused)?;
        let (mut triangles, mut quads) = (vec![[0.0; 3]; mesh.triangles.len()], Vec::new());
        fill(&kernel_mesh, Coefficient::PerCell(&tensors), 1, &mut triangles, &mut quads)
            .map_err(refused)?;
        let mut diagonal = vec![0.0; unknowns];
        for law in &problem.loads.robin {
            let edge = law.edge as usize;
            diagonal[edge] = problem.lengths[edge] * problem.least_transfer(edge);
        }
        let (mut row_ptr, mut col_idx) = (vec![0; unknowns + 1], vec![0; edges.nonzeros()]);
        let mut values = vec![0.0; edges.nonzeros()];
        assembly::pattern(&edges, &mut row_ptr, &mut col_idx).map_err(refused)?;
        let stiffness = Stiffness { triangles: &triangles, quads: &quads };
        let terms = DiagonalTerms::in_step(&diagonal);
        assembly::values(&edges, stiffness, terms, &row_ptr, &mut values).map_err(refused)?;
        // Unknowns alone are columns.
        let is_unknown = |at: &usize| (col_idx[*at] as usize) < unknowns;
        let entries = |row: &[u32]| row[0] as usize..row[1] as usize;
        let of_row = |row| entries(row).filter(is_unknown).map(|at| (col_idx[at], values[at]));
        let rows = row_ptr.windows(2).map(|row| of_row(row).collect()).collect();
        Ok(Self { rows, mass, coarseness })
    }

    /// The factor of K − μM; nothing where that is not proved to be positive definite.
    fn factor(&self, mu: f64) -> Option<LinearFactor> {
        let mut rows = self.rows.clone();
        let diagonal = rows.iter_mut().flat_map(|row| row.first_mut());
        diagonal.zip(&self.mass).for_each(|((_, entry), mass)| *entry -= mu * mass);
        LinearFactor::new(rows).ok()
    }

    /// λ_h nearly, by inverse iteration; nothing where K is singular.
    fn guess(&self) -> Option<f64> {
        let mut v: Vec<f64> =
            (0..self.mass.len()).map(|at| 1.0 + 0.1 * (at as f64).sin()).collect();
        let (factor, mut least) = (self.factor(0.0)?, f64::INFINITY);
        for _ in 0..ROUNDS {
            let load: Vec<f64> = v.iter().zip(&self.mass).map(|(v, mass)| v * mass).collect();
            let next = factor.solve(&load).ok()?;
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            // xᵀKx/xᵀMx with x = K⁻¹Mv.
            let weighed: Vec<f64> = next.iter().zip(&self.mass).map(|(x, mass)| x * mass).collect();
            let size = dot(&next, &weighed);
            least = dot(&next, &load) / size;
            v = next.into_iter().map(|x| x / size.sqrt()).collect();
        }
        least.is_finite().then_some(least)
    }

    /// Whether λ_h > μ.
    fn exceeds(&self, mu: f64) -> bool {
        self.factor(mu).is_some_and(|factor| factor.solve(&vec![1.0; self.mass.len()]).is_ok())
    }
}

/// A of a cell where it is constant, else its least eigenvalue there; and that.
fn tensor_below(problem: &Problem, at: usize) -> (Tensor<f64>, f64) {
    let conductivity = Conductivity::of(problem, at);
    let alpha = conductivity.alpha();
    match &conductivity.floors()[..] {
        [tensor] => (*tensor, alpha),
        _ => (Tensor { xx: alpha, xy: 0.0, yy: alpha }, alpha),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;
    use std::path::Path;

    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_scene::scene::Scene;

    use super::*;

    fn rate(n: u32, cells: Cells, outside: &str) -> f64 {
        let text = format!(
            "mesh = \"grid\"\n[material.default]\nconductivity = 2\ncapacity = 4\n[boundary.contact]\nkind = \"contact\"\n\
             [boundary.dirichlet]\n{outside}\n"
        );
        let scene = Scene::parse(&text, Path::new("decay.toml")).unwrap();
        decay_rate(&Problem::new(&scene, grid(n, cells)).unwrap()).unwrap()
    }

    /// On (−1, 1) × (0, 1) with D on three sides λ = (A/c)(π²/4 + π²/4).
    #[test]
    fn it_is_below_the_exact_rate_and_near_it() {
        let exact = 0.25 * PI * PI;
        for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
            let found = [4, 8, 16].map(|n| rate(n, cells, "kind = \"dirichlet\"\nvalue = 0"));
            assert!(found.iter().all(|&found| found < exact), "{found:?}");
            assert!(
                found[0] > 0.95 * exact && found[2] > 0.996 * exact,
                "{cells:?}: {found:?} {exact}"
            );
        }
    }

    /// An eigenvalue of the whole is at most the largest of one cell, and the largest no less than a diagonal entry of M⁻¹K: 36 and 24
    /// times α/ch² on halves of squares with sides of h.
    #[test]
    fn the_fastest_mode_is_between_what_cells_and_edges_have() {
        let text = "mesh = \"grid\"\n[material.default]\nconductivity = 2\ncapacity = 4\n[boundary.default]\nkind = \"contact\"\n";
        let scene = Scene::parse(text, Path::new("decay.toml")).unwrap();
        for n in [4, 16] {
            let problem = Problem::new(&scene, grid(n, Cells::Triangles)).unwrap();
            let found = time_constants(&problem).unwrap().unwrap();
            let part = found.fastest.recip() / (0.5 * f64::from(n * n));
            assert!(0.9 * 36.0 < part && part <= 36.0 * (1.0 + 1e-9), "{part}");
            assert_eq!(found.slowest, f64::INFINITY);
        }
    }

    /// tan μ = κ/μ on an interval with Robin ends, and nothing where contact alone holds.
    #[test]
    fn transfer_laws_hold_and_contact_does_not() {
        let robin = rate(8, Cells::Triangles, "kind = \"robin\"\ncoefficient = 0.2\nambient = 0");
        // For a small h nearly the mean of h over what is stored: 0.2 · 4/(4 · 2).
        assert!(robin < 0.1 && robin > 0.093, "{robin}");
        assert_eq!(rate(4, Cells::Mixed, "kind = \"neumann\"\nflux = 0"), 0.0);
    }
}
