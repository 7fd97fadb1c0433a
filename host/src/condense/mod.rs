//! Exact condensation: a scene whose mesh and A are fixed becomes a small dense problem on its contact
//! edges, good for all values of its inputs.
//!
//! Loads are linear in the inputs p = (1, p₁ … p_{m−1}). With the free unknowns eliminated, the openings
//! v = u_C − ψ (means over edges) and the residuals r = ∫_E (σ·n − q) meet
//! ```text
//!   v ≥ 0, r ≥ 0, v·r = 0:   x = v/d,  r̂ = r d/U² = Ŝx − B̂p,   d_i = U/√S_ii,
//! ```
//! where Ŝ has a unit diagonal and the energy unit U, a power of two, makes x and r̂ of order 1. Every
//! output is linear in (p, x) but the contact length and the error bound.
//!
//! ```text
//!   patterns ─► elimination (a field for each p_j and x_i) ─┬─► Ŝ, B̂, outputs ──────────► Condensate
//!   chain (s on the boundary) ─┐                            │                                 ▲
//!   residual (rows of a cell) ─┴─► best (s inside) ─► factor, reach ─► form ──────────────────┘
//! ```
//! The bound of any (p, x), x ≥ 0, is U(osc + √(gap² + osc²)), osc = Σ|p_j| osc_j and
//! ```text
//!   gap² = (|F(p, x, d)| + reach |δ|)² + Σ_corners excess(p) r̂
//! ```
//! with the mended amounts δ and the corrections d of s that [`Form::correction`] chooses.

mod best;
mod chain;
mod elimination;
mod evaluate;
mod factor;
mod form;
mod patterns;
mod reach;
mod residual;
#[cfg(test)]
mod tests;
mod unit;

use std::collections::BTreeMap;

use faer::Mat;
use signorini_kernel::components::Support;
use signorini_kernel::geometry::{quad_area, triangle_area};

use crate::error::{InputError, Result};
use crate::outputs::{Functional, contact_edges};
use crate::problem::{Loads, Parts, Problem};
use crate::scene::{Located, Output, Quantity, Scene};
use elimination::{Field, Given, fields};
use form::{Admissibles, Ground};
use patterns::{Pattern, patterns};

/// A condensed model, in f64.
#[derive(Debug, Clone)]
pub struct Condensate {
    /// n, the number of contact edges; may be 0.
    pub contact: usize,
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
    /// The contact edges of each part that nothing else holds: Ŝ is singular there.
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
    /// The contact vertices that are not on D.
    pub vertices: Vec<Vertex>,
    /// What mending costs: ‖A^{−½} Σδ_i w_i‖ ≤ U reach |δ|.
    pub reach: f64,
    /// Where u_D lies above ψ beside contact.
    pub corners: Vec<Corner>,
    /// osc_j of each input alone, over U.
    pub oscillation: Vec<f64>,
    /// Contact alone holds the only part there is: mended amounts must leave through another edge.
    pub floating: bool,
}

/// A contact vertex: where e = s − ψ comes from there.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertex {
    /// The two edges (counted from the first contact edge) that e is interpolated from.
    pub edges: [usize; 2],
    /// e = U Σ weights · x\[edges\]
    pub weights: [f64; 2],
    /// The contact edges that meet here; the same one twice at an end.
    pub beside: [usize; 2],
}

/// A contact edge whose end is on D: it adds excess·r̂ to (gap/U)² where it is active.
#[derive(Debug, Clone, PartialEq)]
pub struct Corner {
    /// The edge, counted from the first contact edge.
    pub edge: usize,
    /// (u_D − ψ)/d at that end as m factors of p.
    pub excess: Vec<f64>,
}

/// Condenses `scene` on the mesh of `problem`; of the problem's loads nothing is used.
///
/// # Errors
/// A load that changes with t, data that are not finite, a part that nothing holds, a probe outside the
/// mesh.
pub fn condense(scene: &Scene, problem: &Problem) -> Result<Condensate> {
    Ok(build(scene, problem)?.0)
}

