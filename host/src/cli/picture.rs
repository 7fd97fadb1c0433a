//! Fields as ParaView shows them.

use signorini_bake::tick::TickFields;
use signorini_scene::error::Result;
use signorini_solve::adaptive::indicators;
use signorini_solve::certify::conductivity::Conductivity;
use signorini_solve::field::CellField;
use signorini_solve::output::vtu::{Field, vtu};
use signorini_solve::problem::Problem;
use signorini_solve::solve::Solution;

/// What is drawn.
pub(super) struct Drawn<'a> {
    /// Mean of u_h over each edge.
    u: &'a [f64],
    /// ∫_E σ·n of each edge.
    flux: &'a [f64],
    /// The continuous s at each vertex.
    vertices: &'a [f64],
    /// What each cell has of the error bound; nothing where there is no bound.
    indicators: Vec<f64>,
}

impl<'a> Drawn<'a> {
    /// A solution, with what its cells have of the bound.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn of(problem: &Problem, solution: &'a Solution) -> Result<Self> {
        let squares = match solution.bound {
            Some(_) => indicators::squares(problem, solution)?,
            None => Vec::new(),
        };
        let indicators = squares.into_iter().map(f64::sqrt).collect();
        let Solution { u, flux, certified, .. } = solution;
        Ok(Self { u, flux, vertices: &certified.vertices, indicators })
    }

    /// The answer of a tick; none where it was refused.
    pub fn of_tick(TickFields { u, flux, vertices }: &'a TickFields) -> Option<Self> {
        (!u.is_empty()).then_some(Self { u, flux, vertices, indicators: Vec::new() })
    }
}

/// A VTU file of all cells.
pub(super) fn picture(problem: &Problem, of: &Drawn) -> String {
    let mesh = &problem.mesh;
    let cells = 0..mesh.triangles.len() + mesh.quads.len();
    let fields: Vec<_> =
        cells.clone().map(|cell| CellField::new(problem, cell, of.u, of.flux)).collect();
    let conductivity = cells.zip(&fields).map(|(cell, field)| {
        let a = Conductivity::of(problem, cell).at(field.middle());
        [a.xx, a.xy, a.yy]
    });
    let materials = problem.scene.materials.iter().map(|material| material.name.value.as_str());
    vtu(&Field {
        vertices: &mesh.vertices,
        triangles: &mesh.triangles,
        quads: &mesh.quads,
        cell_u: &fields.iter().map(CellField::mean).collect::<Vec<_>>(),
        cell_flux: &fields.iter().map(CellField::middle_flux).collect::<Vec<_>>(),
        indicator: &of.indicators,
        conductivity: &conductivity.collect::<Vec<_>>(),
        region: &problem.binding.materials,
        materials: &materials.collect::<Vec<_>>(),
        vertex_s: of.vertices,
    })
}
