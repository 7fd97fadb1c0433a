//! Whether the level of a part that contact with two ends alone holds is the only one.
//!
//! Loads strictly between both ends leave a solution, and more than one where no edge holds on to the gap: u + c solves what
//! u does, as long as no edge changes its side of the law,
//! ```text
//!   up:    c ≤ ψ − u on edges below the gap, 0 at the gap unless the flux is at its lower end
//!   down:  c ≤ u − ψ on edges above the gap, 0 at the gap unless the flux is at its upper end
//! ```
//! and without a limit on edges whose ends are equal. Of both, what rounding may leave is not counted.

use signorini_kernel::mesh::components::Support;

use super::{Solution, unfit};
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;

/// Roundings of the largest flux, or of the largest number of a part, that count as none.
const ROUNDINGS: f64 = 256.0;

/// How far the level of a part may move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeLevel {
    /// A point of the part.
    pub near: [f64; 2],
    /// By how much u may be lower everywhere on the part, and by how much higher.
    pub by: [f64; 2],
}

impl FreeLevel {
    /// The sentence for people.
    pub fn sentence(&self) -> String {
        let ([x, y], [down, up]) = (self.near, self.by.map(rounded));
        format!(
            "more than one solution: u may be lower by up to {down} or higher by up to {up} throughout the connected part \
             of the mesh around ({x}, {y}), with the same flux. Contact with limits alone holds it, and nothing touches; a \
             Dirichlet or Robin boundary, or gaps that do not leave room between them, decide on the level"
        )
    }
}

/// To six digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// The parts of a converged solution whose level may move.
///
/// # Errors
/// Those of [`Parts::examine`].
pub fn free_levels(problem: &Problem, solution: &Solution) -> Result<Vec<FreeLevel>> {
    if let Some((problem, own)) = solution.in_its_units() {
        let unit = solution.units.u;
        let in_scene = |of: FreeLevel| FreeLevel { by: of.by.map(|by| by * unit), ..of };
        return Ok(free_levels(problem, own)?.into_iter().map(in_scene).collect());
    }
    if problem.loads.spans.is_empty() || solution.parts.contact == 0 || !solution.converged() {
        return Ok(Vec::new());
    }
    let parts = Parts::examine(problem)?;
    let held_by_contact = parts.roots().filter(|&part| parts.support(part) == Support::Contact);
    let unfit = unfit::<f64>(&problem.scene);
    let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
    let system = assembled.system().map_err(&unfit)?;
    let rows = system.matrix().iter().enumerate();
    let own = rows.map(|(i, row)| row.entries().find(|(column, _)| *column == i));
    let diagonal: Vec<f64> = own.map(|own| own.map_or(0.0, |(_, value)| value)).collect();
    let found = held_by_contact.map(|part| free_level(problem, solution, &parts, &diagonal, part));
    Ok(found.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
}

fn free_level(
    problem: &Problem,
    solution: &Solution,
    parts: &Parts,
    diagonal: &[f64],
    part: usize,
) -> Result<Option<FreeLevel>> {
    let counts = problem.topology.counts;
    let edges = problem.topology.edges().map_err(unfit::<f64>(&problem.scene))?;
    let own = (0..counts.contact).filter(|&at| parts.of_edge(&edges, counts.free + at) == part);
    let rounding = ROUNDINGS * solution.scalar.epsilon() + 10.0 * solution.algebraic_residual;
    let size = |at: usize| solution.u[counts.free + at].abs().max(problem.loads.gap[at].abs());
    let largest = own.clone().map(size).fold(0.0, f64::max);
    let (mut by, mut near) = ([f64::INFINITY; 2], [0.0; 2]);
    for at in own {
        let edge = counts.free + at;
        let opening = solution.u[edge] - solution.gap(problem, at);
        // A flux is a sum of K u, which may be large beside it.
        let terms = solution.largest_flux().max(diagonal[edge] * largest);
        let room = room(problem, solution.flux[edge], opening, at, rounding * terms);
        by = [by[0].min(room[0]), by[1].min(room[1])];
        near = problem.segment(edge)[0];
    }
    let moves = by.iter().sum::<f64>() > rounding * largest && by.iter().all(|by| by.is_finite());
    Ok(moves.then_some(FreeLevel { near, by }))
}

/// How far contact edge `at` lets the level go down and up.
fn room(problem: &Problem, flux: f64, opening: f64, at: usize, rounding: f64) -> [f64; 2] {
    let [least, most] = problem.loads.flux_range(at).ends();
    let ends = [most, least];
    // Down to the gap from above, on from there where the flux is the upper end already; likewise up.
    [0, 1].map(|way| {
        let towards_gap = if way == 0 { opening } else { -opening };
        match () {
            () if most - least <= rounding => f64::INFINITY,
            () if towards_gap > 0.0 => towards_gap,
            () if towards_gap < 0.0 || (flux - ends[way]).abs() <= rounding => f64::INFINITY,
            () => 0.0,
        }
    })
}