/// The condensate, and s and τ of its certificate in the columns of F before they were scaled by U.
fn build(scene: &Scene, problem: &Problem) -> Result<(Condensate, Option<Admissibles>)> {
    let parts = examined(scene, problem)?;
    let patterns = patterns(scene, problem)?;
    let (m, n) = (patterns.len(), problem.topology.counts.contact);
    let alone = parts.counts.contact == 1 && parts.counts.held == 0;
    let mut fields = fields(scene, problem, &columns(problem, &patterns, alone))?;
    let source = fields.split_off(m + n).pop();
    let opening = scaled(scene, problem, &mut fields[m..])?;
    let matrix = matrix(problem, &fields[m..], &opening);
    let load = |field: &Field, q: &[f64]| condensed_load(problem, field, q, &opening);
    let mut condensate = Condensate {
        contact: n,
        inputs: m,
        matrix: (0..n * n).map(|at| matrix[(at / n, at % n)]).collect(),
        multiplier: opening.iter().map(|d| 1.0 / d).collect(),
        load: fields.iter().zip(&patterns).map(|(f, p)| load(f, &p.loads.contact_flux)).collect(),
        defaults: std::iter::once(1.0).chain(scene.inputs.iter().map(|i| i.default)).collect(),
        outputs: measures(scene, problem, &patterns, &fields)?,
        certificate: Err(String::new()),
        energy_unit: 1.0,
        held_by_contact: held_by_contact(problem, &parts, n),
        opening: opening.clone(),
    };
    let ground = Ground {
        scene,
        problem,
        parts: &parts,
        patterns: &patterns,
        fields: &fields,
        openings: &opening,
        matrix: &matrix,
        source: source.as_ref().map(|field| (field, load(field, &vec![0.0; n]))),
    };
    let (form, admissibles) = match ground.form()? {
        Ok((form, admissibles)) => (Ok(form), Some(admissibles)),
        Err(reason) => (Err(reason), None),
    };
    condensate.certificate = form;
    condensate.choose_unit();
    Ok((condensate, admissibles))
}

fn examined(scene: &Scene, problem: &Problem) -> Result<Parts> {
    let parts = Parts::examine(scene, problem)?;
    if parts.counts.floating == 0 {
        return Ok(parts);
    }
    let message = "boundary: a part of the domain has neither dirichlet, robin nor contact edges: its \
                   solution has no level, and its loads would have to stay in balance";
    let hint = "give it a dirichlet or robin boundary to condense it";
    Err(InputError::new(message).file(&scene.path).hint(hint).into())
}

/// What each column is the field of: patterns without opening, unit openings without load, and a source
/// that adds up to 1 where asked for.
fn columns(problem: &Problem, patterns: &[Pattern], source: bool) -> Vec<Given> {
    let counts = problem.topology.counts;
    let of_patterns = patterns
        .iter()
        .map(|pattern| Given { contact: pattern.loads.gap.clone(), loads: pattern.loads.clone() });
    let mut columns: Vec<_> = of_patterns.collect();
    let mut silent = Loads {
        robin: problem.loads.robin.clone(),
        contact_flux: vec![0.0; counts.contact],
        gap: vec![0.0; counts.contact],
        dirichlet: vec![0.0; counts.dirichlet],
        ..Loads::default()
    };
    silent.robin.iter_mut().for_each(|record| record.ambient = 0.0);
    for opened in 0..counts.contact {
        let mut contact = vec![0.0; counts.contact];
        contact[opened] = 1.0;
        columns.push(Given { loads: silent.clone(), contact });
    }
    if source {
        let contact = vec![0.0; counts.contact];
        columns.push(Given { loads: uniform_source(problem, silent), contact });
    }
    columns
}

/// `silent` with a source that adds up to 1, the same all over the mesh.
fn uniform_source(problem: &Problem, silent: Loads) -> Loads {
    let mesh = &problem.mesh;
    let corner = |vertex: u32| mesh.vertices[vertex as usize];
    let triangles: Vec<f64> =
        mesh.triangles.iter().map(|cell| triangle_area(cell.map(corner))).collect();
    let quads: Vec<f64> = mesh.quads.iter().map(|cell| quad_area(cell.map(corner))).collect();
    let whole: f64 = triangles.iter().chain(&quads).sum();
    let share = |areas: Vec<f64>| areas.into_iter().map(|area| area / whole).collect();
    Loads { triangles: share(triangles), quads: share(quads), ..silent }
}

