//! bound² = identity² for functions written by hand: the norms are right and the extensions fit.
//!
//! S is the exact u at the vertices and τ the exact fluxes, both then moved at random as far as the
//! identity allows: S off D, quads' bubbles, τ by a field without divergence that leaves N alone.

use signorini_kernel::mesh::geometry::scaled_normal;
use signorini_tolerances::solve::{IDENTITY, IDENTITY_SINGULAR};

use super::CertifiedFields;
use super::admissible::Following;
use super::cell::Cell;
use super::conductivity::{Conductivity, apply, dot, inverse, product};
use super::curved;
use super::deviation::Deviations;
use super::exact::distance;
use super::lifted::Lifts;
use signorini_problem::field::CellField;
use signorini_problem::fixtures::{self, SMOOTH};
use signorini_problem::pointwise::exact_at;
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_problem::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::{Condition, Field, Scene};

/// CertifiedFields in (−1, 1) without a pattern.
fn scatter(at: usize) -> f64 {
    (at as f64 * 12.9898 + 0.3).sin()
}

/// u at the vertices and the exact fluxes, moved by `amount`.
fn by_hand(problem: &Problem, amount: f64) -> Result<CertifiedFields> {
    let exact = problem.scene.exact.as_ref().expect("an exact solution");
    let mesh = &problem.mesh;
    let mut fixed = vec![[false; 2]; mesh.vertices.len()];
    for (ends, kind) in problem.ends.iter().zip(&*problem.kinds) {
        for &vertex in ends {
            fixed[vertex as usize][0] |= *kind == EdgeKind::Dirichlet;
            fixed[vertex as usize][1] |= *kind == EdgeKind::Neumann;
        }
    }
    let mut vertices = Vec::new();
    for (at, &x) in mesh.vertices.iter().enumerate() {
        let moved = if fixed[at][0] { 0.0 } else { amount * scatter(at) };
        vertices.push(exact_at(&problem.scene, exact, x, 0.0)?.0 + moved);
    }
    // φ(b) − φ(a) on each edge from a to b is a field without divergence; φ = 0 at the ends of N.
    let stream = |vertex: u32| {
        let at = vertex as usize;
        if fixed[at][1] { 0.0 } else { amount * scatter(at + 1000) }
    };
    let mut tau = Vec::new();
    for (edge, ends) in problem.ends.iter().enumerate() {
        tau.push(exact_flux(problem, edge)? + stream(ends[1]) - stream(ends[0]));
    }
    let bubbles = (0..problem.ends.len()).map(|edge| bubble(problem, edge, amount)).collect();
    Ok(CertifiedFields {
        vertices,
        bubbles,
        tau,
        following: Following::WhereNeeded,
        indicators: Vec::new(),
        openings: Vec::new(),
        evolution: Vec::new(),
        lifts: Lifts::default(),
    })
}

fn bubble(problem: &Problem, edge: usize, amount: f64) -> f64 {
    let triangles = 3 * problem.mesh.triangles.len();
    let in_quads = problem.topology.half_edges[edge].iter().all(|&half| half as usize >= triangles);
    let fixed = problem.kinds[edge] == EdgeKind::Dirichlet;
    if in_quads && !fixed { amount * scatter(edge + 2000) } else { 0.0 }
}

/// ∫σ·n over an edge in its direction.
fn exact_flux(problem: &Problem, edge: usize) -> Result<f64> {
    let exact = problem.scene.exact.as_ref().expect("an exact solution");
    let [a, b] = problem.segment(edge);
    let normal: [f64; 2] = scaled_normal(a, b).into();
    let (cell, _) = problem.topology.first_side(edge);
    let conductivity = Conductivity::of(problem, cell);
    on_panels(8, &gauss(8)).into_iter().try_fold(0.0, |sum, [t, weight]| {
        let x = problem.along(edge, t);
        let (_, gradient) = exact_at(&problem.scene, exact, x, 0.0)?;
        Ok(sum + weight * dot(apply(&conductivity.at(x), gradient), normal))
    })
}

/// ‖A^½∇S − A^{−½}τ‖² + 2∫_C (τ·n − q̄)(S − ψ) + ∫_R (τ·n + h(S − u_ext))²/h, by quadrature.
fn bound_squared(problem: &Problem, numbers: &CertifiedFields) -> Result<f64> {
    let admissible = numbers.admissible();
    let deviations = curved::followed(problem, &admissible)?;
    let mut bound = 0.0;
    for at in 0..problem.mesh.triangles.len() + problem.mesh.quads.len() {
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let s = admissible.on_cell(problem, at, &deviations);
        let tau = CellField::new(problem, at, &numbers.tau, &numbers.tau);
        for point in cell.points(&gauss(16)) {
            let gradient = s.at(&cell.local(point.reference))?.gradient;
            let (a, tau) = (conductivity.at(point.x), tau.flux(&point));
            bound += point.weight
                * (product(&a, gradient, gradient) - 2.0 * dot(gradient, tau)
                    + product(&inverse(&a), tau, tau));
        }
    }
    for edge in 0..problem.ends.len() {
        bound += edge_term(problem, edge, numbers, &deviations)?;
    }
    Ok(bound)
}

