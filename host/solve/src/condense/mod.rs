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
//! ```text
//!   patterns ─► columns ─► elimination (a field for each p_j and x_i) ─┬─► Ŝ, B̂, measures ─► Condensate
//!   chain (s on the boundary) ─┐                                       │                       ▲
//!   residual (rows of a cell) ─┴─► best (s inside) ─► factor, stability ◄──┘ ─► form ──────────────┘
//! ```
//! The bound of any (p, x), x ≥ 0, is U(osc + √(gap² + osc²)), osc = Σ|p_j| osc_j and
//! ```text
//!   gap² = (|F(p, x, d)| + stability |δ|)² + Σ_corners excess(p) r̂
//! ```
//! and that of u_h is U|J(p, x, d)| more, ‖A^½∇_h(s − u_h)‖; with the mended amounts δ and the corrections d of s that [`Form::correction`] chooses.

mod best;
mod chain;
mod columns;
mod elimination;
mod evaluate;
mod factor;
mod form;
mod functions;
mod measures;
mod order;
mod patterns;
mod points;
mod recovery;
mod residual;
mod rounding;
mod stability;
#[cfg(test)]
mod tests;
mod unit;

use std::collections::BTreeMap;

use faer::Mat;
use signorini_kernel::mesh::components::Support;

use crate::problem::{Parts, Problem};
use columns::columns;
use elimination::{Field, fields};
use form::FormData;
use measures::measures;
pub use order::along_boundary;
use patterns::patterns;
pub use recovery::{Recovery, recoverable};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::Scene;

/// A condensed model, in f64.
#[derive(Debug, Clone)]
pub struct CondensedModel {
    /// n, the number of contact edges; may be 0.
    pub contact: usize,
    /// The contact edge of each unknown, counted from the first contact edge of the mesh: they follow each other
    /// along the boundary.
    pub edges: Vec<usize>,
    /// m, the number of inputs with the constant 1, which comes first.
    pub inputs: usize,
    /// Ŝ, n × n, row by row: symmetric with a unit diagonal.
    pub matrix: Vec<f64>,
    /// d_i: the opening of edge i is d_i x_i, in the unit of u.
    pub opening: Vec<f64>,
    /// ∫_E (σ·n − q) of edge i is this times r̂_i.
    pub multiplier: Vec<f64>,
    /// The m columns of B̂, n numbers each.
    pub load: Vec<Vec<f64>>,
    /// The inputs' default values, the constant 1 first.
    pub defaults: Vec<f64>,
    /// The outputs in the order of the scene; without any declared, contact force and length.
    pub outputs: Vec<Measure>,
    /// The error bound, or a sentence why there is none.
    pub certificate: std::result::Result<Form, String>,
    /// U, in the unit of ‖A^½∇u‖.
    pub energy_unit: f64,
    /// The unknowns of each part that nothing else holds: Ŝ is singular there.
    pub held_by_contact: Vec<Vec<usize>>,
}

/// How an output follows from p and x.
#[derive(Debug, Clone, PartialEq)]
pub enum Measure {
    /// of_inputs·p + of_contact·x
    Linear {
        /// m factors.
        of_inputs: Vec<f64>,
        /// n factors.
        of_contact: Vec<f64>,
    },
    /// of_inputs·p + of_contact·x + Σ of_reaction max(r̂, 0) over the edges with x_i = 0: a force, and a flux
    /// through contact edges.
    Flux {
        /// m factors, or none.
        of_inputs: Vec<f64>,
        /// n factors, or none.
        of_contact: Vec<f64>,
        /// n factors, 0 where the edge does not count.
        of_reaction: Vec<f64>,
    },
    /// The sum over the edges with x_i = 0.
    Length {
        /// |E|, or 0 where the edge does not count.
        of_contact: Vec<f64>,
    },
    /// The error bound.
    Bound,
}

/// The certificate: all but `vertices` and `corners` in the unit U.
#[derive(Debug, Clone)]
pub struct Form {
    /// F by columns, column j with its j + 1 entries: m columns of p, n of x, one of d a vertex.
    pub factor: Vec<f64>,
    /// What rounding in f64 may hide of each column of F and J, those of d included.
    pub lost: Vec<f64>,
    /// J by columns in the same way, ‖A^½∇_h(s − u_h)‖ = U |J(p, x, d)|; nothing where F is never less.
    pub jump: Option<Vec<f64>>,
    /// The contact vertices that are not on D.
    pub vertices: Vec<Vertex>,
    /// What mending costs: ‖A^{−½} Σδ_i w_i‖ ≤ U stability |δ|.
    pub stability: f64,
    /// Where u_D lies above ψ beside contact.
    pub corners: Vec<Corner>,
    /// osc_j of each input alone, over U.
    pub oscillation: Vec<f64>,
    /// The unknowns of the one part that contact alone holds: what is mended there must leave through another edge of it.
    pub floating: Vec<usize>,
}

