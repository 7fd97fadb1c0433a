//! Active sets outside, corrections inside.

use crate::active_set::{ActiveSet, Side};
use crate::conjugate::Conjugate;
use crate::edges::Edges;
use crate::{Failure, Problem, Settings, Solution};

/// √(r·z) of a correction while the set changes, and once it has settled.
const ROUGH: f64 = 0.1;
const FINE: f64 = 1e-3;
/// Rounding of a step of the active set, in multiples of the largest |u|: as in the reference.
const NOISE: f64 = 64.0 * f64::EPSILON;
/// Corrections of a settled set that do not halve the residual, until rounding is said to end it.
const PATIENCE: usize = 4;
/// Active sets at most.
const MOST_SETS: usize = 200;

/// The present iterate and all that improves it.
pub(crate) struct Solver<'a, const WIDTH: usize> {
    problem: &'a Problem<'a>,
    set: ActiveSet<'a>,
    edges: Edges<WIDTH>,
    conjugate: Conjugate,
    u: Vec<f64>,
    residual: Vec<f64>,
    free: usize,
    count: Counts,
    /// The residual 1 of f32.
    unit: f64,
    /// The largest entries of the last two corrections on this set, as far as there are any.
    changes: [f64; 2],
}

#[derive(Default)]
struct Counts {
    iterations: usize,
    of_set: usize,
    longest: usize,
    sets: usize,
}

/// How far an iterate is from the solution.
struct Measure {
    scale: f64,
    scaled: f64,
}

impl<'a, const WIDTH: usize> Solver<'a, WIDTH> {
    pub fn new(problem: &'a Problem<'a>, start: &[f64]) -> Self {
        let n = problem.unknowns();
        let free = problem.contact.free();
        let parts = problem.contact.floating_components();
        let own = start.get(free..).unwrap_or_default();
        let middle = 0.5 * (problem.given[0] + problem.given[1]);
        Self {
            problem,
            set: ActiveSet::new(problem.contact.lower, problem.contact.spans, parts, own),
            edges: Edges::new(problem),
            conjugate: Conjugate::new(n),
            u: if start.is_empty() { vec![middle; n] } else { start.to_vec() },
            residual: vec![0.0; n],
            free,
            count: Counts::default(),
            unit: 0.0,
            changes: [f64::INFINITY; 2],
        }
    }

    pub fn run(mut self, settings: &Settings) -> Result<Solution, Failure> {
        let (mut best, mut waited, mut error) = (f64::INFINITY, 0, f64::INFINITY);
        self.touch();
        let mut is_new = true;
        loop {
            self.measure_residual();
            if self.change_sides() || is_new {
                self.begin_set();
                (best, waited, is_new) = (f64::INFINITY, 0, false);
                error = self.correct(settings, ROUGH)?;
                continue;
            }
            let Measure { scale, scaled } = self.measure();
            (best, waited) = if scaled <= 0.5 * best { (scaled, 0) } else { (best, waited + 1) };
            let is_done = scaled <= settings.tolerance && error <= settings.accuracy * scale;
            if is_done || waited > PATIENCE {
                return Ok(self.conclude());
            }
            let reduction = (0.1 * settings.tolerance / scaled).clamp(FINE, ROUGH);
            error = self.correct(settings, reduction)?;
        }
    }

    /// Moves touching edges to the gap.
    fn touch(&mut self) {
        let gaps = self.problem.contact.lower.iter().zip(&self.set.sides);
        for (u, (gap, side)) in self.u[self.free..].iter_mut().zip(gaps) {
            if *side == Side::Touching {
                *u = *gap;
            }
        }
    }

    /// b − Ku
    fn measure_residual(&mut self) {
        for (row, residual) in self.residual.iter_mut().enumerate() {
            *residual = self.problem.residual(row, &self.u);
        }
    }

    /// Whether contact edges were on a wrong side; they are on another one now, and the residual belongs to that.
    fn change_sides(&mut self) -> bool {
        let (free, problem) = (self.free, self.problem);
        let largest = self.u.iter().fold(0.0, |largest: f64, u| largest.max(u.abs()));
        let (u, residual) = (&self.u, &self.residual);
        let force = |at: usize| -residual[free + at];
        let opening = |at: usize| u[free + at] - problem.contact.lower[at];
        let stiffness = |at: usize| problem.diagonal(free + at);
        let wrong = self.set.wrong(NOISE * largest, opening, force, stiffness);
        self.set.change(&wrong, force);
        for (at, &gap) in problem.contact.lower.iter().enumerate() {
            if self.set.sides[at] == Side::Touching && self.u[free + at] != gap {
                self.move_to(free + at, gap);
            }
        }
        !wrong.is_empty()
    }

