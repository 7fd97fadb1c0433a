//! Checks of every scene: the main job's tolerances with their reasons.

use serde::Serialize;
use signorini_kernel::Real;
use signorini_kernel::law::EdgeLaw;

use crate::record_file::word;
use signorini_problem::Problem;
use signorini_solve::{ScalarKind, Solution};

/// A claim about one subject, and what was found.
#[derive(Debug, Clone, Serialize)]
pub struct Check {
    /// The scene and the scalar, or the refined grid.
    pub subject: String,
    pub claim: &'static str,
    /// The value that was found, with the bound.
    pub found: String,
    /// How much of the bound is used up; above 1 (or NaN) the check fails.
    pub used: f64,
    pub passed: bool,
}

impl Check {
    /// `value` ≤ `bound`; NaN fails.
    pub fn at_most(subject: &str, claim: &'static str, value: f64, bound: f64) -> Self {
        let found = match bound {
            1.0.. => format!("{value:.3} ≤ {bound}"),
            _ => format!("{value:.1e} ≤ {bound:.0e}"),
        };
        let (used, passed) = (value / bound, value <= bound);
        Self { subject: subject.to_owned(), claim, found, used, passed }
    }

    /// `value` ≥ `bound`; NaN fails.
    pub fn at_least(subject: &str, claim: &'static str, value: f64, bound: f64) -> Self {
        let found = format!("{value:.3} ≥ {bound}");
        let (used, passed) = (bound / value, value >= bound);
        Self { subject: subject.to_owned(), claim, found, used, passed }
    }

    /// `low` ≤ `value` ≤ `high`, all of them positive; NaN fails.
    pub fn between(subject: &str, claim: &'static str, value: f64, [low, high]: [f64; 2]) -> Self {
        let found = format!("{low} ≤ {value:.4} ≤ {high}");
        let used = (low / value).or_larger(value / high);
        Self { subject: subject.to_owned(), claim, found, used, passed: used <= 1.0 }
    }

    /// A fact; `found` is what it turned out to be.
    pub fn holds(subject: &str, claim: &'static str, passed: bool, found: &str) -> Self {
        let used = f64::from(u8::from(!passed));
        Self { subject: subject.to_owned(), claim, found: found.to_owned(), used, passed }
    }
}

/// Largest distance to the faer reference in u, relative to the range of u.
///
/// f64: both are at their rounding floor, a condition number of 10⁶ apart at most. f32: the kernel
/// corrects its defect, so the rounding of data remains, amplified by contrast and distortion.
fn agreement(scalar: ScalarKind) -> f64 {
    match scalar {
        ScalarKind::F64 => 1e-10,
        ScalarKind::F32 => 1e-4,
    }
}

/// Identities that hold to rounding, relative to the largest terms that are summed for them: a few
/// dozen roundings a cell, some hundreds of thousand cells.
fn rounding(scalar: ScalarKind) -> f64 {
    match scalar {
        ScalarKind::F64 => 1e-12,
        ScalarKind::F32 => 2e-5,
    }
}

/// Distance of two solutions, relative to the range of the second.
pub fn distance(u: &[f64], reference: &[f64]) -> f64 {
    let (low, high) = reference
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| (a.min(x), b.max(x)));
    let size = (high - low).max(f64::TINY);
    u.iter().zip(reference).fold(0.0_f64, |most, (a, b)| most.or_larger((a - b).abs())) / size
}

pub fn subject(name: &str, scalar: ScalarKind) -> String {
    format!("{name}, {}", word(&scalar))
}

/// Convergence, agreement with the reference and the method's identities.
pub fn of(name: &str, problem: &Problem, solution: &Solution, reference: &Solution) -> Vec<Check> {
    let (scalar, subject) = (solution.scalar, subject(name, solution.scalar));
    let terms = largest_terms(problem, solution);
    let at_most = |claim, value, bound| Check::at_most(&subject, claim, value, bound);
    let rounding = |claim, value| at_most(claim, value, rounding(scalar));
    let largest = solution.largest_flux();
    let apart = distance(&solution.u, &reference.u);
    vec![
        Check::holds(
            &subject,
            "the solver converged",
            solution.converged(),
            solution.status.name(),
        ),
        at_most("u agrees with the faer reference", apart, agreement(scalar)),
        rounding("fluxes agree from both sides of an edge", solution.mismatch * largest / terms),
        rounding(
            "every cell is in balance",
            solution.conservation_defect(problem) * largest / terms,
        ),
        rounding("the flux on Neumann edges is the given one", neumann(problem, solution) / terms),
        rounding("u ≥ ψ, λ ≥ 0, (u − ψ) λ = 0 on contact edges", contact(problem, solution, terms)),
    ]
}

/// max |K_ij u_j| over the cells: what fluxes are summed from.
fn largest_terms(problem: &Problem, solution: &Solution) -> f64 {
    let stiffest = problem.stiffest();
    let size = solution.u.iter().fold(f64::TINY, |most, u| most.max(u.abs()));
    (stiffest * size).max(solution.largest_flux())
}

fn neumann(problem: &Problem, solution: &Solution) -> f64 {
    let mut given = vec![0.0; problem.ends.len()];
    problem.loads.neumann.iter().for_each(|record| given[record.edge as usize] = record.flux);
    let edges = (0..given.len()).filter(|&edge| problem.kinds[edge].has_given_flux());
    edges.fold(0.0_f64, |most, edge| most.or_larger((solution.flux[edge] - given[edge]).abs()))
}

/// The largest violation of u ≥ ψ, λ ≥ 0, (u − ψ) λ = 0, each relative to its own size; of a flux with two ends, how far it is
/// from what the law asks of this u, where u is not next to the gap.
fn contact(problem: &Problem, solution: &Solution, terms: f64) -> f64 {
    let free = problem.topology.counts.free;
    let size = solution.u.iter().fold(f64::TINY, |most, u| most.max(u.abs()));
    (0..problem.topology.counts.contact).fold(0.0_f64, |most, at| {
        let opening = (solution.u[free + at] - solution.gap(problem, at)) / size;
        let (flux, range) = (solution.flux[free + at], problem.loads.flux_range(at));
        if range.span().length() != f64::INFINITY {
            let law = EdgeLaw::above(0.0).with_span(range.span());
            let missing = (law.flux(opening, flux, range) - flux).abs() / terms;
            let own = if opening == 0.0 { f64::INFINITY } else { opening.abs() };
            return most.or_larger(own.min(missing));
        }
        let force = range.multiplier(flux) / terms;
        most.or_larger(-opening).or_larger(-force).or_larger(opening.min(force))
    })
}
