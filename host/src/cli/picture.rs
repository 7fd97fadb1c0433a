//! A solution as ParaView shows it.

use signorini_solve::field::CellField;
use signorini_solve::output::vtu::{Field, vtu};
use signorini_solve::problem::Problem;
use signorini_solve::solve::Solution;

/// `solution.vtu` of a solution.
pub(super) fn picture(problem: &Problem, solution: &Solution) -> String {
    let mesh = &problem.mesh;
    let cells = 0..mesh.triangles.len() + mesh.quads.len();
    let fields: Vec<_> =
        cells.map(|cell| CellField::new(problem, cell, &solution.u, &solution.flux)).collect();
    vtu(&Field {
        vertices: &mesh.vertices,
        triangles: &mesh.triangles,
        quads: &mesh.quads,
        cell_u: &fields.iter().map(CellField::mean).collect::<Vec<_>>(),
        cell_flux: &fields.iter().map(CellField::middle_flux).collect::<Vec<_>>(),
        region: &problem.binding.materials,
        vertex_u: &solution.certified.vertices,
    })
}