    /// Sets u of one edge.
    fn move_to(&mut self, row: usize, value: f64) {
        let change = value - std::mem::replace(&mut self.u[row], value);
        for (column, entry) in self.problem.contact.row(row) {
            self.residual[column] -= entry * change;
        }
    }

    fn measure(&self) -> Measure {
        let (problem, free) = (self.problem, self.free);
        let mut worst = 0.0_f64;
        let [mut least, mut most] = problem.given;
        for (row, (&residual, &u)) in self.residual.iter().zip(&self.u).enumerate() {
            (least, most) = (least.min(u), most.max(u));
            let diagonal = problem.diagonal(row);
            let violation = match row.checked_sub(free) {
                None => residual.abs() / diagonal,
                Some(at) => {
                    self.set.violation(at, u - problem.contact.lower[at], -residual, diagonal)
                }
            };
            // A NaN is taken over, and stays.
            if violation > worst || violation.is_nan() {
                worst = violation;
            }
        }
        let scale = (most - least).max(problem.loaded).max(f64::MIN_POSITIVE);
        Measure { scale, scaled: worst / scale }
    }

    fn begin_set(&mut self) {
        self.count.sets += 1;
        (self.count.of_set, self.changes) = (0, [f64::INFINITY; 2]);
        self.edges.hold(self.set.sides.iter().map(|&side| side == Side::Touching));
    }

    /// Adds a correction to u, and returns what is left to correct.
    fn correct(&mut self, settings: &Settings, reduction: f64) -> Result<f64, Failure> {
        let force = |row: usize| row.checked_sub(self.free).map_or(0.0, |at| self.set.force(at));
        let is_held = |row: usize| {
            row.checked_sub(self.free).is_some_and(|at| self.set.sides[at] == Side::Touching)
        };
        let wanted =
            |(row, &rest): (usize, &f64)| if is_held(row) { 0.0 } else { rest + force(row) };
        // Sets may cycle with nothing left to correct in any of them.
        let Counts { iterations, sets, .. } = self.count;
        if sets > MOST_SETS {
            return Err(Failure::Slow { iterations, sets, residual: self.measure().scaled });
        }
        let all = self.residual.iter().enumerate().map(wanted);
        let present = all.fold(0.0, |most: f64, rest| most.max(rest.abs()));
        if present == 0.0 {
            return Ok(0.0);
        }
        if self.count.of_set == 0 {
            self.unit = present;
            self.conjugate.restart();
        }
        let largest = self.unit;
        for (rest, &at) in self.conjugate.residual.iter_mut().zip(&self.edges.order) {
            let at = at as usize;
            *rest = (wanted((at, &self.residual[at])) / largest) as f32;
        }
        let most = settings.most_iterations.saturating_sub(self.count.iterations);
        let made = self.conjugate.correct(&mut self.edges, reduction, most);
        self.count.iterations += made;
        self.count.of_set += made;
        self.count.longest = self.count.longest.max(self.count.of_set);
        let iterations = self.count.iterations;
        if made == 0 {
            return Err(Failure::Breakdown { iterations, residual: self.measure().scaled });
        }
        if made == most {
            return Err(Failure::Slow { iterations, sets, residual: self.measure().scaled });
        }
        let unit = largest / self.edges.unit;
        let mut change = 0.0_f64;
        for (&x, &at) in self.conjugate.x.iter().zip(&self.edges.order) {
            let step = unit * f64::from(x);
            self.u[at as usize] += step;
            change = change.max(step.abs());
        }
        Ok(change * self.left(change))
    }

    /// The part of a correction's largest entry, `change`, that is left to correct: by its iterations, or by how the last corrections
    /// of this set became smaller. Where cells are slender, iterations in f32 do not see all that they leave.
    fn left(&mut self, change: f64) -> f64 {
        let [before, last] = self.changes;
        self.changes = [last, change];
        let of_last = if before.is_finite() { last / before } else { 0.0 };
        self.conjugate.left.max(change / last).max(of_last)
    }

    fn conclude(self) -> Solution {
        let Counts { iterations, longest, sets, .. } = self.count;
        Solution { u: self.u, sides: self.set.sides, iterations, longest, sets }
    }
}