fn edge_term(
    problem: &Problem,
    edge: usize,
    numbers: &CertifiedFields,
    deviations: &Deviations,
) -> Result<f64> {
    let (EdgeKind::Contact | EdgeKind::Robin) = problem.kinds[edge] else { return Ok(0.0) };
    let at = problem.binding.boundary(problem.ends[edge]).expect("a boundary edge");
    let length = problem.lengths[edge];
    let tau = numbers.tau[edge] / length;
    on_panels(8, &gauss(8)).into_iter().try_fold(0.0, |sum, [t, weight]| {
        let [x, y] = problem.along(edge, t);
        let s = numbers.admissible().on_edge(problem, edge, deviations.on(edge), t)?;
        let value = match &problem.scene.boundaries[at].condition {
            Condition::Contact { gap, flux, .. } => {
                let mean = Sum::alone(&problem.scene, flux, 0.0).mean(problem.segment(edge))?;
                2.0 * (tau - mean) * (s - gap.value.eval(x, y, 0.0))
            }
            Condition::Robin { coefficient, ambient, .. } => {
                let h = coefficient.value.eval(x, y, 0.0);
                (tau + h * (s - ambient.value.eval(x, y, 0.0))).powi(2) / h
            }
            _ => 0.0,
        };
        Ok(sum + weight * length * value)
    })
}

/// |bound²/identity² − 1|
fn gap(problem: &Problem, amount: f64) -> Result<f64> {
    let numbers = by_hand(problem, amount)?;
    let exact = problem.scene.exact.as_ref().expect("an exact solution");
    let found = distance(exact, problem, &numbers.admissible())?;
    let bound = bound_squared(problem, &numbers)?;
    assert!(found.combined > 0.0 && bound > 0.0);
    let gap = (bound / found.identity.powi(2) - 1.0).abs();
    println!("combined {:e} identity {:e} gap {gap:e}", found.combined, found.identity);
    Ok(gap)
}

fn meshes() -> [(&'static str, Mesh); 5] {
    [
        ("triangles", grid(6, Cells::Triangles)),
        ("quads", grid(6, Cells::Quads)),
        ("mixed", grid(6, Cells::Mixed)),
        ("distorted quads", fixtures::distorted(grid(6, Cells::Quads))),
        ("distorted mixed", fixtures::distorted(grid(6, Cells::Mixed))),
    ]
}

#[test]
fn every_term_for_a_smooth_solution() -> Result<()> {
    let open = SMOOTH
        .replace("gap = \"x^3\"", "gap = \"x^3 - 0.3 - 0.2*sin(3*x)^2\"")
        .replace("flux = \"-3.5*x^2 - 1\"", "flux = \"-2.5*x^2\"");
    assert_ne!(open, SMOOTH);
    for text in [SMOOTH, &open] {
        for (name, mesh) in meshes() {
            let (_, problem) = fixtures::on_grid(text, mesh)?;
            for amount in [0.0, 0.05, 1.0] {
                let gap = gap(&problem, amount)?;
                IDENTITY.check(format_args!("{name}, moved by {amount}: {gap:e}"), gap);
            }
        }
    }
    Ok(())
}

#[test]
fn singular_solutions_and_a_curved_gap() -> Result<()> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/catalogue");
    for file in ["a-tri", "h-tri", "hg-tri"] {
        let scene = Scene::read(&folder.join(format!("{file}.toml")))?;
        for (name, mesh) in meshes() {
            let problem = Problem::new(&scene, mesh)?;
            for amount in [0.0, 0.05] {
                let gap = gap(&problem, amount)?;
                IDENTITY_SINGULAR
                    .check(format_args!("{file}, {name}, moved by {amount}: {gap:e}"), gap);
            }
        }
    }
    Ok(())
}

#[test]
fn the_fields_of_a_boundary_are_its_own() -> Result<()> {
    let (_, problem) = fixtures::on_grid(SMOOTH, grid(2, Cells::Quads))?;
    let has = |edge: usize, field| Sum::on_edge(&problem, edge, field).is_some();
    for edge in 0..problem.ends.len() {
        let found = [Field::Value, Field::Flux, Field::Ambient, Field::Gap].map(|f| has(edge, f));
        let expected = match problem.kinds[edge] {
            EdgeKind::Dirichlet => [true, false, false, false],
            EdgeKind::Neumann => [false, true, false, false],
            EdgeKind::Robin => [false, false, true, false],
            EdgeKind::Contact => [false, true, false, true],
            EdgeKind::Interior => continue,
        };
        assert_eq!(found, expected);
    }
    Ok(())
}
