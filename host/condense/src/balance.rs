//! Loads that the fluxes of a part which contact alone holds have to balance, pattern by pattern.
//!
//! ```text
//!   Σ_e b_e(p) = Σ_j p_j Σ_e b_ej        b_ej the load of pattern j on edge e of the part, from its cells and its boundary
//! ```
//! Gaps add nothing: the rows of K sum up to 0. The base of a contact flux is in b; to the other end it is a span.

use signorini_kernel::assembly;
use signorini_kernel::mesh::components::Support;

use super::ends::{is_from_above, is_varying};
use super::model::Balance;
use signorini_certify::TermData;
use signorini_problem::{Parts, Problem};
use signorini_scene::error::{Error, Result};

/// The balance of each part that contact alone holds; `spans` lead from the base of each contact edge's flux to its other
/// end, pattern by pattern, and are nothing at all where all are ∞.
///
/// # Errors
/// Loads that do not fit the mesh.
pub(super) fn balances(
    problem: &Problem,
    parts: &Parts,
    patterns: &[TermData],
    spans: &[Vec<f64>],
) -> Result<Vec<Balance>> {
    if parts.counts.contact == 0 {
        return Ok(Vec::new());
    }
    let topology = problem.topology.edges().map_err(unposed)?;
    let part_of: Vec<usize> =
        (0..problem.topology.counts.edges()).map(|edge| parts.of_edge(&topology, edge)).collect();
    let loads: Vec<Vec<f64>> = patterns.iter().map(of_pattern).collect::<Result<_>>()?;
    let held = parts.roots().filter(|&part| parts.support(part) == Support::Contact);
    let free = problem.topology.counts.free;
    let balance = |part: usize| {
        let own: Vec<usize> = (0..part_of.len()).filter(|&edge| part_of[edge] == part).collect();
        let contact = own.iter().filter_map(|edge| edge.checked_sub(free)).collect();
        of_part(part, &own, contact, &loads, spans)
    };
    Ok(held.map(balance).collect())
}

/// The load of one pattern on every edge.
fn of_pattern(pattern: &TermData) -> Result<Vec<f64>> {
    let topology = pattern.problem.topology.edges().map_err(unposed)?;
    let loads = pattern.loads();
    let boundary = loads.boundary(&topology).map_err(unposed)?;
    let mut load = vec![0.0; topology.counts().unknowns()];
    assembly::load(&topology, loads.cells(), &boundary, &mut load).map_err(unposed)?;
    Ok(load)
}

fn of_part(
    cell: usize,
    own: &[usize],
    contact: Vec<usize>,
    loads: &[Vec<f64>],
    spans: &[Vec<f64>],
) -> Balance {
    let sum = |of: &dyn Fn(f64) -> f64| -> Vec<f64> {
        loads.iter().map(|load| own.iter().map(|&edge| of(load[edge])).sum()).collect()
    };
    let (least, mut size) = (sum(&|load| load), sum(&f64::abs));
    let mut ends = [least.clone(), least];
    let is_varying = is_varying(spans);
    for edge in contact {
        let constant = spans.first().map_or(f64::INFINITY, |spans| spans[edge]);
        let [least, greatest] = &mut ends;
        let end = if is_from_above(constant, is_varying) { least } else { greatest };
        end[0] += constant;
        size[0] += if constant.is_finite() { constant.abs() } else { 0.0 };
        for (j, spans) in spans.iter().enumerate().skip(1) {
            end[j] += spans[edge];
            size[j] += spans[edge].abs();
        }
    }
    let [least, greatest] = ends.map(|end| if end[0].is_finite() { end } else { Vec::new() });
    Balance { cell, least, greatest, size }
}

/// Loads of the scene's own mesh: an error here is none of the scene.
fn unposed(error: signorini_kernel::Error) -> Error {
    Error::Check(format!("loads of a condensed model: {error}"))
}
