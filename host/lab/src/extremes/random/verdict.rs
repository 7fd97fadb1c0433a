//! The promises that an answer breaks.

use std::iter;

use super::attempt::Attempt;
use super::case::{RandomCase, Way};
use super::measure::{IDENTITY, Measured};
use super::outputs::Intervals;
use super::residual::{ends, residual};
use crate::extremes::judge::{Answered, INTEGRATED, Verdict};
use crate::extremes::measure::{self, Reference};
use signorini_kernel::solver::Status;
use signorini_problem::Problem;
use signorini_scene::Result;
use signorini_solve::{Ending, Ran, ScalarKind};

/// Tolerance of a converged solve in f64, with what the check itself may be off.
const CONVERGED: f64 = 1.01e-13;
/// Roundings of the residual that a solve may leave which rounding ended.
const LIMIT: f64 = 64.0;
/// Roundings that a sum of forces may be off.
const FORCE: f64 = 16.0;
/// Part of a load up to which the place of a jump of q inside an edge is known: edges are halved 40 times at most, and the
/// patterns of the inputs each on their own.
const JUMP: f64 = 1.0 / (1_u64 << 38) as f64;

/// Something that was promised and is not so.
#[derive(Debug, Clone, PartialEq)]
pub struct Broken {
    pub what: &'static str,
    pub words: String,
}

fn broken(what: &'static str, words: String) -> Option<Broken> {
    Some(Broken { what, words })
}

pub fn broken_by(case: &RandomCase, attempt: &Attempt, measured: Option<&Measured>) -> Vec<Broken> {
    let by_measure = measured.map(|found| {
        let Measured { bound, combined, of_u, .. } = found;
        let [least, least_of_u] = found.least();
        let combined = format!("combined {combined:.6e}");
        let of_u = format!("of u_h {of_u:.6e}");
        [
            above(found, "bound", least, combined, bound.total),
            above(found, "of_u", least_of_u, of_u, bound.of_u),
            identity(case, found),
            outputs(found),
        ]
    });
    let others = [status(case, attempt), forces(case, attempt)];
    by_measure.into_iter().flatten().chain(others).flatten().collect()
}

/// combined ≤ total + total′, and ‖A^½∇_h(s′ − u_h)‖ ≤ of_u + total′.
fn above(
    found: &Measured,
    what: &'static str,
    least: f64,
    distance: String,
    own: f64,
) -> Option<Broken> {
    let is_within = least <= (own + found.total) * (1.0 + INTEGRATED);
    let words = || format!("{distance}, bounds {own:.6e} + {:.6e}", found.total);
    (!is_within).then(|| Broken { what, words: words() })
}

/// The value of every output is in its interval.
fn outputs(found: &Measured) -> Option<Broken> {
    let Intervals { worst, name, .. } = &found.intervals;
    if *worst <= 1.0 + INTEGRATED {
        return None;
    }
    broken("output", format!("{name}: {worst:.6} half-widths off"))
}

/// The gap of the bound is what its terms in the exact solution add up to, in f64.
fn identity(case: &RandomCase, found: &Measured) -> Option<Broken> {
    let off = found.identity_off().filter(|_| case.effort.scalar == ScalarKind::F64)?;
    if off <= IDENTITY {
        return None;
    }
    let (gap, [identity, _]) = (found.bound.duality_gap, found.identity?);
    broken("identity", format!("gap {gap:.6e}, identity {identity:.6e}"))
}

/// Converged means converged.
fn status(case: &RandomCase, attempt: &Attempt) -> Option<Broken> {
    let asked = matches!(case.effort.way, Way::Sweeps | Way::Direct);
    if !asked || !attempt.answer.converged() || case.effort.scalar != ScalarKind::F64 {
        return None;
    }
    let found = residual(&attempt.problem, &attempt.answer.u).ok()?;
    let by_tolerance = attempt.answer.status == Ending::Solve(Status::Converged)
        && attempt.answer.ran != Ran::Direct;
    let most = LIMIT * found.rounding + if by_tolerance { CONVERGED } else { 0.0 };
    if found.scaled <= most {
        return None;
    }
    let (status, residual) = (attempt.answer.status.name(), found.scaled);
    broken("status", format!("{status}, scaled residual {residual:.3e} above {most:.3e}"))
}

