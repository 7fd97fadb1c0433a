//! The bound of a condensed step as one form, over its terms, its openings and corrections.
//!
//! s is the best conforming function for u after the step, a sum of those of static shapes, states and corrections, and s_old the same sum of what
//! the last tick has left. With R = f̄ − k(s − s_old) + ∇·τ, all of which counts in the norm of the storage,
//! ```text
//!   |F (t, x, d)|² = ‖A^½∇s − A^{−½}τ‖² + ∫R²/k + Robin        t = (p, p⁻, x⁻, y⁻, d⁻)
//! ```
//! takes the place of the form of a steady problem: what contact adds, what mends r, and what data vary by in a cell are as there, and the sum
//! bounds the error of the step that begins at s_old. That is never less than the mesh's certificate, which may take R′ out of the storage.
//! So d⁻, by which s was corrected at contact vertices, is handed on too.

use std::collections::BTreeSet;

use super::super::Pieces;
use super::super::best::{Table, complete};
use super::super::block::{Block, Functions};
use super::super::chain::Chain;
use super::super::elimination::failed;
use super::super::form::{FormData, Found};
use super::super::residual::{Of, Residual};
use super::rows::storage;
use signorini_kernel::mesh::boundary::Robin;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// What s of a step is a sum of.
#[derive(Clone)]
pub(in super::super) struct StepShapes {
    /// Means of a unit of each input with the constant, each scaled opening, and each state.
    pub means: [Vec<Vec<f64>>; 3],
    /// ω of the states.
    pub fading: Vec<f64>,
    /// What changes of inputs without the constant, then of openings, take from each state.
    pub changes: Vec<Vec<f64>>,
    /// Contact vertices at which s is corrected.
    pub corrections: usize,
}

impl Pieces<'_> {
    /// Why there is no bound of steps of this problem, if so.
    pub(in super::super) fn obstacle_of_steps(&self) -> Option<&'static str> {
        let is_curved = self.patterns.iter().any(|pattern| !pattern.curved.is_empty());
        let quads = self.problem.mesh.triangles.len()..self.problem.cells();
        let is_oblique = |cell| !signorini_certify::cell::Cell::of(self.problem, cell).is_affine();
        match () {
            () if is_curved => Some(
                "a gap or a value that is not linear along an edge has none in condensed steps",
            ),
            () if quads.into_iter().any(is_oblique) => {
                Some("quads that are no parallelograms have none in condensed steps")
            }
            () => None,
        }
    }
}

/// Rows by which s has the means of u over Robin edges, as far as it can.
fn of_robin(problem: &Problem) -> Vec<Block> {
    let of_law = |law: &Robin<f64, u32>| {
        let edge = law.edge as usize;
        let factor = (law.coefficient * problem.lengths[edge]).sqrt();
        Block {
            functions: problem.ends[edge].to_vec(),
            edges: vec![law.edge],
            rows: vec![vec![0.5 * factor, 0.5 * factor, -factor]],
        }
    };
    problem.loads.robin.iter().map(of_law).collect()
}

/// How many contact vertices s is corrected at, for openings in these units, and where s − ψ comes from at the ends of each unknown's edge;
/// none where s cannot be fixed.
pub(super) fn corrections(pieces: &Pieces, openings: &[f64]) -> (usize, Vec<[usize; 2]>) {
    if pieces.obstacle_of_steps().is_some()
        || pieces.patterns.iter().any(|of| of.no_bound.is_some())
    {
        return (0, Vec::new());
    }
    let chain = Chain::new(pieces, openings, &BTreeSet::new());
    chain.map_or((0, Vec::new()), |chain| (chain.contact.len(), chain.ends))
}

impl StepShapes {
    /// s after the step in its first half of rows, and s_old in the second, by the columns of t, x and d.
    fn table(&self, own: &Table) -> Table {
        let [m, n, r] = self.means.each_ref().map(Vec::len);
        let (v, count) = (self.corrections, own.values.len() / own.columns);
        let terms = 2 * m - 1 + n + r + v;
        let mut all = Table::new(2 * count, terms + n + v);
        for place in 0..count {
            let (of_inputs, rest) = own.row(place).split_at(m);
            let (of_openings, rest) = rest.split_at(n);
            let (of_corrections, of_states) = rest.split_at(v);
            // What a change of each input and each opening takes from s by the states.
            let taken = |at: usize| -> f64 {
                of_states.iter().zip(&self.changes).map(|(phi, row)| phi * row[at]).sum()
            };
            let now = all.row_mut(place);
            now[..m].copy_from_slice(of_inputs);
            for at in 0..m - 1 {
                now[1 + at] -= taken(at);
                now[m + at] = taken(at);
            }
            for at in 0..n {
                now[2 * m - 1 + at] = taken(m - 1 + at);
                now[terms + at] = of_openings[at] - taken(m - 1 + at);
            }
            for (at, (phi, fading)) in of_states.iter().zip(&self.fading).enumerate() {
                now[2 * m - 1 + n + at] = fading * phi;
            }
            now[terms + n..].copy_from_slice(of_corrections);
            let old = all.row_mut(count + place);
            old[0] = of_inputs[0];
            old[m..2 * m - 1].copy_from_slice(&of_inputs[1..]);
            old[2 * m - 1..][..n].copy_from_slice(of_openings);
            old[2 * m - 1 + n..][..r].copy_from_slice(of_states);
            old[2 * m - 1 + n + r..terms].copy_from_slice(of_corrections);
        }
        all
    }
}

impl FormData<'_> {
    /// The form of a step with U = 1.
    ///
    /// # Errors
    /// As for [`FormData::form`].
    pub fn of_step(&self, of: &StepShapes, chain: Chain) -> Result<Found> {
        let Pieces { problem, patterns, .. } = self.columns.pieces;
        let (edges, functions) = (problem.ends.len(), Functions::of(problem));
        let residual = Residual::new(self.columns.pieces, &functions, self.released)?;
        let by_means = residual.of_cells(Of::Means)?;
        let [inputs, of_openings, states] = &of.means;
        let zeros = vec![vec![0.0; edges]; of.corrections];
        let all = inputs.iter().chain(of_openings).chain(&zeros).chain(states);
        let means = Table::of_columns(edges, all);
        let mut own = self.boundary_values(&chain, &functions, [inputs.len(), states.len()]);
        let fixed = chain.fixed(&functions, &by_means);
        // Nothing but a transfer law may hold a part: slopes leave a constant of s there.
        if complete(&by_means, &fixed, &means, &mut own).is_err() {
            let held = [&by_means[..], &of_robin(problem)].concat();
            complete(&held, &fixed, &means, &mut own).map_err(failed(&problem.scene))?;
        }
        let mut rows = residual.blocks()?;
        rows.extend(storage(problem, patterns, &functions));
        self.assembled(chain, &rows, (of.table(&own), functions), Some(by_means))
    }
}
