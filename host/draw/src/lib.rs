//! The report: one HTML file a person wants to look at, complete in itself.
//!
//! ```text
//! Report ─► page (HTML) ─┬─► panel ─┬─► field    u as colour ◄ isobands; the flux ◄ arrows  ─┬─► plane
//!                        │          │            where the error comes from, cell by cell    ─┘
//!                        │          └─► contact  λ and the opening along C
//!                        ├─► figure       a chart of two logarithmic axes, with a legend
//!                        ├─► tradeoff     settings: what they cost, how wrong they are ─► pareto
//!                        └─► extremes     numbers pushed until something gives ─► outcome_map
//! Chart ─► chart_file (SVG)             what changes from tick to tick, a diagram each
//! Plan ─► plan_file (SVG)               what holds where, before anything is solved
//! axes   a diagram's scales, grid, lines and areas ◄ chart, figure, contact, pareto
//! ```
//! No two curves of a plot have the same colour and marker (`look`). What enumerates is a list (`markup`).
//! All pictures are SVG inside the page (`svg`, `scale`); no script, no font, no other file.
//! Nothing here knows a solver or a scene: everything is plain data, filled by the program that ran one. Values that are
//! not finite are never written: what they belong to is left out or shown as "–".

mod arrows;
mod axes;
mod chart;
mod colormap;
mod contact;
mod extremes;
mod field;
mod figure;
mod isobands;
mod legend;
mod lettering;
mod look;
mod markup;
mod outcome_map;
mod outline;
mod page;
mod panel;
mod pareto;
mod plan;
mod plane;
mod scale;
mod simplify;
mod solution;
mod svg;
mod table;
#[cfg(test)]
mod tests;
mod tradeoff;

pub use chart::{Band, Chart, Curve, Strip, chart_file};
pub use extremes::{Extremes, ExtremesStudy, extremes_page};
pub use figure::measured_rate;
pub use outcome_map::{OutcomeMap, Square};
pub use page::html;
pub use pareto::{ParetoPlot, ParetoPoint, pareto_file};
pub use plan::{Plan, PlanBoundary, PlanKind, plan_file};
pub use scale::plain;
pub use solution::solution_file;
pub use svg::escape;
pub use table::{Column, Heading, Mark, Table, TableRow};
pub use tradeoff::{TradePanel, TradeStudy, Tradeoff};

/// Everything the page shows, in the order it shows it.
#[derive(Debug, Clone, Default)]
pub struct Report {
    /// The heading.
    pub title: String,
    /// Version, compiler, machine: what made these numbers.
    pub generated_by: String,
    /// The solutions, a panel each.
    pub scenes: Vec<ScenePanel>,
    /// The main table.
    pub table: Table,
    /// Claims that were tested beside the rows of the table.
    pub checks: Vec<Check>,
    /// Error over mesh width, a picture each.
    pub convergence: Vec<Chart>,
    /// The error bound of solves that were cut off.
    pub cut_off: Table,
    /// The bound over sweeps, a picture each.
    pub sweeps: Vec<Chart>,
    /// Cost and error of settings.
    pub tradeoff: Option<Tradeoff>,
    /// Outcomes of scenes whose numbers were pushed.
    pub extremes: Option<Extremes>,
}

/// A claim that was tested.
#[derive(Debug, Clone)]
pub struct Check {
    /// The claim.
    pub claim: String,
    /// The finding.
    pub found: String,
    /// Whether it holds.
    pub passed: bool,
}

