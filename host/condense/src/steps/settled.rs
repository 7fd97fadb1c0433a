//! Contact edges that no step puts on another side are taken out of a model of steps, once it is proved of that model itself.
//!
//! Sides of exact steps are what is tried. Openings of the edges that are left may be a little more than exact steps make them, and
//! a tick keeps them within that. What the bound asks for of the others is then proved for any of them, by [`super::proof`].

use std::collections::BTreeMap;

use super::super::ranges::sides::{EdgeSide, Sides};
use super::super::{Pieces, Recovery, Settled};
use super::proof::Proof;
use super::{SteppedModel, with_settled};
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::Result;

/// How much more than exact steps an opening may reach.
const ROOM: f64 = 1.125;

/// The part of all edges below which nothing is gained.
const WORTH: usize = 4;

/// How often edges that fail are kept and the others tried again.
const TRIALS: usize = 3;

/// The model of `whole` without the edges that `sides` proves for exact steps, with its way back; nothing where that is not proved of the
/// model, or where too few would go.
///
/// # Errors
/// As for [`super::stepped`].
pub fn settled(
    problem: &Problem,
    whole: &SteppedModel,
    sides: &Sides,
    memory: Option<usize>,
) -> Result<Option<(SteppedModel, Recovery)>> {
    let Some(enclosure) = sides.enclosure.as_ref().filter(|_| !whole.model.is_limited()) else {
        return Ok(None);
    };
    if whole.model.certificate.is_err() {
        return Ok(None);
    }
    let pieces = Pieces::new(problem)?;
    let mut kept = needed(&pieces, &whole.model.edges, sides);
    let reach = |at: usize| {
        let [lo, hi] = [enclosure.lo[at].max(0.0) / ROOM, ROOM * enclosure.hi[at]];
        let [lo, hi] = match sides.of[at] {
            EdgeSide::Open => [lo, hi],
            EdgeSide::Touching => [0.0; 2],
            EdgeSide::MayChange | EdgeSide::Saturated => [0.0, hi],
        };
        [lo, hi].map(|x| x * whole.model.opening[at])
    };
    let reach: BTreeMap<usize, [f64; 2]> =
        whole.model.edges.iter().enumerate().map(|(at, &edge)| (edge, reach(at))).collect();
    for _ in 0..TRIALS {
        let is_out = |side| {
            let edges = whole.model.edges.iter().zip(&sides.of).zip(&kept);
            edges
                .filter(|((_, of), kept)| **of == side && !**kept)
                .map(|((&edge, _), _)| edge)
                .collect()
        };
        let out = Settled { open: is_out(EdgeSide::Open), touching: is_out(EdgeSide::Touching) };
        if WORTH * out.count() < whole.model.contact {
            break;
        }
        let (mut of, recovery) = with_settled(problem, memory, out)?;
        let limit = |(edge, opening): (&usize, &f64)| reach[edge].map(|v| v / opening);
        of.model.limits = of.model.edges.iter().zip(&of.model.opening).map(limit).collect();
        let Some(proof) = Proof::new(&of, &recovery) else { break };
        let failed = proof.failed(problem, &pieces.patterns);
        if failed.is_empty() {
            return Ok(Some((of, recovery)));
        }
        for (edge, kept) in whole.model.edges.iter().zip(&mut kept) {
            *kept |= failed.contains(edge);
        }
    }
    Ok(None)
}

/// Which unknowns have to stay: those that may change and their neighbours, and where s is not ψ for sure.
fn needed(pieces: &Pieces, edges: &[usize], sides: &Sides) -> Vec<bool> {
    let Pieces { problem, patterns, .. } = pieces;
    let counts = problem.topology.counts;
    let ends = |edge: usize| problem.ends[counts.free + edge];
    let mut at_vertex = BTreeMap::<u32, Vec<usize>>::new();
    for (at, &edge) in edges.iter().enumerate() {
        ends(edge).iter().for_each(|&vertex| at_vertex.entry(vertex).or_default().push(at));
    }
    let psi = |at: usize, vertex: u32| -> Vec<f64> {
        let end = usize::from(ends(edges[at])[1] == vertex);
        patterns.iter().map(|pattern| pattern.ends.gap[edges[at]][end]).collect()
    };
    let given: Vec<u32> = (0..problem.kinds.len())
        .filter(|&edge| problem.kinds[edge] == EdgeKind::Dirichlet)
        .flat_map(|edge| problem.ends[edge])
        .collect();
    let mut kept: Vec<bool> = sides.of.iter().map(|of| *of == EdgeSide::MayChange).collect();
    let may_change = kept.clone();
    for (vertex, here) in &at_vertex {
        let is_one = here.iter().all(|&at| psi(at, *vertex) == psi(here[0], *vertex));
        let is_needed = !is_one || given.contains(vertex) || here.iter().any(|&at| may_change[at]);
        here.iter().for_each(|&at| kept[at] |= is_needed);
    }
    // What is kept beside nothing that may change has a neighbour on either side, which tells s between them.
    let is_beside = |at: usize| {
        let ends = ends(edges[at]);
        ends.iter().any(|vertex| at_vertex[vertex].iter().any(|&other| may_change[other]))
    };
    let alone: Vec<bool> = (0..kept.len()).map(|at| kept[at] && !is_beside(at)).collect();
    for here in at_vertex.values().filter(|here| here.iter().any(|&at| alone[at])) {
        here.iter().for_each(|&at| kept[at] = true);
    }
    kept
}
