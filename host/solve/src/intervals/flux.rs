//! The flux over a part P of the boundary, and the force of contact.
//!
//! A continuous w that is 1 on P and 0 on the rest of C and D tells the flux of P from all others:
//! ```text
//!   ∫_P (σ − τ)·n = ∫ (σ − τ)·∇w − ∫ (f − f̄) w − ∫_N (g − ḡ) w + ∫_R (σ − τ)·n (1_P − w)
//!   |…| ≤ (‖A^½∇w‖² + ∫_R h (1_P − w)²)^½ · (error bound + oscillation)
//! ```
//! The w with the least norm solves a linear problem. Where P ends within C, no such w exists. There λ ≥ 0 helps: with w₁ ≤ 1_P ≤ w₂ on C
//! the force lies between ∫_C λ w₁ and ∫_C λ w₂. Where contact ends at D, only the lower of both exists.

use std::collections::BTreeMap;

use super::dual::{Data, Dual};
use super::part::Part;
use super::{Found, OutputBound, none};
use crate::certify::robin::robin;
use crate::problem::{EdgeKind, Problem, Sum};
use crate::quadrature::DATA_POINTS;
use crate::solve::Solution;
use signorini_kernel::Real;
use signorini_scene::error::Result;
use signorini_scene::scene::{Field, Quantity};

/// The interval; `reach` is how far σ and τ are from each other, with what data lose between their means.
pub(super) fn interval(
    problem: &Problem,
    solution: &Solution,
    part: &Part,
    quantity: Quantity,
    reach: f64,
) -> Result<Found> {
    let tau = &solution.certified.tau;
    let sums = || {
        let fluxes = || part.edges().map(|edge| tau[edge]);
        (fluxes().sum::<f64>(), fluxes().map(f64::abs).sum::<f64>())
    };
    let of = format!("the flux (A∇u)·n over {}", part.name());
    match part.kind() {
        None => none("its boundary has no edge"),
        Some(EdgeKind::Contact) => of_contact(problem, solution, part, quantity, reach),
        // It is given: τ has its means.
        Some(EdgeKind::Neumann) => {
            let (sum, terms) = sums();
            Ok(Ok(OutputBound::between(sum, sum, terms, of)))
        }
        Some(kind) => {
            let weight = match Weight::new(problem, part)? {
                Ok(weight) => weight,
                Err(why) => return Ok(Err(why)),
            };
            if kind == EdgeKind::Dirichlet
                && let Some(&vertex) = weight.shared.keys().next()
            {
                return Ok(Err(meets(problem, vertex)));
            }
            let (sum, terms) = sums();
            let width = reach * weight.norm(problem, part, 0.0)?;
            Ok(Ok(OutputBound::between(sum - width, sum + width, terms, of)))
        }
    }
}

fn meets(problem: &Problem, vertex: u32) -> String {
    let [x, y] = problem.mesh.vertices[vertex as usize];
    format!(
        "its boundary meets one with a given u at ({x}, {y}): no continuous weight tells their fluxes apart"
    )
}

fn of_contact(
    problem: &Problem,
    solution: &Solution,
    part: &Part,
    quantity: Quantity,
    reach: f64,
) -> Result<Found> {
    let weight = match Weight::new(problem, part)? {
        Ok(weight) => weight,
        Err(why) => return Ok(Err(why)),
    };
    if let Some((&vertex, _)) =
        weight.shared.iter().find(|(_, other)| **other == EdgeKind::Dirichlet)
    {
        return Ok(Err(meets(problem, vertex)));
    }
    let side = |edge: usize| Side::of(problem, edge);
    let sides = || contact_edges(problem).filter(|&edge| weight.on(problem, edge, 1.0) != [0.0; 2]);
    let Some(first) = part.edges().next().map(side) else {
        return none("its boundary has no edge");
    };
    if !weight.shared.is_empty() && sides().any(|edge| side(edge) != first) {
        return none("contact with a least flux meets contact without one");
    }
    let [mut least, mut most, mut terms] = [0.0; 3];
    for edge in sides() {
        let force = |shared| force(problem, solution, edge, weight.on(problem, edge, shared));
        let (low, high) = (force(0.0)?, force(1.0)?);
        (least, most) = (least + low[0], most + high[0]);
        terms += high[1];
    }
    least -= reach * weight.norm(problem, part, 0.0)?;
    most += reach * weight.norm(problem, part, 1.0)?;
    if quantity == Quantity::Force {
        let of = format!("the force ∫λ over {}", part.name());
        return Ok(Ok(OutputBound::between(least, most, terms, of)));
    }
    let mut base = 0.0;
    for edge in part.edges() {
        base += moment(problem, edge, [1.0; 2])?;
    }
    let of = format!("the flux (A∇u)·n over {}", part.name());
    let [least, most] = match first {
        Side::Least => [base + least, base + most],
        Side::Limit => [base - most, base - least],
    };
    Ok(Ok(OutputBound::between(least, most, terms + base.abs(), of)))
}

fn contact_edges(problem: &Problem) -> impl Iterator<Item = usize> {
    (0..problem.kinds.len()).filter(|&edge| problem.kinds[edge] == EdgeKind::Contact)
}

/// What λ is measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    /// λ = σ·n − flux
    Least,
    /// λ = limit − σ·n
    Limit,
}

