//! The functions whose distance to the solution the bound bounds: S in H¹ and τ in H(div).

use super::cell::{Jet, Local};
use super::deviation::{Deviation, Deviations, Lift};
use signorini_problem::Problem;
use signorini_scene::error::Result;

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
    /// Where it has extensions.
    pub following: &'a Following,
}

/// On which edges S follows what ψ and u_D have above their chords.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Following {
    /// On all of them but these, as in a condensed model.
    Except(Vec<u32>),
    /// Not where it is clear of ψ: [`super::curved::followed`].
    WhereNeeded,
}

impl Default for Following {
    /// On all of them.
    fn default() -> Self {
        Self::Except(Vec::new())
    }
}

/// S on one cell, without what ψ and u_D add to it.
pub struct Chordal {
    vertices: [f64; 4],
    bubbles: [f64; 4],
    is_quad: bool,
}

/// S on one cell.
pub struct OnCell<'d, 's> {
    chordal: Chordal,
    lift: Lift<'d, 's>,
}

impl Admissible<'_> {
    /// S on cell `at`, triangles first.
    pub fn on_cell<'d, 's>(
        &self,
        problem: &Problem,
        at: usize,
        deviations: &'d Deviations<'s>,
    ) -> OnCell<'d, 's> {
        let lift = Lift::on_cell(problem, at, deviations);
        OnCell { chordal: self.chordal(problem, at), lift }
    }

    /// S − L on cell `at`, triangles first: its part that the numbers give.
    pub fn chordal(&self, problem: &Problem, at: usize) -> Chordal {
        let is_quad = at >= problem.mesh.triangles.len();
        let mut here = Chordal { vertices: [0.0; 4], bubbles: [0.0; 4], is_quad };
        for (to, &vertex) in here.vertices.iter_mut().zip(problem.vertices_of(at)) {
            *to = self.vertices[vertex as usize];
        }
        if is_quad {
            for (to, &edge) in here.bubbles.iter_mut().zip(problem.topology.edges_of(at)) {
                *to = self.bubbles[edge as usize];
            }
        }
        here
    }

    /// S on an edge, t running in the edge's direction.
    pub fn on_edge(
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

impl Chordal {
    /// S − L and its gradient at a point of the cell.
    pub fn at(&self, local: &Local) -> Jet {
        let mut sum = Jet::default();
        for (value, function) in self.vertices.into_iter().zip(local.vertices) {
            sum.add(value, function);
        }
        if self.is_quad {
            for (bubble, side) in self.bubbles.into_iter().zip(&local.sides) {
                sum.add(bubble, side.bubble());
            }
        }
        sum
    }
}

impl OnCell<'_, '_> {
    /// S and ∇S at a point of the cell.
    pub fn at(&self, local: &Local) -> Result<Jet> {
        let mut sum = self.chordal.at(local);
        sum.add(1.0, self.lift.at(local)?);
        Ok(sum)
    }
}
