//! Which term makes most of a bound, and where.

use super::indicators::{oscillations, squares};
use crate::{ScalarKind, Solution};
use signorini_certify::cell::Cell;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// A term of a bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Term {
    /// A∇s and τ differ.
    Gap,
    /// The part that means of the data leave out.
    Oscillation,
    /// The part that rounding may hide.
    Rounding,
    /// The part that more iterations would remove.
    Algebraic,
}

impl Term {
    /// The term for people.
    pub fn words(self) -> &'static str {
        match self {
            Self::Gap => "the gap between s and τ",
            Self::Oscillation => "the oscillation of data that the mesh does not resolve",
            Self::Rounding => "rounding",
            Self::Algebraic => "what the solver left unfinished",
        }
    }

    /// The advice that lowers it.
    fn remedy(self, scalar: ScalarKind) -> &'static str {
        match (self, scalar) {
            (Self::Gap | Self::Oscillation, _) => {
                "a finer mesh there lowers it: `--max-error 5%` makes one"
            }
            (Self::Rounding, ScalarKind::F32) => "`--scalar f64` rounds less",
            (Self::Rounding, ScalarKind::F64) => {
                "a finer mesh does not lower it; cells that are less thin, or data and conductivities that are nearer to each \
                 other, do"
            }
            (Self::Algebraic, _) => "more sweeps lower it, or `--solver auto`",
        }
    }
}

/// The largest term of a bound, and the place that has most of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Dominant {
    /// The term.
    pub term: Term,
    /// The middle of the cell with the largest share.
    pub at: [f64; 2],
    /// Number of the material with the largest share of all squares.
    material: usize,
    /// That share; nothing where no cell is told to have one.
    share: Option<f64>,
}

impl Dominant {
    /// The largest term of a solution's bound.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn of(problem: &Problem, solution: &Solution) -> Result<Self> {
        let bound = solution.bound.unwrap_or_default();
        let gap = (bound.duality_gap.powi(2) - bound.algebraic.powi(2)).max(0.0).sqrt();
        let terms = [
            (Term::Gap, gap),
            (Term::Oscillation, 2.0 * bound.oscillation),
            (Term::Rounding, bound.rounding),
            (Term::Algebraic, bound.algebraic),
        ];
        let (term, _) = terms.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(terms[0]);
        let of_cells = match term {
            Term::Oscillation => oscillations(problem)?.iter().map(|osc| osc * osc).collect(),
            Term::Gap | Term::Rounding | Term::Algebraic => squares(problem, solution)?,
        };
        let at = Cell::of(problem, largest(&of_cells)).middle();
        let mut of_materials = vec![0.0; problem.scene.materials.len()];
        for (&material, square) in problem.binding.materials.iter().zip(&of_cells) {
            of_materials[material as usize] += square;
        }
        let material = largest(&of_materials);
        let all = of_cells.iter().sum::<f64>();
        let share = of_materials.get(material).filter(|_| all > 0.0).map(|of| of / all);
        Ok(Self { term, at, material, share })
    }

    /// A warning on a bound, `size` saying how large it is: what dominates it, and what to do.
    pub fn warning(&self, problem: &Problem, solution: &Solution, size: &str) -> String {
        let Self { term, at: [x, y], material, share } = self;
        let materials = &problem.scene.materials;
        let named = materials.get(*material).filter(|_| materials.len() > 1).zip(*share);
        let place = match named {
            Some((of, share)) => format!(
                "material.{} has {:.0} % of its square, and the cell near ({x:.6}, {y:.6}) most",
                of.name.value,
                100.0 * share
            ),
            None => format!("the cell near ({x:.6}, {y:.6}) has most"),
        };
        let (words, remedy) = (term.words(), term.remedy(solution.scalar));
        format!("the error bound is {size}: most of it is {words}. Of that {place}; {remedy}")
    }
}

/// The place of the largest number.
fn largest(numbers: &[f64]) -> usize {
    (0..numbers.len()).max_by(|&a, &b| numbers[a].total_cmp(&numbers[b])).unwrap_or(0)
}
