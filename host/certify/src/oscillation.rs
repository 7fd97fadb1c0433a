//! Data oscillation: what the bound's τ cannot see, since it meets f, g and q in their means only.
//!
//! With τ such that ∇·τ + f̄ = 0 and τ·n = ḡ, the bound misses ∫(s − u)(f − f̄) and ∫_N (s − u)(g − ḡ).
//! f − f̄ and g − ḡ have no mean, so that Poincaré's inequality on a convex cell and its trace version
//! on the triangle K of an edge and the opposite vertex (the middle of a quad) bound them by the
//! energy of s − u:
//! ```text
//!   osc_T  = (h_T/π) ‖f − f̄‖_T / √α_T
//!   osc_E² = (|E| h_K²/|K|)(1/π² + 1/π) ‖g − ḡ‖²_E / α_T
//! ```
//! with the diameters h and the smallest eigenvalue α_T of A on T. q counts like g; of u_ext what 8 points do not see
//! ([`super::robin`]).

use std::f64::consts::PI;

use signorini_kernel::mesh::geometry::triangle_area;

use super::cell::Cell;
use super::conductivity::{Conductivity, smallest_eigenvalue};
use super::robin::missed;
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_problem::threads::in_portions;
use signorini_problem::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::mesh::shape::edge_length;
use signorini_scene::scene::Field;

/// Gauss points a direction on a cell, and a panel on an edge.
const POINTS: usize = 16;
/// Panels on an edge.
const PANELS: u32 = 4;

/// osc_T + Σ osc_E over the sides of each cell (triangles first) at time `time`, in the unit of
/// ‖A^½∇u‖. The oscillation of the whole is the root of the sum of the squares.
///
/// # Errors
/// Data that are not finite.
pub fn oscillation(problem: &Problem, time: f64) -> Result<Vec<f64>> {
    let mut cells = vec![0.0; problem.mesh.triangles.len() + problem.mesh.quads.len()];
    let source = Sum::source(&problem.scene, time);
    if !source.is_zero() {
        let of_source = |cells: std::ops::Range<usize>| -> Result<Vec<f64>> {
            cells.map(|at| of_source(problem, at, &source)).collect()
        };
        cells = in_portions(cells.len(), of_source)?.concat();
    }
    for edge in 0..problem.kinds.len() {
        let (at, _) = problem.topology.first_side(edge);
        cells[at] += match problem.kinds[edge] {
            EdgeKind::Neumann | EdgeKind::Contact => of_flux(problem, edge, time)?,
            EdgeKind::Robin => missed(problem, edge, time)?,
            EdgeKind::Interior | EdgeKind::Dirichlet => 0.0,
        };
    }
    Ok(cells)
}

/// osc_T
fn of_source(problem: &Problem, at: usize, f: &Sum) -> Result<f64> {
    let cell = Cell::of(problem, at);
    if let (Some(f), true) = (f.constant(), cell.is_affine()) {
        return Ok(of_bend(&cell, f) / alpha(problem, at).sqrt());
    }
    let load = f.over(cell)?;
    // Squares of f may vanish or overflow where lengths are huge or tiny; those of f times a length do not.
    let unit = cell.diameter().log2().round().exp2();
    let (mut square, points) = (0.0, cell.points(&gauss(POINTS)));
    let values = f.at_all(&points.iter().map(|point| point.x).collect::<Vec<_>>());
    for (point, value) in points.iter().zip(values) {
        let mean = cell.spread(load, cell.local(point.reference).determinant);
        let difference = unit * (value - mean);
        square += point.weight / unit / unit * difference.powi(2);
    }
    let square = f.finite(square, cell.corners()[0])?;
    Ok(cell.diameter() / PI * (square / alpha(problem, at)).sqrt())
}

/// osc_T √α of a constant f on a quad that only rounding distortions: det DF leaves its mean |T| by at most 2 h_T times the
/// distortion, and f − f̄ is f times that over |T|.
fn of_bend(cell: &Cell, f: f64) -> f64 {
    let distortion = cell.distortion();
    if distortion == 0.0 || f == 0.0 {
        return 0.0;
    }
    let area: f64 = cell.points(&gauss(1)).iter().map(|point| point.weight).sum();
    let diameter = cell.diameter();
    let difference = f.abs() * (2.0 * diameter / area.sqrt()) * (distortion / area.sqrt());
    diameter / PI * difference * area.sqrt()
}

/// osc_E; g and q are both the `flux` of their boundary. Where hi − lo varies too, either may be what is moved to its mean.
fn of_flux(problem: &Problem, edge: usize, time: f64) -> Result<f64> {
    let least = of_end(problem, edge, Field::Flux, time)?;
    Ok(least.max(of_end(problem, edge, Field::Limit, time)?))
}

fn of_end(problem: &Problem, edge: usize, field: Field, time: f64) -> Result<f64> {
    let Some(g) = Sum::on_edge(problem, edge, field, time) else { return Ok(0.0) };
    if g.constant().is_some() {
        return Ok(0.0);
    }
    let segment @ [a, b] = problem.segment(edge);
    let (length, mean) = (problem.lengths[edge], g.mean(segment)?);
    let difference = |t: f64| g.at(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) - mean;
    let rule = on_panels(PANELS, &gauss(POINTS));
    let square: f64 = rule.iter().map(|[t, weight]| weight * difference(*t).powi(2)).sum();
    let square = length * g.finite(square, a)?;
    let (at, side) = problem.topology.first_side(edge);
    let apex = opposite(&Cell::of(problem, at), side);
    let diameter = length.max(edge_length([a, apex])).max(edge_length([b, apex]));
    let shape = length * diameter * diameter / triangle_area([a, b, apex]);
    let trace = 1.0 / (PI * PI) + 1.0 / PI;
    Ok((shape * trace * square / alpha(problem, at)).sqrt())
}

