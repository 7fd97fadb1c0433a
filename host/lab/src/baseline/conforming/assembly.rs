//! K, b, ψ and u_D of conforming P1 on a mesh of triangles.
//!
//! ```text
//!   K_vw = Σ_T |T| Ā ∇λ_v·∇λ_w + ∫_R h λ_v λ_w,   b_v = ∫f λ_v + ∫_N g λ_v + ∫_C q λ_v + ∫_R h u_ext λ_v
//! ```
//! ψ and u_D are taken at the vertices.

use std::collections::BTreeMap;

use signorini_kernel::Real;
use signorini_kernel::mesh::geometry::doubled_area;

use super::super::load_case::LoadCase;
use super::super::psor::TickLoads;
use super::vertices::Vertices;
use signorini_problem::quadrature::{TRIANGLE_POINTS, mean_on_edge, on_triangle};
use signorini_problem::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// Rows over all vertices by number; those on D have none.
pub(super) fn matrix(problem: &Problem, vertices: &Vertices) -> Vec<BTreeMap<usize, f64>> {
    let mut rows = vec![BTreeMap::new(); vertices.counts.edges()];
    let mut add = |v: u32, w: u32, value: f64| {
        let [v, w] = [v, w].map(|vertex| vertices.number[vertex as usize]);
        *rows[v].entry(w).or_insert(0.0) += value;
    };
    let mesh = &problem.mesh;
    for (cell, a) in mesh.triangles.iter().zip(&problem.coefficients.triangles) {
        let (gradients, area) = gradients(cell.map(|v| mesh.vertices[v as usize]));
        for (v, [x, y]) in cell.iter().zip(gradients) {
            let flux = [a.xx * x + a.xy * y, a.xy * x + a.yy * y];
            for (w, [x, y]) in cell.iter().zip(gradients) {
                add(*v, *w, area * (flux[0] * x + flux[1] * y));
            }
        }
    }
    for edge in 0..problem.ends.len() {
        let Some(transfer) = Sum::transfer(problem, edge, 0.0) else { continue };
        let h = |x, y| transfer.at(x, y);
        let (ends, hats) = (problem.ends[edge], [0, 1].map(|k| hat(problem, edge, k)));
        for (v, first) in ends.iter().zip(&hats) {
            for (w, second) in ends.iter().zip(&hats) {
                let both = |x, y| h(x, y) * first(x, y) * second(x, y);
                let mean = mean_on_edge(problem.segment(edge), both);
                add(*v, *w, problem.lengths[edge] * mean);
            }
        }
    }
    rows.truncate(vertices.counts.unknowns());
    rows
}

/// The data of one tick.
pub(super) fn data(
    problem: &Problem,
    vertices: &Vertices,
    moment: &LoadCase,
) -> Result<TickLoads<f64>> {
    let (problem, counts) = (&moment.on(problem), vertices.counts);
    let mut load = vec![0.0; counts.edges()];
    add_source(problem, vertices, moment, &mut load)?;
    let (mut lower, mut dirichlet) =
        (vec![f64::NEG_INFINITY; counts.contact], vec![0.0; counts.dirichlet]);
    for edge in 0..problem.ends.len() {
        add_flux(problem, vertices, moment, edge, &mut load)?;
        let field = match problem.kinds[edge] {
            EdgeKind::Dirichlet => Field::Value,
            EdgeKind::Contact => Field::Gap,
            _ => continue,
        };
        let sum = Sum::on_edge(problem, edge, field, problem.time);
        let Some(sum) = sum else { continue };
        for vertex in problem.ends[edge] {
            let at = vertices.number[vertex as usize];
            let [x, y] = problem.mesh.vertices[vertex as usize];
            let value = sum.finite(sum.at(x, y), [x, y])?;
            match (field, at.checked_sub(counts.unknowns())) {
                (Field::Value, Some(given)) => dirichlet[given] = moment.loads.at(x) * value,
                (Field::Gap, None) => {
                    let lower = &mut lower[at - counts.free];
                    *lower = lower.max(moment.contact * value);
                }
                _ => {}
            }
        }
    }
    load.truncate(counts.unknowns());
    let given = lower.iter().chain(&dirichlet);
    let mean = given.sum::<f64>() / (counts.contact + counts.dirichlet).max(1) as f64;
    let mut start = vec![mean; counts.free];
    start.extend(&lower);
    start.extend(&dirichlet);
    Ok(TickLoads { load, lower, spans: Vec::new(), dirichlet, start })
}

fn add_source(
    problem: &Problem,
    vertices: &Vertices,
    moment: &LoadCase,
    load: &mut [f64],
) -> Result<()> {
    let f = Sum::source(&problem.scene, problem.time);
    if f.is_zero() {
        return Ok(());
    }
    for cell in &problem.mesh.triangles {
        let corners = cell.map(|v| problem.mesh.vertices[v as usize]);
        for point in on_triangle(corners, f64::GAUSS[TRIANGLE_POINTS - 1]) {
            let value = f.finite(f.at(point.x[0], point.x[1]), point.x)?;
            for (vertex, lambda) in cell.iter().zip(point.reference) {
                let share = point.weight * value * lambda;
                load[vertices.number[*vertex as usize]] += moment.loads.at(point.x[0]) * share;
            }
        }
    }
    Ok(())
}

/// g, q or h u_ext of an edge.
fn add_flux(
    problem: &Problem,
    vertices: &Vertices,
    moment: &LoadCase,
    edge: usize,
    load: &mut [f64],
) -> Result<()> {
    let field = match problem.kinds[edge] {
        EdgeKind::Contact | EdgeKind::Neumann => Field::Flux,
        EdgeKind::Robin => Field::Ambient,
        EdgeKind::Interior | EdgeKind::Dirichlet => return Ok(()),
    };
    let Some(sum) = Sum::on_edge(problem, edge, field, problem.time) else { return Ok(()) };
    let coefficient = Sum::transfer(problem, edge, 0.0);
    let transfer = |x, y| coefficient.as_ref().map_or(1.0, |h| h.at(x, y));
    for (k, vertex) in problem.ends[edge].into_iter().enumerate() {
        let hat = hat(problem, edge, k);
        let factor = |x| match problem.kinds[edge] {
            EdgeKind::Contact => moment.contact,
            _ => moment.loads.at(x),
        };
        let both = |x, y| factor(x) * transfer(x, y) * sum.at(x, y) * hat(x, y);
        let segment = problem.segment(edge);
        let mean = sum.finite(mean_on_edge(segment, both), segment[0])?;
        load[vertices.number[vertex as usize]] += problem.lengths[edge] * mean;
    }
    Ok(())
}

/// λ of end `k` along an edge.
fn hat(problem: &Problem, edge: usize, k: usize) -> impl Fn(f64, f64) -> f64 + use<> {
    let (ends, length) = (problem.segment(edge), problem.lengths[edge]);
    let other = ends[1 - k];
    move |x, y| (x - other[0]).hypot(y - other[1]) / length
}

/// ∇λ of the three corners, and |T|.
pub(super) fn gradients([a, b, c]: [[f64; 2]; 3]) -> ([[f64; 2]; 3], f64) {
    let doubled = doubled_area(a, b, c);
    let turned =
        |from: [f64; 2], to: [f64; 2]| [(from[1] - to[1]) / doubled, (to[0] - from[0]) / doubled];
    ([turned(b, c), turned(c, a), turned(a, b)], 0.5 * doubled)
}
