//! What an output is of u and σ, and the data of the linear problem that weighs their errors in it.
//!
//! ```text
//!   J(u) = J(s) + {…}      the mean of u over a part P of the boundary, or over a cell
//!   J(σ) = J(τ) − {…}      the flux through P, or the force of contact there
//! ```
//! with the same {…} for both ([`super`]). Its weights z and ζ have these data:
//! ```text
//!   mean    ζ·n = 1/|P| on P, 0 on the rest of N and C,  z = 0 on D,  ζ·n = −h z (+ 1/|P|) on R,  −∇·ζ = 1/|T| in a cell
//!   flux    z = ±1 on P, 0 on the rest of D and C,  ζ·n = 0 on N,  ζ·n = h (1_P − z) on R
//! ```

use super::part::Part;
use super::values;
use crate::problem::{EdgeKind, Problem};
use crate::solve::Solution;
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity};

/// A linear output.
pub(super) struct Goal {
    /// 1 of u, −1 of σ.
    pub sign: f64,
    /// J(s) or J(τ), and the size of what it is summed from.
    pub start: [f64; 2],
    /// z on each of the scene's boundaries with a given u, a gap, or a transfer law that is asked for its flux.
    pub values: Vec<f64>,
    /// ζ·n on each of the scene's boundaries, as far as no u makes it.
    pub densities: Vec<f64>,
    /// The cell, triangles first, in which ζ has a source of 1.
    pub cell: Option<usize>,
    /// What it is the value of.
    pub of: String,
}

/// A goal, or why there is none.
pub(super) type Posed = std::result::Result<Goal, String>;

impl Goal {
    /// That of an output, where it is linear.
    ///
    /// # Errors
    /// Data that are not finite, a probe outside the mesh.
    pub fn of(problem: &Problem, solution: &Solution, output: &Output) -> Result<Posed> {
        let part = Part::new(problem, output);
        let none = |why: &str| Ok(Err(why.to_owned()));
        match output.quantity {
            Quantity::Length | Quantity::Saturated => none("the length of a contact set has none"),
            Quantity::Bound => none("it is a bound itself"),
            Quantity::Probe { .. } => Self::of_cell(problem, solution, output).map(Ok),
            _ if part.kind().is_none() => none("its boundary has no edge"),
            Quantity::Mean => Self::of_mean(problem, solution, &part).map(Ok),
            Quantity::Flux | Quantity::Force => {
                Self::of_flux(problem, solution, &part, output.quantity).map(Ok)
            }
        }
    }

    fn of_mean(problem: &Problem, solution: &Solution, part: &Part) -> Result<Self> {
        let density = 1.0 / part.length();
        let tables = 0..problem.scene.boundaries.len();
        Ok(Self {
            sign: 1.0,
            start: values::mean(problem, solution, part)?,
            values: vec![0.0; tables.len()],
            densities: tables.map(|at| if part.has_table(at) { density } else { 0.0 }).collect(),
            cell: None,
            of: format!("the mean of u over {}", part.name()),
        })
    }

    fn of_cell(problem: &Problem, solution: &Solution, output: &Output) -> Result<Self> {
        let (cell, start) = values::cell(problem, solution, output)?;
        let none = vec![0.0; problem.scene.boundaries.len()];
        let [x, y] = crate::certify::cell::Cell::of(problem, cell).middle();
        Ok(Self {
            sign: 1.0,
            start,
            values: none.clone(),
            densities: none,
            cell: Some(cell),
            of: format!("the mean of u over the cell around ({x}, {y})"),
        })
    }

    fn of_flux(
        problem: &Problem,
        solution: &Solution,
        part: &Part,
        quantity: Quantity,
    ) -> Result<Self> {
        let is_force = quantity == Quantity::Force;
        let weight = |at: usize| match part.has_table(at) {
            true if is_force => values::direction(problem, at),
            true => 1.0,
            false => 0.0,
        };
        let values: Vec<f64> = (0..problem.scene.boundaries.len()).map(weight).collect();
        let start = values::flux(problem, solution, part, is_force)?;
        let of = match is_force {
            true => format!("the force ∫λ over {}", part.name()),
            false => format!("the flux (A∇u)·n over {}", part.name()),
        };
        let densities = vec![0.0; values.len()];
        Ok(Self { sign: -1.0, start, values, densities, cell: None, of })
    }

    /// Whether the data already are its value: a flux through N, a mean over D.
    pub fn is_given(&self, problem: &Problem, output: &Output) -> bool {
        let kind = Part::new(problem, output).kind();
        match output.quantity {
            Quantity::Flux => kind == Some(EdgeKind::Neumann),
            Quantity::Mean => kind == Some(EdgeKind::Dirichlet),
            _ => false,
        }
    }
}