/// A contact vertex: where e = s − ψ comes from there.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertex {
    /// The two unknowns that e is interpolated from.
    pub edges: [usize; 2],
    /// e = U Σ weights · x\[edges\]
    pub weights: [f64; 2],
    /// The unknowns of the contact edges that meet here; the same one twice at an end.
    pub beside: [usize; 2],
}

/// A contact edge whose end is on D: it adds excess·r̂ to (gap/U)² where it is active.
#[derive(Debug, Clone, PartialEq)]
pub struct Corner {
    /// The unknown of that edge.
    pub edge: usize,
    /// (u_D − ψ)/d at that end as m factors of p.
    pub excess: Vec<f64>,
    /// What moving u_D there by d costs at most, in the unit of ‖A^½∇u‖ where that of U is 1.
    pub energy: f64,
}

/// Numbers that the fields behind a condensed model may hold together: 1.6 GB.
const MOST_NUMBERS: usize = 200_000_000;

/// Whether the fields of all contact edges and inputs fit into memory.
///
/// # Errors
/// More than 1.6 GB.
pub fn check_size(problem: &Problem) -> Result<()> {
    let counts = problem.topology.counts;
    let (contact, edges) = (counts.contact, counts.edges());
    let fields = contact + problem.scene.inputs.len() + 2;
    // u and σ·n of every field, and Ŝ.
    if fields.saturating_mul(2 * edges + contact) <= MOST_NUMBERS {
        return Ok(());
    }
    let message = format!(
        "boundary: {contact} contact edges on a mesh of {edges} edges are too many to condense, expected at \
         most {MOST_NUMBERS} numbers in their fields"
    );
    let hint = "refine less, or take the full model (--full, model = \"full\")";
    Err(InputError::new(message).file(&problem.scene.path).hint(hint).into())
}

/// Condenses `problem` for all values of its inputs; its own loads only decide whether there is a solution.
///
/// # Errors
/// A load that changes with t, data that are not finite, a part that nothing holds or a single contact edge,
/// a probe outside the mesh, more contact edges than memory holds fields of.
pub fn condense(problem: &Problem) -> Result<CondensedModel> {
    Ok(build(problem)?.0)
}

/// The condensate, and the fields behind it with s and τ of its certificate, in the columns of U = 1.
fn build(problem: &Problem) -> Result<(CondensedModel, Recovery)> {
    check_size(problem)?;
    let parts = examined(problem)?;
    let patterns = patterns(problem)?;
    let (m, n) = (patterns.len(), problem.topology.counts.contact);
    let edges = along_boundary(problem);
    let held_by_contact = held_by_contact(problem, &parts, &edges);
    if held_by_contact.iter().any(|part| part.len() == 1) {
        return Err(held_by_one(&problem.scene));
    }
    let alone = held_alone(problem, &parts, &edges);
    let mut fields = fields(problem, &columns(problem, &patterns, &edges, alone.as_deref()))?;
    let source = fields.split_off(m + n).pop();
    let opening = scaled(problem, &edges, &mut fields[m..])?;
    let matrix = matrix(problem, &edges, &fields[m..], &opening);
    let load = |field: &Field, q: &[f64]| condensed_load(problem, &edges, field, q, &opening);
    let mut condensate = CondensedModel {
        contact: n,
        edges: edges.clone(),
        inputs: m,
        matrix: (0..n * n).map(|at| matrix[(at / n, at % n)]).collect(),
        multiplier: opening.iter().map(|d| 1.0 / d).collect(),
        load: fields.iter().zip(&patterns).map(|(f, p)| load(f, &p.loads().contact_flux)).collect(),
        defaults: std::iter::once(1.0)
            .chain(problem.scene.inputs.iter().map(|i| i.default))
            .collect(),
        outputs: measures(problem, &edges, &opening, &patterns, &fields)?,
        certificate: Err(String::new()),
        energy_unit: 1.0,
        held_by_contact,
        opening: opening.clone(),
    };
    let ground = FormData {
        problem,
        parts: &parts,
        edges: &edges,
        patterns: &patterns,
        fields: &fields,
        openings: &opening,
        matrix: &matrix,
        source: source.as_ref().map(|field| (field, load(field, &vec![0.0; n]))),
        floating: condensate
            .held_by_contact
            .first()
            .filter(|_| source.is_some())
            .cloned()
            .unwrap_or_default(),
    };
    let (form, admissibles) = match ground.form()? {
        Ok((form, admissibles)) => (Ok(form), Some(admissibles)),
        Err(reason) => (Err(reason), None),
    };
    condensate.certificate = form;
    condensate.choose_unit();
    Ok((condensate, Recovery { fields, admissibles }))
}