/// One solved scene.
#[derive(Debug, Clone, Default)]
pub struct ScenePanel {
    /// The short name, as in the first column of the main table.
    pub name: String,
    /// The title.
    pub title: String,
    /// Whether it is there to test the method, since its exact solution is known.
    pub is_test: bool,
    /// A sentence that an engineer would say of it, if there is one.
    pub sentence: Option<String>,
    /// Whether every check on the scene holds.
    pub passed: bool,
    /// Vertex coordinates.
    pub vertices: Vec<[f64; 2]>,
    /// Vertices of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Vertices of the quads.
    pub quads: Vec<[u32; 4]>,
    /// The conforming u at each vertex.
    pub vertex_u: Vec<f64>,
    /// The flux σ = A∇u at the centre of each cell, triangles first.
    pub cell_flux: Vec<[f64; 2]>,
    /// Each cell's part of the square of the bound's gap, triangles first.
    pub indicators: Vec<f64>,
    /// How wrong u and σ can be, where that is known.
    pub bound: Option<BoundTerms>,
    /// Why there is none.
    pub no_bound: Option<String>,
    /// How wrong they are, where that is known.
    pub error: Option<f64>,
    /// The energy norm of the solution, which makes sizes of both, and its formula.
    pub energy: (f64, &'static str),
    /// The edges of the contact boundary C, by arc length.
    pub contact: Vec<ContactEdge>,
    /// The edges of the rest of the boundary.
    pub boundary: Vec<BoundaryEdge>,
    /// Numbers worth knowing: name and value.
    pub facts: Vec<(String, String)>,
}

impl ScenePanel {
    /// The vertices of each cell, triangles first.
    fn cells(&self) -> impl Iterator<Item = &[u32]> {
        let triangles = self.triangles.iter().map(|cell| cell.as_slice());
        triangles.chain(self.quads.iter().map(|cell| cell.as_slice()))
    }
}

/// How wrong u and σ can be, and the parts of that: energy norms.
#[derive(Debug, Clone, Copy, Default)]
pub struct BoundTerms {
    /// Never less than the combined error of the conforming solution and the flux.
    pub total: f64,
    /// Never less than the error of the edge means.
    pub of_u: f64,
    /// The part of the total due to mesh and solver.
    pub gap: f64,
    /// The part that more sweeps would remove.
    pub algebraic: f64,
    /// The part due to data that vary inside cells.
    pub oscillation: f64,
    /// The part due to rounding.
    pub rounding: f64,
}

/// An edge of the contact boundary.
#[derive(Debug, Clone, Default)]
pub struct ContactEdge {
    /// The boundary that it belongs to.
    pub boundary: String,
    /// Its ends.
    pub ends: [[f64; 2]; 2],
    /// The arc length along C at both ends, the smaller first.
    pub arc_length: [f64; 2],
    /// On which side of the gap u is here.
    pub state: ContactState,
    /// The multiplier λ = σ·n − q, constant on the edge.
    pub multiplier: f64,
    /// The exact λ at equally spaced points from the first to the second arc length (with both
    /// ends when there are two or more; the midpoint when there is one); empty if unknown.
    pub exact_multiplier: Vec<f64>,
    /// The mean of u − ψ over the edge.
    pub opening: f64,
}

/// Where u is on a contact edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ContactState {
    /// Above the gap.
    #[default]
    Open,
    /// On it.
    Touching,
    /// Below it, with the flux at its limit.
    Saturated,
}

impl ContactState {
    /// Every state, in the order in which they are drawn.
    pub const ALL: [Self; 3] = [Self::Open, Self::Saturated, Self::Touching];

    /// The class of its line, and the words of a legend.
    fn look(self) -> [&'static str; 2] {
        match self {
            Self::Open => ["open", "open"],
            Self::Touching => ["active", "in contact"],
            Self::Saturated => ["saturated", "at the limit"],
        }
    }
}

/// An edge of the boundary outside C.
#[derive(Debug, Clone)]
pub struct BoundaryEdge {
    /// Its ends.
    pub ends: [[f64; 2]; 2],
    /// The datum that is prescribed.
    pub kind: BoundaryKind,
}

/// The datum that is prescribed on an edge outside C.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundaryKind {
    /// u itself.
    Dirichlet,
    /// The outward flux.
    Neumann,
    /// The outward flux in proportion to ambient − u.
    Robin,
}

impl BoundaryKind {
    /// The class of its line, and the words of a legend.
    fn look(self) -> [&'static str; 2] {
        match self {
            Self::Dirichlet => ["dirichlet", "Dirichlet"],
            Self::Neumann => ["neumann", "Neumann"],
            Self::Robin => ["robin", "Robin"],
        }
    }
}