/// ∫lo and ∫hi of every contact edge as the solver has them: those of a full tick are sums over its inputs, each of which is
/// integrated alone, and where the rule for edge data does not resolve them differ by what it misses.
fn flux_ends(case: &RandomCase, problem: &Problem) -> Result<Vec<[f64; 2]>> {
    let counts = problem.topology.counts;
    if case.effort.way != Way::Full || problem.scene.inputs.is_empty() {
        let ends = |at| ends(problem, at).map(|end| problem.loads.contact_flux[at] + end);
        return Ok((0..counts.contact).map(ends).collect());
    }
    let mut sums = vec![[0.0; 2]; counts.contact];
    let weights = problem.scene.inputs.iter().map(|input| input.default);
    for (term, weight) in iter::once(1.0).chain(weights).enumerate() {
        let of_term = problem.range_term(term)?;
        for ([base, span], (flux, length)) in
            sums.iter_mut().zip(of_term.fluxes.iter().zip(&of_term.spans))
        {
            *base += weight * flux;
            *span += weight * length;
        }
    }
    Ok(sums.into_iter().map(|[base, span]| [base + span.min(0.0), base + span.max(0.0)]).collect())
}

/// lo ≤ τ·n ≤ hi on C, and the force that is told, of τ·n − lo or hi − τ·n, is none that pulls.
fn forces(case: &RandomCase, attempt: &Attempt) -> Option<Broken> {
    let (problem, answer) = (&attempt.problem, &attempt.answer);
    answer.bound?;
    let ranges = match flux_ends(case, problem) {
        Ok(ranges) => ranges,
        Err(why) => return broken("force", why.to_string()),
    };
    let on_edge = |(edge, [least, most]): (usize, [f64; 2])| {
        let finite = [least, most].map(|end| if end.is_finite() { end.abs() } else { 0.0 });
        let tau = answer.certified.tau[edge];
        ([tau - least, most - tau], tau.abs() + finite[0].max(finite[1]))
    };
    let edges: Vec<_> = (problem.topology.counts.free..).zip(ranges).map(on_edge).collect();
    let sizes = || edges.iter().map(|&(_, size)| size);
    let (terms, largest) = (sizes().sum::<f64>(), sizes().fold(0.0, f64::max));
    let epsilon = case.effort.scalar.epsilon();
    // Beside a large one a load may be below the smallest number of its scalar, and a jump of it misplaced.
    let lost = (f64::from(f32::MIN_POSITIVE) + JUMP) * largest;
    let slack = |size: f64| FORCE * epsilon * size + lost;
    let within = edges.iter().map(|([up, down], size)| up.min(*down) + slack(*size));
    let worst = within.fold(0.0, f64::min);
    if worst < 0.0 && case.effort.way != Way::Condensed {
        return broken("force", format!("τ·n is {worst:.3e} beyond its ends on an edge"));
    }
    let least = -(FORCE * epsilon + JUMP) * terms;
    if answer.contact_force >= least {
        return None;
    }
    broken("force", format!("{:.6e} below {least:.3e}", answer.contact_force))
}

/// The answer as the axes judge theirs.
pub fn verdict(case: &RandomCase, attempt: &Attempt, measured: Option<&Measured>) -> Verdict {
    let answer = &attempt.answer;
    let finite = attempt.is_finite();
    let measured = measured.filter(|_| finite);
    let beyond = |of: &Measured| (of.combined - of.total).max(0.0);
    let reference =
        |of: &Measured| Reference { bound: of.best, error: f64::NAN, energy: of.energy };
    let measured = measure::Measured {
        bound: measured.map(|of| of.bound.total),
        error: measured.map_or(f64::NAN, beyond),
        uncertain: measured.map_or(0.0, |of| of.uncertain[0]),
        reference: measured.map(reference),
        of_fields: None,
        finite,
    };
    let (success, status) = (answer.converged(), answer.status.name());
    Answered { success, status, scalar: case.effort.scalar, measured }.verdict()
}
