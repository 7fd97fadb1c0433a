//! How wrong an answer is: against the exact solution, or against a finer solve that counts with its own bound.
//!
//! With (s, τ) of the answer and (s′, τ′) of a finer one, both bounded by their own totals, the triangle inequality says
//! ```text
//!   combined(s′ − s, τ′ − τ) ≤ total + total′,   ‖A^½∇_h(s′ − u_h)‖ ≤ of_u + total′,
//! ```
//! whatever the exact solution is: an answer that breaks it, or a finer one, has a bound that is wrong.

use super::attempt::{Attempt, Held};
use super::case::{RandomCase, Way, Yardstick};
use super::cut::cut_along;
use super::nested::{Apart, Nesting, apart};
use super::outputs::Intervals;
use crate::mesh_solution::{MeshSolution, solve_directly};
use signorini_certify::ErrorBound;
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::Conductivity;
use signorini_certify::curved::CurvedEdges;
use signorini_certify::deviation::Deviations;
use signorini_certify::exact::{Distance, distance_on};
use signorini_certify::robin::missed;
use signorini_problem::Problem;
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_scene::mesh::adaptive::refined;
use signorini_scene::scene::units::Units;
use signorini_scene::{Mesh, Result};
use signorini_solve::norms::errors;
use signorini_solve::{choose_units, times};

/// An answer beside the truth, in units in which its numbers are near 1.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    pub bound: ErrorBound,
    /// The distance of s and τ from the truth; without a bound NaN.
    pub combined: f64,
    /// The distance of u_h from the truth.
    pub of_u: f64,
    /// The number that the bound is up to quadrature, and how far its square may be off by rounding, where the exact solution is
    /// known.
    pub identity: Option<[f64; 2]>,
    /// Whether the gap may be above it: a condensed model has one excess of hi − lo for all edges, in the unit of its unknowns.
    pub may_exceed: bool,
    /// The part that records of curved data leave out: the total has it.
    pub left_out: f64,
    /// The part of the gap that points may miss where A varies: the total has it, and rows of condensed models.
    pub unseen: f64,
    /// The bound of the truth: 0 where it is exact.
    pub total: f64,
    /// How far `combined` and `of_u` may be off, where they seem above their bounds.
    pub uncertain: [f64; 2],
    /// ‖A^½∇s‖ of the truth.
    pub energy: f64,
    /// The bound of the exact discrete solution on the same mesh.
    pub best: Option<f64>,
    pub intervals: Intervals,
}

impl Measured {
    /// |gap/identity − 1|, or by how much the gap falls short, less what rounding may be of it, where the exact solution is known and
    /// the gap is no rounding.
    pub fn identity_off(&self) -> Option<f64> {
        let ([identity, rounding], gap) = (self.identity?, self.bound.duality_gap);
        // |gap² − identity²| = |gap − identity| (gap + identity)
        let off = if self.may_exceed { identity - gap } else { (gap - identity).abs() };
        // In cells that are cut the gap is that of a tensor below A, and twice what A has above it is between the two at most.
        let open = 2.0 * self.bound.open() + self.unseen * gap + self.left_out;
        let off = off - rounding / (gap + identity) - open;
        (gap > ROUNDINGS * self.bound.rounding).then(|| off.max(0.0) / identity)
    }

    /// The errors, less what they may be off.
    pub fn least(&self) -> [f64; 2] {
        [self.combined - self.uncertain[0], self.of_u - self.uncertain[1]].map(|of| of.max(0.0))
    }
}

/// Unknowns of a finer solve: mostly, and at most.
const UNKNOWNS: [usize; 2] = [12_000, 200_000];
/// Unknowns of a finer solve before its mesh is cut along lines.
const BEFORE_CUTS: usize = 4000;
/// Most refinements of a finer solve.
const LEVELS: u32 = 3;
/// Panels, and points on each, in a direction of a cell of the finer mesh: more and more while an error seems above its
/// bounds.
const RULES: [(u32, usize); 4] = [(1, 4), (1, 7), (4, 8), (16, 8)];
/// Points a direction for the energy of one answer.
const POINTS: usize = 7;
/// Panels a direction of a cell beside an exact solution: more and more while kinks and layers inside cells seem to take them.
const PANELS: [u32; 3] = [1, 4, 24];

/// |gap/identity − 1| up to which the integrals of the exact solution are trusted.
pub const IDENTITY: f64 = 2e-3;
/// The identity is asked for where the gap is above so many times its rounding.
const ROUNDINGS: f64 = 100.0;
/// Part of the gap up to which what 8 points miss of u_ext leaves the identity as it is.
const RESOLVED: f64 = 1e-4;
/// Part of ‖A^½∇s‖ that rounding of corners may be.
const CORNERS: f64 = 1e-9;

/// Measures; `None` where there is no truth to measure by.
pub fn measure(case: &RandomCase, attempt: &Attempt) -> Result<Option<Measured>> {
    let (problem, answer) = match attempt.answer.in_its_units() {
        Some((problem, own)) => (problem.clone(), own.clone()),
        None => {
            let units = Units { zero: 0.0, ..choose_units(&attempt.problem)? };
            let answer = times(&units.inverse(), attempt.answer.clone());
            match units == Units::default() {
                true => (attempt.problem.clone(), answer),
                false => (attempt.problem.in_units(&units)?, answer),
            }
        }
    };
    let Some(bound) = answer.bound else { return Ok(None) };
    // An answer without s and τ has nothing to be measured.
    let held = Held { case, problem: &problem, answer: &answer, bound };
    let mut found = match case.truth {
        Yardstick::Finer => held.by_finer()?,
        Yardstick::Catalogue | Yardstick::Made => Some(held.by_exact()?),
    };
    if let Some(found) = &mut found {
        found.best = solve_directly(&problem).ok().and_then(|of| of.bound).map(|of| of.total);
    }
    Ok(found)
}

