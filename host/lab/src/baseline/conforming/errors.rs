//! How far conforming P1 is from the exact solution.

use signorini_kernel::Real;

use super::Conforming;
use super::assembly::gradients;
use crate::baseline::record::PointError;
use signorini_problem::EdgeKind;
use signorini_problem::pointwise::{POINTS, exact_at};
use signorini_problem::quadrature::{gauss, on_triangle};
use signorini_scene::error::Result;
use signorini_scene::scene::{Condition, Exact};

/// Of u as values at all vertices of the mesh, by the rules of [`signorini_solve::norms`]. The flux is A∇u_h.
pub(super) fn errors(
    conforming: &Conforming,
    exact: &Exact,
    u: &[f64],
    force: f64,
    length: f64,
) -> Result<PointError> {
    let (problem, time) = (&conforming.problem, conforming.problem.time);
    let rule = gauss(POINTS);
    let mut sums = PointError::default();
    for (cell, corners) in problem.mesh.triangles.iter().enumerate() {
        let material = &problem.scene.materials[problem.binding.materials[cell] as usize];
        let places = corners.map(|v| problem.mesh.vertices[v as usize]);
        let values = corners.map(|v| u[v as usize]);
        let (hats, _) = gradients(places);
        let slope = [0, 1].map(|k| (0..3).map(|v| values[v] * hats[v][k]).sum::<f64>());
        for point in on_triangle(places, &rule) {
            let (value, gradient) = exact_at(&problem.scene, exact, point.x, time)?;
            let [x, y] = point.x;
            let [xx, xy, yy] = material.conductivity.each_ref().map(|a| a.value.eval(x, y, 0.0));
            let here: f64 = (0..3).map(|v| values[v] * point.reference[v]).sum();
            let [ex, ey] = [0, 1].map(|k| gradient[k] - slope[k]);
            let flux = [xx * ex + xy * ey, xy * ex + yy * ey];
            sums.energy += point.weight * (flux[0] * ex + flux[1] * ey);
            sums.flux += point.weight * (flux[0] * flux[0] + flux[1] * flux[1]);
            sums.l2 += point.weight * (value - here).powi(2);
        }
    }
    let (exact_force, exact_length) = on_contact(conforming, exact)?;
    Ok(PointError {
        energy: sums.energy.sqrt(),
        combined: None,
        l2: sums.l2.sqrt(),
        flux: sums.flux.sqrt(),
        force: (force - exact_force).abs(),
        length: (length - exact_length).abs(),
    })
}

/// ∫_C (σ·n − q) of the exact solution, and the length on which it is more than rounding: by Gauss points
/// on every edge, which leave an error of order h^{3/2} where contact ends inside one.
fn on_contact(conforming: &Conforming, exact: &Exact) -> Result<(f64, f64)> {
    const ROUNDING: f64 = 1e-9;
    let (problem, time) = (&conforming.problem, conforming.problem.time);
    let (mut force, mut length) = (0.0, 0.0);
    for edge in (0..problem.ends.len()).filter(|&e| problem.kinds[e] == EdgeKind::Contact) {
        let (cell, _) = problem.topology.first_side(edge);
        let material = &problem.scene.materials[problem.binding.materials[cell] as usize];
        let [a, b] = problem.segment(edge);
        let normal = [b[1] - a[1], a[0] - b[0]];
        let boundary = problem.binding.boundary(problem.ends[edge]);
        let q = boundary.and_then(|at| match &problem.scene.boundaries[at].condition {
            Condition::Contact { flux, .. } => Some(&flux.value),
            _ => None,
        });
        for &[t, weight] in f64::GAUSS[7] {
            let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
            let (_, [ux, uy]) = exact_at(&problem.scene, exact, [x, y], time)?;
            let [xx, xy, yy] = material.conductivity.each_ref().map(|a| a.value.eval(x, y, 0.0));
            let out = (xx * ux + xy * uy) * normal[0] + (xy * ux + yy * uy) * normal[1];
            let given = q.map_or(0.0, |q| q.eval(x, y, time)) * problem.lengths[edge];
            force += weight * (out - given);
            if out - given > ROUNDING * problem.lengths[edge] {
                length += weight * problem.lengths[edge];
            }
        }
    }
    Ok((force, length))
}