/// d_i = 1/√S_ii, by which the fields of unit openings are multiplied.
fn scaled(scene: &Scene, problem: &Problem, fields: &mut [Field]) -> Result<Vec<f64>> {
    /// S_ii below this part of the fluxes around is the rounding of 0.
    const ROUNDING: f64 = 1e-11;
    let free = problem.topology.counts.free;
    let scale = |(at, field): (usize, &mut Field)| {
        let own = field.flux[free + at];
        let most = field.flux.iter().fold(0.0, |most: f64, flux| most.max(flux.abs()));
        if own > ROUNDING * most {
            let opening = 1.0 / own.sqrt();
            field.scale(opening);
            return Ok(opening);
        }
        let message = "boundary: a single contact edge holds a part of the domain";
        let hint = "refine the mesh along the contact boundary";
        Err(InputError::new(message).file(&scene.path).hint(hint).into())
    };
    fields.iter_mut().enumerate().map(scale).collect()
}

/// Ŝ from the fluxes of the scaled fields; rounding leaves them not quite symmetric.
fn matrix(problem: &Problem, fields: &[Field], openings: &[f64]) -> Mat<f64> {
    let free = problem.topology.counts.free;
    let entry = |i: usize, j: usize| openings[i] * fields[j].flux[free + i];
    Mat::from_fn(openings.len(), openings.len(), |i, j| {
        if i == j { 1.0 } else { 0.5 * (entry(i, j) + entry(j, i)) }
    })
}

/// −d_i ∫_E (σ·n − q)
fn condensed_load(problem: &Problem, field: &Field, q: &[f64], openings: &[f64]) -> Vec<f64> {
    let fluxes = &field.flux[problem.topology.counts.free..];
    openings.iter().zip(fluxes.iter().zip(q)).map(|(d, (flux, q))| d * (q - flux)).collect()
}

fn measures(
    scene: &Scene,
    problem: &Problem,
    patterns: &[Pattern],
    fields: &[Field],
) -> Result<Vec<Measure>> {
    let undeclared = [Quantity::Force, Quantity::Length].map(|quantity| Output {
        name: Located { value: String::new(), key: "output".to_owned(), span: 0..0 },
        quantity,
        of: None,
    });
    let outputs = if scene.outputs.is_empty() { &undeclared[..] } else { &scene.outputs };
    outputs.iter().map(|output| measure(scene, problem, patterns, fields, output)).collect()
}

fn measure(
    scene: &Scene,
    problem: &Problem,
    patterns: &[Pattern],
    fields: &[Field],
    output: &Output,
) -> Result<Measure> {
    let free = problem.topology.counts.free;
    let Some(functional) = Functional::of(scene, problem, output)? else {
        if output.quantity == Quantity::Bound {
            return Ok(Measure::Bound);
        }
        let mut of_contact = vec![0.0; problem.topology.counts.contact];
        for edge in contact_edges(scene, problem, output) {
            of_contact[edge - free] = problem.lengths[edge];
        }
        return Ok(Measure::Length { of_contact });
    };
    let silent =
        Loads { contact_flux: vec![0.0; problem.topology.counts.contact], ..Loads::default() };
    let loads = patterns.iter().map(|pattern| &pattern.loads).chain(std::iter::repeat(&silent));
    let values = fields.iter().zip(loads);
    let mut of_inputs: Vec<f64> =
        values.map(|(field, loads)| functional.at(problem, loads, &field.u, &field.flux)).collect();
    let of_contact = of_inputs.split_off(patterns.len());
    Ok(Measure::Linear { of_inputs, of_contact })
}

/// Contact edges by the parts that they alone hold.
fn held_by_contact(problem: &Problem, parts: &Parts, contact: usize) -> Vec<Vec<usize>> {
    let Ok(edges) = problem.topology.edges() else { return Vec::new() };
    let mut held = BTreeMap::<usize, Vec<usize>>::new();
    for at in 0..contact {
        let part = parts.of_edge(&edges, problem.topology.counts.free + at);
        if parts.support(part) == Support::Contact {
            held.entry(part).or_default().push(at);
        }
    }
    held.into_values().collect()
}
