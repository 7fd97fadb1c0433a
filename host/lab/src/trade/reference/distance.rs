//! Norms of the difference between a reference and an answer, over the points of the reference.
//!
//! The answer is evaluated in the cell of its own mesh that holds the point, so that the two meshes need
//! not be nested: quads may be measured against triangles.

use super::certified;
use super::finer_solve::Reference;
use super::places::{OnEdge, Places};
use crate::mesh_solution::MeshSolution;
use crate::trade::record::PointError;
use signorini_certify::conductivity::{apply, dot, product};
use signorini_certify::weighed::{in_cell, minus, on_robin};
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::quadrature::Point;
use signorini_problem::search::LocatedPoint;
use signorini_scene::Result;
use signorini_solve::Solution;

impl Reference {
    /// The norms over the domain; force and length are left 0.
    pub(super) fn errors(&self, problem: &Problem, answer: &Solution) -> Result<PointError> {
        let inside = self.points.iter().map(|point| point.x);
        let robin = self.robin.iter().map(|point| point.x);
        let places = self.places.on(&problem.mesh, || Places::find(problem, inside, robin))?;
        let combined = |of| self.combined(&MeshSolution::new(problem, of, &answer.u)?, &places);
        let combined = certified(answer).map(combined).transpose()?;
        Ok(PointError { combined, ..self.broken(problem, &places, answer) })
    }

    /// Energy, L2 and flux, of u_h and σ_h.
    fn broken(&self, problem: &Problem, places: &Places, answer: &Solution) -> PointError {
        let on_cell = |cell| CellField::new(problem, cell, &answer.u, &answer.flux);
        let fields: Vec<_> = (0..problem.cells()).map(on_cell).collect();
        let (mut energy, mut l2, mut flux) = (0.0, 0.0, 0.0);
        for (known, place) in self.points.iter().zip(&places.cells) {
            let found = fields[place.cell as usize].sample(&here(known.x, place));
            let error = minus(known.gradient, found.gradient);
            let sigma = minus(apply(&known.conductivity, known.gradient), found.flux);
            energy += known.weight * product(&known.conductivity, error, error);
            l2 += known.weight * (known.u - found.u).powi(2);
            flux += known.weight * dot(sigma, sigma);
        }
        let [energy, l2, flux] = [energy, l2, flux].map(f64::sqrt);
        PointError { energy, l2, flux, ..PointError::default() }
    }

    /// The distance of S and τ, as [`signorini_certify::exact`] has it.
    fn combined(&self, answer: &MeshSolution, places: &Places) -> Result<f64> {
        let MeshSolution { problem, admissible, .. } = answer;
        let cells: Vec<_> = (0..problem.cells()).map(|at| answer.on_cell(at)).collect();
        let mut square = 0.0;
        for (known, place) in self.points.iter().zip(&places.cells) {
            let at = &cells[place.cell as usize];
            let s = at.s(place.reference)?;
            let tau = at.tau.sample(&here(known.x, place)).flux;
            square += known.weight * in_cell(&known.conductivity, known.gradient, s.gradient, tau);
        }
        for (known, &OnEdge { edge, t }) in self.robin.iter().zip(&places.edges) {
            let s = answer.s_on_edge(edge, t)?;
            let tau = admissible.tau[edge] / problem.lengths[edge];
            square += known.weight * on_robin(known.transfer, known.u - s, known.sigma - tau);
        }
        Ok(square.sqrt())
    }
}

/// A point of the reference as a cell of the answer sees it.
fn here(x: [f64; 2], place: &LocatedPoint) -> Point {
    Point { x, reference: place.reference, weight: 0.0 }
}
