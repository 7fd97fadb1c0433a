//! What it costs, in ‖A^½∇·‖, that a load of 1 is not there: it has to be brought from its cell to where it can leave.
//!
//! ```text
//!   a load of 1 in a cell       reach_T, where the forest of cells leads out: ≤ `largest`
//!   along an edge               reach_T + off_E, what the mean along the edge differs from that in its cell
//! ```
//! In a step of time a cell may keep a load as well, at the cost 1/(c|T|/dt)^½. Where something holds every part that does not count: over many
//! steps what is kept leaves after all.

use super::oscillation::off_mean;
use signorini_problem::Problem;

/// Costs of the cells of a mesh.
#[derive(Debug, Clone)]
pub struct Reach<'a> {
    problem: &'a Problem,
    of_cells: Vec<f64>,
}

impl<'a> Reach<'a> {
    /// Where balancing the farthest cell costs `largest`. The ways lead out of the domain, or `to_storage`: to cells that store.
    pub fn new(problem: &'a Problem, largest: f64, to_storage: bool) -> Self {
        let cells = 0..problem.cells();
        if !to_storage {
            return Self { problem, of_cells: vec![largest; cells.len()] };
        }
        let kept = |cell: usize| 1.0 / problem.loads.content(cell).sqrt();
        let costs: Vec<f64> = cells.map(kept).collect();
        let all = costs.iter().filter(|cost| cost.is_finite());
        let way = largest + all.fold(0.0, |most: f64, &cost| most.max(cost));
        Self { problem, of_cells: costs.into_iter().map(|cost| cost.min(way)).collect() }
    }

    /// The cost in each cell.
    pub fn of_cells(&self) -> &[f64] {
        &self.of_cells
    }

    /// The cost along an edge.
    pub fn of_edge(&self, edge: usize) -> f64 {
        let (cell, _) = self.problem.topology.first_side(edge);
        self.of_cells[cell] + off_mean(self.problem, edge)
    }

    /// The cost along every contact edge.
    pub fn of_contact(&self) -> impl Iterator<Item = f64> {
        let counts = self.problem.topology.counts;
        (counts.free..counts.unknowns()).map(|edge| self.of_edge(edge))
    }

    /// What ends of contact fluxes that have gone to their mean cost, see [`Loads::moved`](signorini_problem::Loads).
    pub fn settled(&self, moved: f64) -> f64 {
        if moved == 0.0 {
            return 0.0;
        }
        let spans = self.problem.loads.spans.iter().zip(self.of_contact());
        moved * spans.filter(|(span, _)| **span == 0.0).map(|(_, cost)| cost).sum::<f64>()
    }
}
