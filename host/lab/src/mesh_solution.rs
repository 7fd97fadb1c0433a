//! The direct solver's answer, and any answer on its mesh: s, τ and u_h on each cell, with all that s follows of curved data.

use signorini_certify::admissible::{self, Admissible};
use signorini_certify::cell::{Cell, Jet};
use signorini_certify::curved::followed;
use signorini_certify::deviation::Deviations;
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_scene::Result;
use signorini_solve::{Options, Solution, SolverKind, solve};

/// Solves `problem` by factorisation: the exact discrete solution up to rounding.
pub fn solve_directly(problem: &Problem) -> Result<Solution> {
    solve(problem, &Options { solver: SolverKind::Direct, ..Options::default() })
}

/// An answer of a problem.
pub struct MeshSolution<'a> {
    pub problem: &'a Problem,
    /// s and τ.
    pub admissible: Admissible<'a>,
    /// Means of u_h over the edges.
    u: &'a [f64],
    deviations: Deviations<'a>,
}

/// An answer on one cell.
pub struct OnCell<'d, 's> {
    pub cell: Cell,
    s: admissible::OnCell<'d, 's>,
    /// A field of which the flux is τ.
    pub tau: CellField,
    /// A field of which u is u_h.
    pub u: CellField,
}

impl<'a> MeshSolution<'a> {
    /// The answer of a solver.
    pub fn of(problem: &'a Problem, solution: &'a Solution) -> Result<Self> {
        Self::new(problem, solution.certified.admissible(), &solution.u)
    }

    /// The answer with these s, τ and u.
    pub fn new(problem: &'a Problem, admissible: Admissible<'a>, u: &'a [f64]) -> Result<Self> {
        let deviations = followed(problem, &admissible)?;
        Ok(Self { problem, admissible, u, deviations })
    }

    pub fn on_cell(&self, at: usize) -> OnCell<'_, 'a> {
        let Self { problem, admissible, u, deviations } = self;
        OnCell {
            cell: Cell::of(problem, at),
            s: admissible.on_cell(problem, at, deviations),
            tau: CellField::new(problem, at, admissible.tau, admissible.tau),
            u: CellField::new(problem, at, u, u),
        }
    }

    /// s on an edge, at `t` of its length.
    pub fn s_on_edge(&self, edge: usize, t: f64) -> Result<f64> {
        self.admissible.on_edge(self.problem, edge, self.deviations.on(edge), t)
    }
}

impl OnCell<'_, '_> {
    pub fn s(&self, reference: [f64; 3]) -> Result<Jet> {
        self.s.at(&self.cell.local(reference))
    }
}
