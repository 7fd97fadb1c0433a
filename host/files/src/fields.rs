//! Fields as ParaView shows them.

use crate::vtu::{Field, vtu};
use signorini_certify::conductivity::Conductivity;
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_scene::error::Result;
use signorini_solve::Solution;
use signorini_solve::adaptive::indicators;

/// Fields to draw.
pub struct Drawn<'a> {
    /// Mean of u_h over each edge.
    u: &'a [f64],
    /// ∫_E σ·n of each edge.
    flux: &'a [f64],
    /// The continuous s at each vertex.
    vertices: &'a [f64],
    /// Share of each cell in the error bound; empty where there is no bound.
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
        Ok(Self { indicators, ..Self::plain(solution) })
    }

    /// A solution, with no bound.
    pub fn plain(solution: &'a Solution) -> Self {
        let Solution { u, flux, certified, .. } = solution;
        Self { u, flux, vertices: &certified.vertices, indicators: Vec::new() }
    }

    /// u_h and σ in the middle of each cell.
    pub fn in_cells(&self, problem: &Problem) -> (Vec<f64>, Vec<[f64; 2]>) {
        let fields =
            (0..problem.cells()).map(|cell| CellField::new(problem, cell, self.u, self.flux));
        fields.map(|field| (field.mean(), field.middle_flux())).unzip()
    }

    /// Share of each cell in the bound.
    pub fn indicators(&self) -> &[f64] {
        &self.indicators
    }
}

/// A VTU file of all cells.
pub fn picture(problem: &Problem, of: &Drawn) -> String {
    let mesh = &problem.mesh;
    let (cell_u, cell_flux) = of.in_cells(problem);
    let conductivity = (0..problem.cells()).map(|cell| {
        let middle = CellField::new(problem, cell, of.u, of.flux).middle();
        let a = Conductivity::of(problem, cell).at(middle);
        [a.xx, a.xy, a.yy]
    });
    let materials = problem.scene.materials.iter().map(|material| material.name.value.as_str());
    vtu(&Field {
        vertices: &mesh.vertices,
        triangles: &mesh.triangles,
        quads: &mesh.quads,
        cell_u: &cell_u,
        cell_flux: &cell_flux,
        indicator: &of.indicators,
        conductivity: &conductivity.collect::<Vec<_>>(),
        region: &problem.binding.materials,
        materials: &materials.collect::<Vec<_>>(),
        vertex_s: of.vertices,
    })
}
