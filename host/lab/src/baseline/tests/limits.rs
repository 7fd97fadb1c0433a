//! Clarabel on problems whose fluxes have limits: it agrees with the kernel.
//!
//! ```text
//!   minimise ½ uᵀKu − bᵀu + Σ |m_i| s_i   over s_i ≥ 0,     m_i > 0:  u_i + s_i ≥ ψ_i     m_i < 0:  u_i − s_i ≤ ψ_i
//! ```
//! Its multipliers are w = Ku − b between 0 and m_i. Without a finite m_i there is no s_i, and u_i ≥ ψ_i or u_i ≤ ψ_i.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSolver, IPSolver, SupportedConeT};
use std::path::PathBuf;

use signorini_scene::error::Result;
use signorini_scene::mesh::gmsh;
use signorini_scene::scene::Scene;
use signorini_solve::problem::{Assembled, Parts, Problem};
use signorini_solve::solve::{Options, Reduced, SolverKind, solve};
use signorini_tolerances::lab::CLARABEL_LIMITED;

use super::super::clarabel::settings;
use super::super::quadratic::Matrix;

/// Rows A z ≤ b.
#[derive(Default)]
struct Rows {
    entries: [Vec<usize>; 2],
    values: Vec<f64>,
    most: Vec<f64>,
}

impl Rows {
    fn push(&mut self, row: &[(usize, f64)], most: f64) {
        for &(column, value) in row {
            self.entries[0].push(self.most.len());
            self.entries[1].push(column);
            self.values.push(value);
        }
        self.most.push(most);
    }
}

/// u of the unknowns, by Clarabel; `lower` and `spans` are those of the last of them.
fn by_clarabel(matrix: &Matrix, load: &[f64], lower: &[f64], spans: &[f64]) -> Vec<f64> {
    let (n, free) = (load.len(), load.len() - lower.len());
    let (mut rows, mut costs) = (Rows::default(), Vec::new());
    for (at, (&gap, &span)) in lower.iter().zip(spans).enumerate().filter(|(_, (_, m))| **m != 0.0)
    {
        let sign = -span.signum();
        let mut row = vec![(free + at, sign)];
        if span.is_finite() {
            let slack = n + costs.len();
            costs.push(span.abs());
            row.push((slack, -1.0));
            rows.push(&[(slack, -1.0)], 0.0);
        }
        rows.push(&row, sign * gap);
    }
    let all = n + costs.len();
    let (mut starts, of_rows, values) = matrix.upper();
    starts.resize(all + 1, values.len());
    let q: Vec<f64> = load.iter().map(|b| -b).chain(costs).collect();
    let [of, columns] = rows.entries;
    let (count, settings) = (rows.most.len(), settings(1e-12));
    let constraints = CscMatrix::new_from_triplets(count, all, of, columns, rows.values);
    let matrix = CscMatrix::new(all, all, starts, of_rows, values);
    let cones = [SupportedConeT::NonnegativeConeT(count)];
    let mut solver = DefaultSolver::new(&matrix, &q, &constraints, &rows.most, &cones, settings)
        .expect("a cone");
    solver.solve();
    solver.solution.x[..n].to_vec()
}

#[test]
fn clarabel_agrees_where_fluxes_have_limits() -> Result<()> {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../meshes"));
    for name in ["limits/l-tri", "limits/l-quad", "scenes/antiicing"] {
        let scene = Scene::read(&root.join(format!("{name}.toml")))?;
        let problem = Problem::new(&scene, gmsh::read(&scene.mesh.value)?)?;
        let parts = Parts::examine(&problem)?;
        let assembled = Assembled::<f64>::new(&problem).expect("arrays that fit");
        let reduced =
            Reduced::new(&problem, &parts, &assembled, &assembled.start()).expect("spans");
        let Reduced { row_ptr, col_idx, values, load, .. } = reduced;
        let (matrix, law) = (Matrix { row_ptr, col_idx, values }, assembled.law());
        let (lower, spans) = (law.lower(), law.spans().lengths());
        let found = by_clarabel(&matrix, &load, lower, spans);
        let solution =
            solve(&problem, &Options { solver: SolverKind::Kernel, ..Options::default() })?;
        let u = &solution.u[..load.len()];
        let states: Vec<_> = u[load.len() - lower.len()..].iter().zip(lower).collect();
        assert!(
            states.iter().any(|(u, gap)| u < gap) && states.iter().any(|(u, gap)| u > gap),
            "{name}"
        );
        let size = u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        for (at, (found, u)) in found.iter().zip(u).enumerate() {
            CLARABEL_LIMITED.check(format_args!("{name} {at}"), (found - u) / size);
        }
    }
    Ok(())
}