impl Side {
    fn of(problem: &Problem, edge: usize) -> Self {
        let [least, _] = problem.loads.flux_range(edge - problem.topology.counts.free).ends();
        if least == f64::NEG_INFINITY { Self::Limit } else { Self::Least }
    }
}

/// ∫_E λ_τ w for w with these values at the ends of a contact edge, and the size of what it is summed from.
fn force(problem: &Problem, solution: &Solution, edge: usize, w: [f64; 2]) -> Result<[f64; 2]> {
    // τ·n is constant along the edge.
    let flux = solution.certified.tau[edge] * 0.5 * (w[0] + w[1]);
    let base = moment(problem, edge, w)?;
    let force = match Side::of(problem, edge) {
        Side::Least => flux - base,
        Side::Limit => base - flux,
    };
    Ok([force, flux.abs() + base.abs()])
}

/// ∫_E q w of a contact edge, q being what λ is measured from.
fn moment(problem: &Problem, edge: usize, w: [f64; 2]) -> Result<f64> {
    let field = match Side::of(problem, edge) {
        Side::Least => Field::Flux,
        Side::Limit => Field::Limit,
    };
    let Some(q) = Sum::on_edge(problem, edge, field, problem.time) else { return Ok(0.0) };
    if let Some(q) = q.constant() {
        return Ok(q * problem.lengths[edge] * 0.5 * (w[0] + w[1]));
    }
    let [a, b] = problem.segment(edge);
    let mut sum = 0.0;
    for &[t, weight] in f64::GAUSS[DATA_POINTS - 1] {
        let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
        sum += weight * q.finite(q.at(x, y), [x, y])? * (w[0] + t * (w[1] - w[0]));
    }
    Ok(sum * problem.lengths[edge])
}

/// A continuous function: 1 on P, 0 on the rest of C and D.
struct Weight {
    dual: Dual,
    vertices: Vec<f64>,
    /// Vertices that P shares with the rest of C or D, and which it is.
    shared: BTreeMap<u32, EdgeKind>,
}

impl Weight {
    fn new(problem: &Problem, part: &Part) -> Result<std::result::Result<Self, String>> {
        let given =
            |edge: usize| matches!(problem.kinds[edge], EdgeKind::Dirichlet | EdgeKind::Contact);
        let edges = || (0..problem.kinds.len()).filter(|&edge| given(edge));
        let is_held = edges().next().is_some() || problem.kinds.contains(&EdgeKind::Robin);
        if !is_held {
            return Ok(Err("nothing holds the domain".to_owned()));
        }
        let has_law = |at: usize| {
            use signorini_scene::scene::Condition::Neumann;
            !matches!(problem.scene.boundaries[at].condition, Neumann { .. })
        };
        let one = |at| if part.has_table(at) { 1.0 } else { 0.0 };
        let dual =
            Dual::solve(
                problem,
                |at| {
                    if has_law(at) { Data::Value(one(at)) } else { Data::Flux(0.0) }
                },
            )?;
        let mut vertices = dual.solution.certified.vertices.clone();
        let mut ends = BTreeMap::<u32, [Option<EdgeKind>; 2]>::new();
        for edge in edges() {
            for vertex in problem.ends[edge] {
                let kinds = ends.entry(vertex).or_default();
                let kind = &mut kinds[usize::from(!part.has(edge))];
                // D is the harder of two.
                if *kind != Some(EdgeKind::Dirichlet) {
                    *kind = Some(problem.kinds[edge]);
                }
            }
        }
        let mut shared = BTreeMap::new();
        for (vertex, [own, other]) in ends {
            vertices[vertex as usize] = if own.is_some() { 1.0 } else { 0.0 };
            if let (Some(_), Some(other)) = (own, other) {
                shared.insert(vertex, other);
            }
        }
        Ok(Ok(Self { dual, vertices, shared }))
    }

    /// Its values at the ends of an edge, where shared vertices have this one.
    fn on(&self, problem: &Problem, edge: usize, shared: f64) -> [f64; 2] {
        problem.ends[edge].map(|vertex| match self.shared.contains_key(&vertex) {
            true => shared,
            false => self.vertices[vertex as usize],
        })
    }

    /// (‖A^½∇w‖² + ∫_R h (1_P − w)²)^½
    fn norm(&self, problem: &Problem, part: &Part, shared: f64) -> Result<f64> {
        let mut vertices = self.vertices.clone();
        self.shared.keys().for_each(|&vertex| vertices[vertex as usize] = shared);
        let mut square = self.dual.norm(&vertices)?.powi(2);
        // (1 − w)² − w² = 1 − 2w on P.
        let transfer = robin(problem, problem.time)?;
        for (record, points) in problem.loads.robin.iter().zip(&transfer) {
            let edge = record.edge as usize;
            if !part.has(edge) {
                continue;
            }
            let [a, b] = problem.ends[edge].map(|vertex| vertices[vertex as usize]);
            for (&[t, weight], [h, _]) in f64::GAUSS[DATA_POINTS - 1].iter().zip(points) {
                square += weight * h * (1.0 - 2.0 * (a + t * (b - a)));
            }
        }
        Ok(square.max(0.0).sqrt())
    }
}
