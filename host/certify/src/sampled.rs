//! Functions of the scene at the quadrature points of cells: what no answer on the mesh changes.
//!
//! The exact solution u, and L = Σ_E v_E, what ψ and u_D have above their chords and S takes inside
//! (see [`super::cell`]). Evaluated when asked for, or kept in a [`Table`] for many answers on one mesh.

use std::borrow::Cow;

use super::cell::{Cell, Jet};
use super::deviation::{Deviations, Lift};
use signorini_problem::Problem;
use signorini_problem::pointwise::{POINTS, exact_at_all};
use signorini_problem::quadrature::{Point, gauss};
use signorini_problem::threads::on_two_threads;
use signorini_scene::error::Result;
use signorini_scene::scene::Exact;

/// Cells that a thread takes at a time.
const PORTION: usize = 64;

/// A function at the points of [`POINTS`]×[`POINTS`] Gauss points a cell.
pub trait Sampled: Sync {
    /// Whether it is evaluated at any points, or kept at those of the rule.
    const ANYWHERE: bool;

    /// At `points`, all those of cell `at` (triangles first). Empty: 0 all over the cell.
    ///
    /// # Errors
    /// A value that is not finite.
    fn on_cell(&self, at: usize, points: &[Point]) -> Result<Cow<'_, [Jet]>>;
}

/// u of `[exact]`.
pub struct Solution<'a> {
    /// The exact solution.
    pub exact: &'a Exact,
    /// Of what, and when.
    pub problem: &'a Problem,
}

impl Sampled for Solution<'_> {
    const ANYWHERE: bool = true;

    fn on_cell(&self, _: usize, points: &[Point]) -> Result<Cow<'_, [Jet]>> {
        let problem = self.problem;
        let found = exact_at_all(&problem.scene, self.exact, points, problem.time)?;
        Ok(found.into_iter().map(|(value, gradient)| Jet { value, gradient }).collect())
    }
}

/// L of the boundary data.
pub struct Lifted<'a> {
    /// The problem on its mesh.
    pub problem: &'a Problem,
    /// Deviations of the data from their interpolants.
    pub deviations: &'a Deviations<'a>,
}

impl Sampled for Lifted<'_> {
    const ANYWHERE: bool = true;

    fn on_cell(&self, at: usize, points: &[Point]) -> Result<Cow<'_, [Jet]>> {
        let lift = Lift::on_cell(self.problem, at, self.deviations);
        if lift.is_zero() {
            return Ok(Cow::Borrowed(&[]));
        }
        let cell = Cell::of(self.problem, at);
        points.iter().map(|point| lift.at(&cell.local(point.reference))).collect()
    }
}

/// The values of such a function, cell by cell: 24 bytes a point.
#[derive(Debug)]
pub struct Table(Vec<Vec<Jet>>);

impl Table {
    /// Samples of `function` on the mesh of `problem`.
    pub fn of(function: &impl Sampled, problem: &Problem) -> Result<Self> {
        let (rule, cells) = (gauss(POINTS), problem.cells());
        let starts: Vec<usize> = (0..cells).step_by(PORTION).collect();
        let portion = |&start: &usize| {
            let values = |at| {
                let values = function.on_cell(at, &Cell::of(problem, at).points(&rule))?;
                Ok(values.into_owned())
            };
            (start..cells.min(start + PORTION)).map(values).collect::<Result<Vec<_>>>()
        };
        let portions = on_two_threads(&starts, portion, || {})?;
        Ok(Self(portions.into_iter().flatten().collect()))
    }
}

impl Sampled for Table {
    const ANYWHERE: bool = false;

    fn on_cell(&self, at: usize, _: &[Point]) -> Result<Cow<'_, [Jet]>> {
        Ok(Cow::Borrowed(&self.0[at]))
    }
}
