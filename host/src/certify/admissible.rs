//! The functions whose distance to the solution the bound bounds: S in H¹ and τ in H(div).

use super::cell::{Jet, Local};
use super::deviation::{Deviation, Deviations};
use crate::error::Result;
use crate::problem::Problem;

/// S and τ by their numbers (borrowed).
///
/// S is P1 or Q1 in its vertex values, plus d_E · 4t(1 − t)(1 − η) on the sides of quads, plus the
/// extensions of what ψ and u_D have above their chords. τ is the Raviart–Thomas field of its fluxes,
/// on quads by Piola's map.
#[derive(Debug, Clone, Copy)]
pub struct Admissible<'a> {
    /// S at each vertex, in the unit of u.
    pub vertices: &'a [f64],
    /// d_E of each edge, in the unit of u; 0 on edges of a triangle.
    pub bubbles: &'a [f64],
    /// ∫_E τ·n of each edge, n being its direction turned clockwise: outward on the boundary.
    pub tau: &'a [f64],
}

/// S on one cell.
pub(crate) struct OnCell<'d, 's> {
    vertices: Vec<f64>,
    sides: Vec<(f64, Option<&'d Deviation<'s>>)>,
}

impl Admissible<'_> {
    /// S on cell `at`, triangles first.
    pub(crate) fn on_cell<'d, 's>(
        &self,
        problem: &Problem,
        at: usize,
        deviations: &'d Deviations<'s>,
    ) -> OnCell<'d, 's> {
        let (mesh, topology) = (&problem.mesh, &problem.topology);
        let quad = at.checked_sub(mesh.triangles.len());
        let (vertices, edges): (&[u32], &[u32]) = match quad {
            None => (&mesh.triangles[at], &topology.of_triangles[at]),
            Some(quad) => (&mesh.quads[quad], &topology.of_quads[quad]),
        };
        let side = |&edge: &u32| {
            let edge = edge as usize;
            let bubble = if quad.is_some() { self.bubbles[edge] } else { 0.0 };
            (bubble, deviations.on(edge))
        };
        OnCell {
            vertices: vertices.iter().map(|&vertex| self.vertices[vertex as usize]).collect(),
            sides: edges.iter().map(side).collect(),
        }
    }

    /// S on an edge, t running in the edge's direction.
    pub(crate) fn on_edge(
        &self,
        problem: &Problem,
        edge: usize,
        deviation: Option<&Deviation>,
        t: f64,
    ) -> Result<f64> {
        let [start, end] = problem.ends[edge].map(|vertex| self.vertices[vertex as usize]);
        let w = deviation.map_or(Ok(0.0), |deviation| deviation.at(t).map(|[w, _]| w))?;
        Ok(start + t * (end - start) + 4.0 * t * (1.0 - t) * self.bubbles[edge] + w)
    }
}

impl OnCell<'_, '_> {
    /// S and ∇S at a point of the cell.
    pub(crate) fn at(&self, local: &Local) -> Result<Jet> {
        let mut sum = Jet::default();
        for (&value, &function) in self.vertices.iter().zip(&local.vertices) {
            sum.add(value, function);
        }
        for ((bubble, deviation), side) in self.sides.iter().zip(&local.sides) {
            sum.add(*bubble, side.bubble());
            if let Some(deviation) = deviation {
                let [w, slope] = deviation.at(side.t)?;
                sum.add(1.0, side.extension(w, slope));
            }
        }
        Ok(sum)
    }
}