/// The vertex opposite of a triangle's side, the middle of a quad.
fn opposite(cell: &Cell, side: usize) -> [f64; 2] {
    match cell {
        Cell::Triangle(corners) => corners[(side + 2) % 3],
        Cell::Quad([a, b, c, d]) => [0, 1].map(|k| 0.25 * (a[k] + b[k] + c[k] + d[k])),
    }
}

/// The smallest eigenvalue of A on a cell; where A varies, of A at the quadrature points.
pub fn alpha(problem: &Problem, at: usize) -> f64 {
    let (cell, a) = (Cell::of(problem, at), Conductivity::of(problem, at));
    if a.is_constant() {
        return smallest_eigenvalue(&a.at(cell.corners()[0]));
    }
    let points = cell.points(&gauss(POINTS)).into_iter();
    points.map(|point| smallest_eigenvalue(&a.at(point.x))).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{self, PARABOLA, SMOOTH};
    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_tolerances::solve::OSCILLATION;

    /// Eigenvalues of [2, ½; ½, 1] are (3 ± √2)/2.
    fn smallest() -> f64 {
        0.5 * (3.0 - 2.0_f64.sqrt())
    }

    #[test]
    fn linear_data_on_triangles_in_closed_form() -> Result<()> {
        let (_, problem) =
            fixtures::on_grid(SMOOTH, fixtures::distorted(grid(3, Cells::Triangles)))?;
        let found = oscillation(&problem, 0.0)?;
        for (at, vertices) in problem.mesh.triangles.iter().enumerate() {
            let corners = vertices.map(|vertex| problem.mesh.vertices[vertex as usize]);
            // ∫λ_iλ_j = |T|/12 (1 + δ_ij): ‖f − f̄‖² = |T|/12 Σ (f_i − f̄)².
            let values = corners.map(|[x, y]| -(4.0 * y + 14.0 * x + 2.0));
            let mean = values.iter().sum::<f64>() / 3.0;
            let spread: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
            let square = triangle_area(corners) / 12.0 * spread;
            let diameter = (0..3).map(|k| edge_length([corners[k], corners[(k + 1) % 3]]));
            let diameter = diameter.fold(0.0, f64::max);
            let mut expected = diameter / PI * (square / smallest()).sqrt();
            for &edge in &problem.topology.of_triangles[at] {
                let (edge, length) = (edge as usize, problem.lengths[edge as usize]);
                // 1e−10 of it: u_ext is rational. Its own test is in `robin`.
                expected += missed(&problem, edge, 0.0)?;
                let [[x0, y0], [x1, y1]] = problem.segment(edge);
                // ‖g − ḡ‖² of a linear g is |E|/12 times its rise squared; of q = −3.5x² − 1 with the
                // middle m, ∫ = |E| 3.5² (m² l²/3 + l⁴/180).
                let square = match problem.kinds[edge] {
                    EdgeKind::Neumann => length / 12.0 * (5.0 * (y1 - y0)).powi(2),
                    EdgeKind::Contact => {
                        let (middle, l) = (0.5 * (x0 + x1), x1 - x0);
                        let square = middle.powi(2) * l.powi(2) / 3.0 + l.powi(4) / 180.0;
                        length * 3.5_f64.powi(2) * square
                    }
                    _ => 0.0,
                };
                let shape = length * diameter * diameter / triangle_area(corners);
                let trace = 1.0 / (PI * PI) + 1.0 / PI;
                expected += (shape * trace * square / smallest()).sqrt();
            }
            OSCILLATION.check_over(format_args!("cell {at}"), found[at] - expected, expected);
        }
        Ok(())
    }

    #[test]
    fn constant_data_oscillate_only_where_the_area_element_does() -> Result<()> {
        let constant = PARABOLA.replace("f = \"0\"", "f = \"3\"");
        for cells in [Cells::Triangles, Cells::Quads] {
            let (_, problem) = fixtures::on_grid(&constant, grid(3, cells))?;
            assert!(oscillation(&problem, 0.0)?.iter().all(|&cell| cell == 0.0));
        }
        let mesh = fixtures::distorted(grid(3, Cells::Quads));
        let (_, problem) = fixtures::on_grid(&constant, mesh.clone())?;
        assert!(oscillation(&problem, 0.0)?.iter().any(|&cell| cell > 1e-3));
        let (_, problem) = fixtures::on_grid(PARABOLA, mesh)?;
        assert!(oscillation(&problem, 0.0)?.iter().all(|&cell| cell == 0.0));
        Ok(())
    }

    #[test]
    fn linear_source_on_a_square() -> Result<()> {
        // f = x on squares of side h: ‖f − f̄‖² = h⁴/12, diameter √2 h, A = I.
        let linear = PARABOLA.replace("f = \"0\"", "f = \"x\"");
        let (_, problem) = fixtures::on_grid(&linear, grid(4, Cells::Quads))?;
        let expected = 2.0_f64.sqrt() * 0.25 / PI * (0.25_f64.powi(4) / 12.0).sqrt();
        for cell in oscillation(&problem, 0.0)? {
            OSCILLATION.check("a cell", cell - expected);
        }
        Ok(())
    }
}
