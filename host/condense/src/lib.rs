//! Exact condensation: a scene whose mesh and A are fixed becomes a small dense problem on its contact
//! edges, good for all values of its inputs.
//!
//! Loads are linear in the inputs p = (1, p₁ … p_{m−1}). With the free unknowns eliminated, the openings
//! v = u_C − ψ (means over edges) and the residuals r = ∫_E (σ·n − q) meet
//! ```text
//!   v ≥ 0, r ≥ 0, v·r = 0:   x = v/d,  r̂ = r d/U² = Ŝx − B̂p,   d_i = U/√S_ii,
//! ```
//! where Ŝ has a unit diagonal and the energy unit U, a power of two, makes x and r̂ of order 1. Outputs are
//! linear in (p, x) but for the contact length, the error bound and what goes through contact edges: there
//! ∫_E (τ·n − q) = max(r, 0) where v = 0, and 0 where v > 0.
//!
//! Where fluxes have limits, x has either sign, and r̂ is at the least end of its range where x > 0, at the greatest where
//! x < 0, and between them where x = 0 (`ends`). Spans are linear in the inputs like loads (`ends`).
//!
//! ```text
//!   terms ───► columns ─► elimination (a field for each p_j and x_i) ─┬─► Ŝ, B̂, measures ─► CondensedModel
//!   chain (s on the boundary) ─┐                                       │                       ▲
//!   residual (rows of a cell) ─┴─► best (s inside) ─► factor, stability ◄──┘ ─► form ──────────────┘
//! ```
//! The bound of any (p, x), x ≥ 0, is U(osc + √(gap² + osc²)), osc = Σ|p_j| osc_j and
//! ```text
//!   gap² = (|F(p, x, d)| + stability |δ|)² + Σ_corners excess(p) r̂
//! ```
//! (with limits what `bound` says instead of the second term, and x on any side that there is)
//! and that of u_h is U|J(p, x, d)| more, ‖A^½∇_h(s − u_h)‖; with the mended amounts δ and the corrections d of s that `Form::correction` chooses.

mod balance;
mod best;
mod block;
mod bound;
mod chain;
mod elimination;
mod ends;
mod evaluate;
mod factor;
mod form;
mod held;
mod laws;
mod levels;
mod measures;
mod model;
mod modes;
mod order;
pub mod ranges;
mod recovery;
mod residual;
mod rounding;
mod settled;
mod steps;
#[cfg(test)]
mod tests;
mod unit;

use std::collections::BTreeSet;

use faer::Mat;

use balance::balances;
use elimination::{Field, FieldLoads, columns, fields};
use ends::{in_unknowns, spans};
use form::FormData;
use held::{held, held_by_one};
use laws::Laws;
use levels::ranges;
pub use model::{Balance, CondensedModel, Corner, Form, Measure, Vertex};
pub use modes::{LawsForm, LeftOut, ModalModel, modal};
pub use order::along_boundary;
pub use recovery::Recovery;
pub use settled::Settled;
use signorini_certify::TermData;
use signorini_certify::term::{condensed_terms, rooms_of};
use signorini_problem::{Approach, Parts, Problem};
use signorini_scene::error::Result;
pub use steps::{EvolutionForms, Memory, SteppedModel, settled, stepped};

/// Condenses `problem` for all values of its inputs; its own loads only decide whether there is a solution.
///
/// # Errors
/// What [`Approach::Condensation`] cannot treat; data that are not finite, a part that a single contact edge holds,
/// a probe outside the mesh.
pub fn condense(problem: &Problem) -> Result<CondensedModel> {
    Ok(recoverable(problem)?.0)
}

/// A condensate with the way back: the fields behind it, with s and τ of its certificate, in the columns of U = 1.
///
/// # Errors
/// As for [`condense`].
pub fn recoverable(problem: &Problem) -> Result<(CondensedModel, Recovery)> {
    Approach::Condensation.check(problem)?;
    let pieces = Pieces::new(problem)?;
    let fields = pieces.fields(Vec::new())?;
    pieces.model(fields)
}

/// Data of a condensed model before anything is eliminated.
struct Pieces<'p> {
    problem: &'p Problem,
    parts: Parts,
    patterns: Vec<TermData>,
    /// From base to other end, pattern by pattern and contact edge by contact edge.
    spans: Vec<Vec<f64>>,
    /// The contact edge of each unknown.
    edges: Vec<usize>,
    /// Contact edges that are no unknowns.
    settled: Settled,
    held_by_contact: Vec<Vec<usize>>,
    /// The cells of the one part that contact alone holds.
    alone: Option<Vec<bool>>,
    /// Transfer laws whose coefficient changes, where their fluxes are read off means of u.
    laws: Option<Laws>,
    /// By default the columns beyond the inputs of the scene have these factors, and 0 where they end.
    beyond: Vec<f64>,
    /// What s of a step in time is a sum of, where there is a bound.
    step: Option<steps::StepShapes>,
}

impl<'p> Pieces<'p> {
    fn new(problem: &'p Problem) -> Result<Self> {
        Self::with(problem, Settled::default())
    }

    /// Without these edges among the unknowns.
    fn with(problem: &'p Problem, settled: Settled) -> Result<Self> {
        let parts = Parts::examine(problem)?;
        problem.check_limits_within_ranges()?;
        let patterns = condensed_terms(problem)?;
        let spans = spans(&patterns);
        let mut edges = along_boundary(problem);
        edges.retain(|&edge| settled.keeps(edge));
        let (held_by_contact, alone) = held(problem, &parts, &edges);
        if held_by_contact.iter().any(|part| part.len() == 1) {
            return Err(held_by_one(&problem.scene));
        }
        let (laws, beyond) = (None, Vec::new());
        Ok(Self {
            problem,
            parts,
            patterns,
            spans,
            edges,
            settled,
            held_by_contact,
            alone,
            laws,
            beyond,
            step: None,
        })
    }

