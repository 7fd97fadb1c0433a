//! Rounding in f64 in the columns of the forms, where the host made them.
//!
//! ```text
//!   lost_j = ε Σ over rows |terms|  +  (way + out) Σ_T (|Σ ±τ_E − ∫_T f| + ε Σ|terms|)  +  stability ‖ΔŜ_j‖
//! ```
//! First comes the residual itself, a sum of terms that cancel. Then τ, which balances on the cells up to rounding: what is
//! left is brought along the forest to the boundary (`way`, see [`signorini_bound::certificate::stability`]), and where contact
//! alone holds a part through a contact edge (`out`). Last Ŝ, which is made symmetric. What oblique element matrices hide of
//! themselves is a share of all of F ([`Assembled::hidden`]). Next to the rounding of f32 all of
//! this is nothing; in f64 it is what is left to be wrong of an answer that is exact.

use signorini_kernel::mesh::components::Support;

use super::best::Table;
use super::block::Block;
use super::elimination::Field;
use super::form::FormData;
use super::{Columns, Pieces};
use signorini_certify::forest::EquilibrationForest;
use signorini_certify::metric::Metric;
use signorini_problem::{Assembled, EdgeKind, Loads, Problem};
use signorini_scene::error::Result;
use signorini_solve::unfit;

/// Roundings of a sum of a few products, of its factors, and of what follows from them.
/// And 16 for columns that count as dependent.
pub(super) const FEW: f64 = 24.0 * f64::EPSILON;

impl FormData<'_> {
    /// lost_j of the columns of p and x, for U = 1.
    ///
    /// # Errors
    /// Numbers out of range.
    pub(super) fn lost(
        &self,
        blocks: &[Block],
        s: &Table,
        fluxes: &Table,
        assembled: &Assembled<f64>,
        stability: f64,
    ) -> Result<Vec<f64>> {
        let Columns { pieces, fields, openings } = self.columns;
        let inputs = pieces.patterns.len();
        let mut lost = terms(blocks, s, fluxes);
        lost.iter_mut().for_each(|size| *size *= FEW);
        let most = openings.iter().fold(0.0, |most: f64, d| most.max(*d));
        let out = if self.floating().is_empty() { 0.0 } else { stability * most };
        let way = self.way(assembled)? + out;
        for (at, (field, lost)) in fields.iter().zip(&mut lost).enumerate() {
            let loads = pieces.patterns.get(at).map(|pattern| pattern.loads());
            *lost += way * self.unbalanced(field, loads);
            if let Some(column) = at.checked_sub(inputs) {
                *lost += stability * self.skewed(field, column);
            }
        }
        Ok(lost)
    }

    /// Energy that it takes to bring 1 from the farthest cell to the boundary.
    fn way(&self, assembled: &Assembled<f64>) -> Result<f64> {
        let Pieces { problem, parts, .. } = self.columns.pieces;
        let unfit = unfit::<f64>(&problem.scene);
        let edges = *assembled.edges();
        let alone = |edge: usize| {
            problem.kinds[edge] == EdgeKind::Contact
                && parts.support(parts.of_edge(&edges, edge)) == Support::Contact
        };
        let mut ways = EquilibrationForest::new(problem);
        ways.find(assembled, &Metric::new(problem), alone).map_err(&unfit)?;
        Ok(ways.stability())
    }

    /// Σ over the cells and Neumann edges of what `field` is out of balance, and may be by rounding.
    fn unbalanced(&self, field: &Field, loads: Option<&Loads>) -> f64 {
        let Pieces { problem, settled, .. } = self.columns.pieces;
        let Problem { topology, kinds, .. } = problem;
        // A cell that stores something keeps what it lacks: that stands in its rows.
        let is_balanced = |at: &usize| problem.loads.content(*at) == 0.0;
        let of_cells: f64 = (0..problem.cells())
            .filter(is_balanced)
            .map(|at| {
                let load = loads.map_or(0.0, |loads| loads.of_cell(at));
                let (mut sum, mut size) = (load, load.abs());
                for (side, &edge) in topology.edges_of(at).iter().enumerate() {
                    let flux = field.flux[edge as usize];
                    let first = topology.first_side(edge as usize) == (at, side);
                    sum += if first { flux } else { -flux };
                    size += flux.abs();
                }
                sum.abs() + FEW * size
            })
            .sum();
        let mut given = vec![0.0; kinds.len()];
        let neumann = loads.map_or(&[][..], |loads| &loads.neumann);
        neumann.iter().for_each(|of| given[of.edge as usize] = of.flux);
        let missed = (0..kinds.len()).filter(|&edge| kinds[edge].has_given_flux());
        let free = topology.counts.free;
        let q = |edge: usize| loads.map_or(0.0, |loads| loads.contact_flux[edge]);
        let open = settled.open.iter().map(|&edge| (field.flux[free + edge] - q(edge)).abs());
        let missed = missed.map(|edge| (field.flux[edge] - given[edge]).abs());
        of_cells + missed.chain(open).sum::<f64>()
    }

    /// Σ_i |Ŝ_ij − d_i ∫σ_j·n| of column j.
    fn skewed(&self, field: &Field, column: usize) -> f64 {
        let Columns { pieces, openings, .. } = self.columns;
        let contact = &field.flux[pieces.problem.topology.counts.free..];
        let rows = pieces.edges.iter().zip(openings).enumerate();
        rows.map(|(i, (&edge, d))| (self.matrix[(i, column)] - d * contact[edge]).abs()).sum()
    }
}

/// (Σ over rows (Σ |terms|)²)^½ of every column of the residual.
pub(super) fn terms(blocks: &[Block], s: &Table, fluxes: &Table) -> Vec<f64> {
    let (mut squares, mut sum) = (vec![0.0; s.columns], vec![0.0; s.columns]);
    for block in blocks {
        for row in &block.rows {
            block.sizes(row, s, fluxes, &mut sum);
            squares.iter_mut().zip(&sum).for_each(|(square, size)| *square += size * size);
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}