fn examined(problem: &Problem) -> Result<Parts> {
    let parts = Parts::examine(problem)?;
    if parts.counts.floating == 0 {
        return Ok(parts);
    }
    let message = "boundary: a part of the domain has neither dirichlet, robin nor contact edges: its \
                   solution has no level, and its loads would have to stay in balance";
    let hint = "give it a dirichlet or robin boundary to condense it";
    Err(InputError::new(message).file(&problem.scene.path).hint(hint).into())
}

/// The cells of the one part that contact alone holds, where there is exactly one.
fn held_alone(problem: &Problem, parts: &Parts, edges: &[usize]) -> Option<Vec<bool>> {
    if parts.counts.contact != 1 {
        return None;
    }
    let topology = problem.topology.edges().ok()?;
    let free = problem.topology.counts.free;
    let of_edge = edges.iter().map(|edge| parts.of_edge(&topology, free + edge));
    let part = of_edge.into_iter().find(|&part| parts.support(part) == Support::Contact)?;
    Some((0..problem.cells()).map(|cell| parts.of_cell(cell) == part).collect())
}

/// d_i = 1/√S_ii, by which the fields of unit openings are multiplied.
fn scaled(problem: &Problem, edges: &[usize], fields: &mut [Field]) -> Result<Vec<f64>> {
    /// S_ii below this part of the fluxes around is the rounding of 0.
    const ROUNDING: f64 = 1e-11;
    let free = problem.topology.counts.free;
    let scale = |(edge, field): (&usize, &mut Field)| {
        let own = field.flux[free + edge];
        let most = field.flux.iter().fold(0.0, |most: f64, flux| most.max(flux.abs()));
        if own > ROUNDING * most {
            let opening = 1.0 / own.sqrt();
            field.scale(opening);
            return Ok(opening);
        }
        Err(held_by_one(&problem.scene))
    };
    edges.iter().zip(fields).map(scale).collect()
}

/// Constants cost no energy there: its diagonal entry is 0.
fn held_by_one(scene: &Scene) -> Error {
    let message = "boundary: a single contact edge holds a part of the domain";
    let hint = "refine the mesh along the contact boundary";
    InputError::new(message).file(&scene.path).hint(hint).into()
}

/// Ŝ from the fluxes of the scaled fields; rounding leaves them not quite symmetric.
fn matrix(problem: &Problem, edges: &[usize], fields: &[Field], openings: &[f64]) -> Mat<f64> {
    let free = problem.topology.counts.free;
    let entry = |i: usize, j: usize| openings[i] * fields[j].flux[free + edges[i]];
    Mat::from_fn(openings.len(), openings.len(), |i, j| {
        if i == j { 1.0 } else { 0.5 * (entry(i, j) + entry(j, i)) }
    })
}

/// −d_i ∫_E (σ·n − q)
fn condensed_load(
    problem: &Problem,
    edges: &[usize],
    field: &Field,
    q: &[f64],
    openings: &[f64],
) -> Vec<f64> {
    let fluxes = &field.flux[problem.topology.counts.free..];
    edges.iter().zip(openings).map(|(&edge, d)| d * (q[edge] - fluxes[edge])).collect()
}

/// Unknowns by the parts that they alone hold.
fn held_by_contact(problem: &Problem, parts: &Parts, edges: &[usize]) -> Vec<Vec<usize>> {
    let Ok(topology) = problem.topology.edges() else { return Vec::new() };
    let mut held = BTreeMap::<usize, Vec<usize>>::new();
    for (at, edge) in edges.iter().enumerate() {
        let part = parts.of_edge(&topology, problem.topology.counts.free + edge);
        if parts.support(part) == Support::Contact {
            held.entry(part).or_default().push(at);
        }
    }
    held.into_values().collect()
}