    /// Fields of the patterns, of unit openings, of those of edges that always touch, of the source where there is one, and of `more` loads.
    fn fields(&self, more: Vec<FieldLoads>) -> Result<Fields> {
        let Self { problem, patterns, edges, alone, settled, .. } = self;
        let opened = [&edges[..], &settled.touching].concat();
        let mut columns = columns(problem, patterns, &opened, alone.as_deref());
        let own = columns.len();
        columns.extend(more);
        let mut inputs = fields(problem, &columns, &settled.open)?;
        let more = inputs.split_off(own);
        let mut openings = inputs.split_off(patterns.len());
        let source = openings.split_off(opened.len()).pop();
        let touching = openings.split_off(edges.len());
        Ok(Fields { inputs, openings, touching, source, more })
    }

    fn model(&self, mut fields: Fields) -> Result<(CondensedModel, Recovery)> {
        let (mut model, matrix) = self.without_form(&mut fields)?;
        let Fields { inputs: mut columns, mut openings, touching, source, .. } = fields;
        columns.append(&mut openings);
        let (fields, opening) = (columns, model.opening.clone());
        let columns = Columns { pieces: self, fields: &fields, openings: &opening };
        model.outputs = columns.measures()?;
        let released = &BTreeSet::new();
        let (matrix, touching) = (&matrix, &touching[..]);
        let data = FormData { columns, matrix, source: source.as_ref(), touching, released };
        let (form, admissibles) = match data.form()? {
            Ok((form, admissibles)) => (Ok(form), Some(admissibles)),
            Err(reason) => (Err(reason), None),
        };
        model.certificate = form;
        model.choose_unit();
        Ok((model, Recovery { fields, admissibles }))
    }

    /// The model without outputs and bound, U being 1, and Ŝ; openings of the fields are scaled.
    fn without_form(&self, fields: &mut Fields) -> Result<(CondensedModel, Mat<f64>)> {
        let Self { problem, patterns, edges, .. } = self;
        let (m, n) = (patterns.len(), edges.len());
        let opening = self.scaled(&mut fields.openings)?;
        let matrix = self.matrix(&fields.openings, &opening);
        let load =
            |(field, p): (&Field, &TermData)| self.load(field, &p.loads().contact_flux, &opening);
        let defaults = problem.scene.inputs.iter().map(|input| input.default);
        let mut model = CondensedModel {
            contact: n,
            edges: edges.clone(),
            inputs: m,
            matrix: (0..n * n).map(|at| matrix[(at / n, at % n)]).collect(),
            multiplier: opening.iter().map(|d| 1.0 / d).collect(),
            load: fields.inputs.iter().zip(patterns).map(load).collect(),
            spans: in_unknowns(&self.spans, edges, &opening, m),
            limits: Vec::new(),
            defaults: std::iter::once(1.0).chain(defaults).collect(),
            // Amplitudes of modes are no inputs of the scene, nor is what a step begins from.
            ranges: ranges(problem, m),
            outputs: Vec::new(),
            certificate: Err(String::new()),
            energy_unit: 1.0,
            held_by_contact: self.held_by_contact.clone(),
            rooms: rooms_of(problem, patterns),
            balances: balances(problem, &self.parts, patterns, &self.spans)?,
            opening,
        };
        model.defaults.extend(&self.beyond);
        model.defaults.resize(m, 0.0);
        Ok((model, matrix))
    }

    /// d_i = 1/√S_ii, by which the fields of unit openings are multiplied.
    fn scaled(&self, fields: &mut [Field]) -> Result<Vec<f64>> {
        /// S_ii below this part of the fluxes around is the rounding of 0.
        const ROUNDING: f64 = 1e-11;
        let free = self.problem.topology.counts.free;
        let scale = |(edge, field): (&usize, &mut Field)| {
            let own = field.flux[free + edge];
            let most = field.flux.iter().fold(0.0, |most: f64, flux| most.max(flux.abs()));
            if own > ROUNDING * most {
                let opening = 1.0 / own.sqrt();
                field.scale(opening);
                return Ok(opening);
            }
            Err(held_by_one(&self.problem.scene))
        };
        self.edges.iter().zip(fields).map(scale).collect()
    }

    /// Ŝ from the fluxes of the scaled fields; rounding leaves them not quite symmetric.
    fn matrix(&self, fields: &[Field], openings: &[f64]) -> Mat<f64> {
        let free = self.problem.topology.counts.free;
        let entry = |i: usize, j: usize| openings[i] * fields[j].flux[free + self.edges[i]];
        Mat::from_fn(openings.len(), openings.len(), |i, j| {
            if i == j { 1.0 } else { 0.5 * (entry(i, j) + entry(j, i)) }
        })
    }

    /// −d_i ∫_E (σ·n − q)
    fn load(&self, field: &Field, q: &[f64], openings: &[f64]) -> Vec<f64> {
        let fluxes = &field.flux[self.problem.topology.counts.free..];
        self.edges.iter().zip(openings).map(|(&edge, d)| d * (q[edge] - fluxes[edge])).collect()
    }
}

/// The fields of all columns.
struct Fields {
    inputs: Vec<Field>,
    openings: Vec<Field>,
    touching: Vec<Field>,
    source: Option<Field>,
    more: Vec<Field>,
}

/// Columns that a model is read off, its unknowns being scaled.
#[derive(Clone, Copy)]
struct Columns<'c> {
    pieces: &'c Pieces<'c>,
    /// Columns of p, then those of x.
    fields: &'c [Field],
    /// d_i where U = 1.
    openings: &'c [f64],
}