impl Held<'_> {
    fn by_exact(&self) -> Result<Measured> {
        let (problem, own) = (self.problem, MeshSolution::of(self.problem, self.answer)?);
        let within = apart(&own, &own, &Nesting::default(), &gauss(POINTS))?;
        let mut found = Measured {
            bound: self.bound,
            combined: f64::NAN,
            of_u: f64::NAN,
            energy: within.energy,
            ..Measured::default()
        };
        if let Some(exact) = &problem.scene.exact {
            // A condensed model has one excess of hi − lo, in a unit of its own, and adds what it mends to the norm: its gap is that of
            // each edge's own range, or more.
            let is_condensed = self.case.effort.way == Way::Condensed;
            let is_alike = is_condensed && problem.loads.span_excess > 0.0;
            let mut alike = problem.clone();
            alike.loads.span_excess *= if is_alike { 0.0 } else { 1.0 };
            let by = |panels| distance_on(panels, exact, &alike, &own.admissible);
            let mut distance = by(PANELS[0])?;
            for more in &PANELS[1..] {
                if self.is_off(&distance) {
                    distance = by(*more)?;
                }
            }
            found.combined = distance.combined;
            found.of_u = errors(exact, problem, &self.answer.u, &self.answer.flux)?.energy;
            let rounding = |error: f64| distance.rounding / error.max(distance.rounding.sqrt());
            found.uncertain = [found.combined, found.of_u].map(rounding);
            // The identity has the oscillation of f, g and q in it, with its sign, but not that of u_ext.
            found.intervals = self.intervals_by_exact();
            // Corners of a condensed model that rounding moves count in its oscillation.
            let gap = self.bound.duality_gap;
            let is_rounding = is_condensed && gap <= CORNERS * found.energy;
            let known = !is_rounding && self.missed()? <= RESOLVED * gap;
            found.identity = known.then_some([distance.identity, distance.rounding]);
            found.may_exceed = is_alike || is_condensed && self.case.effort.sweeps.is_some();
            let deviations = Deviations::of(problem)?;
            found.left_out = CurvedEdges::new(problem, &deviations)?.left_out;
            let missed = |at| Conductivity::of(problem, at).missed(Cell::of(problem, at))[0];
            found.unseen = (0..problem.cells()).map(missed).fold(0.0, f64::max);
        }
        Ok(found)
    }

    /// Whether the integrals seem to contradict the bound.
    fn is_off(&self, found: &Distance) -> bool {
        let of_gap = (self.bound.duality_gap / found.identity - 1.0).abs();
        found.combined > self.bound.total || of_gap > 0.1 * IDENTITY
    }

    /// The part that 8 points of the edges of R miss.
    fn missed(&self) -> Result<f64> {
        let problem = self.problem;
        let laws = problem.loads.robin.iter();
        let squares = laws.map(|law| missed(problem, law.edge as usize));
        let squares = squares.map(|of| of.map(|[known, left]| (known + left).powi(2)));
        Ok(squares.sum::<Result<f64>>()?.sqrt())
    }

    /// A finer mesh, cut and graded for a feature of the data.
    fn finer(&self) -> Result<(Mesh, Nesting)> {
        let RandomCase { number, lines, .. } = self.case;
        // One in so many cases gets the finest that is allowed for.
        let most = match lines.is_empty() {
            true => UNKNOWNS[usize::from(number.is_multiple_of(2 * 97))],
            false => BEFORE_CUTS,
        };
        let (mut mesh, mut levels) = (refined(&self.problem.mesh)?, 1);
        while levels < LEVELS && 8 * mesh.cells() <= most {
            (mesh, levels) = (refined(&mesh)?, levels + 1);
        }
        if lines.is_empty() {
            return Ok((mesh, Nesting { levels, cut: None }));
        }
        let (mesh, parents) = cut_along(&mesh, lines);
        Ok((mesh, Nesting { levels, cut: Some(parents) }))
    }

    fn by_finer(&self) -> Result<Option<Measured>> {
        let (problem, own) = (self.problem, MeshSolution::of(self.problem, self.answer)?);
        let (mesh, nesting) = self.finer()?;
        let mut finer = Problem::new(&problem.scene, mesh)?;
        finer.set_time(problem.time)?;
        let Ok(solution) = solve_directly(&finer) else { return Ok(None) };
        let Some(its) = solution.bound else { return Ok(None) };
        let intervals = self.intervals_by_finer((&finer, &solution));
        let fine = MeshSolution::of(&finer, &solution)?;
        let most = [self.bound.total + its.total, self.bound.of_u + its.total];
        let is_above = |of: &Apart| of.combined > most[0] || of.of_u > most[1];
        let (mut found, mut uncertain) = (Apart::default(), [0.0; 2]);
        // What narrow data of an edge make of s inside a coarse cell takes many points, whatever the finer mesh is.
        for (panels, points) in RULES {
            let rule = on_panels(panels, &gauss(points));
            let next = apart(&own, &fine, &nesting, &rule)?;
            uncertain = [found.combined - next.combined, found.of_u - next.of_u].map(f64::abs);
            found = next;
            if !is_above(&found) {
                uncertain = [0.0; 2];
                break;
            }
        }
        Ok(Some(Measured {
            bound: self.bound,
            combined: found.combined,
            of_u: found.of_u,
            total: its.total,
            uncertain,
            energy: found.energy,
            intervals,
            ..Measured::default()
        }))
    }
}
