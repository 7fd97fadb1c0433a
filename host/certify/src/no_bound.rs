//! Why a scene's answer has no error bound.

use std::fmt;

use signorini_bound::certificate::Verdict;

use super::cell::Cell;
use super::curved::{Curved, Rough};
use super::ends::Ends;
use signorini_problem::pieces::Pieces;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Problem, excess_within_ranges};
use signorini_scene::scene::Field;

/// Why there is no bound: one sentence that names boundary and place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoBound(String);

impl NoBound {
    /// A reason in words, such as a condensed model has it.
    pub fn new(reason: impl Into<String>) -> Self {
        Self(reason.into())
    }

    /// A gap or a value that is not linear along an edge, in a step of a controller.
    pub fn curved_in_step() -> Self {
        let why = "a controller's step in time has no error bound where a gap or a value is not linear along an edge";
        Self::new(why)
    }

    /// Why these data allow for no bound, whatever the iterate.
    pub fn of_data(problem: &Problem, ends: &Ends, curved: &[Curved]) -> Option<Self> {
        let rough = || curved.iter().find_map(|edge| Self::rough(problem, edge));
        let jump = || ends.jump(problem).map(|jump| Self::values_differ(problem, jump));
        let of_tensor = || Self::not_definite(problem);
        rough().or_else(jump).or_else(of_tensor)
    }

    /// u_D has two values where two Dirichlet edges meet.
    fn values_differ(problem: &Problem, (at, values): ([f64; 2], [f64; 2])) -> Self {
        let [a, b] = values.map(|value| problem.units.value(value));
        Self(format!(
            "the Dirichlet value jumps from {a} to {b} at {}: no function of finite energy has both values",
            place(at)
        ))
    }

    /// The first contact edge whose range hi − lo inputs may close in a part of the edge: one of them has no range, so that ticks
    /// refuse those values alone that close it in the mean.
    pub fn of_ranges(problem: &Problem) -> Option<Self> {
        let (free, has_input) =
            (problem.topology.counts.free, problem.scene.limit_input().is_some());
        let is_open =
            |edge: &usize| excess_within_ranges(problem, *edge).is_some_and(f64::is_infinite);
        let mut edges = free..free + if has_input { problem.topology.counts.contact } else { 0 };
        let edge = edges.find(is_open)?;
        let boundary = problem.boundary_of(edge)?;
        let mut inputs = problem.inputs_of(boundary, &[Field::Flux, Field::Limit]);
        let input = inputs.find(|input| input.range.is_none())?;
        Some(Self(format!(
            "limit − flux of boundary.{} varies along the edge around {}, and input.{} changes it without a range: \
             with a range that leaves it room there is a bound",
            boundary.name.value,
            middle(problem, edge),
            input.name.value
        )))
    }

    /// An edge inside which u_D or ψ jumps, or rises too steeply for a function of finite energy.
    fn rough(problem: &Problem, curved: &Curved) -> Option<Self> {
        let edge = curved.edge as usize;
        let field = if edge < problem.topology.counts.unknowns() { "gap" } else { "value" };
        let spot = |t| {
            let place = place(problem.along(edge, t));
            format!("the {field} of boundary.{} near {place}", boundary(problem, edge))
        };
        Some(Self(match curved.rough? {
            Rough::Jump(t) => {
                format!("{} jumps: no function of finite energy follows it", spot(t))
            }
            Rough::Steep(t) => format!(
                "{} rises too steeply: what follows it along the edge has infinite energy",
                spot(t)
            ),
        }))
    }

    /// A transfer edge along which h is not proved to be positive.
    pub(super) fn transfer_vanishes(problem: &Problem, edge: usize) -> Self {
        Self(format!(
            "the transfer coefficient of boundary.{} is not proved to be positive along the edge around {}: the bound \
             divides by it where it vanishes",
            boundary(problem, edge),
            middle(problem, edge)
        ))
    }

    /// The first of these transfer laws whose points do not see h, and whose h an input changes.
    pub fn of_changed_transfer(problem: &Problem, laws: &[u32]) -> Option<Self> {
        laws.iter().find_map(|&law| {
            let edge = problem.loads.robin.get(law as usize)?.edge as usize;
            let boundary = problem.boundary_of(edge)?;
            let input = problem.inputs_of(boundary, &[Field::Coefficient]).next()?;
            Some(Self(format!(
                "the transfer coefficient of boundary.{} varies inside the edge around {} in a way that 8 points do not \
                 see, and input.{} changes it: a vertex where it jumps or a finer mesh gives a controller a bound",
                boundary.name.value,
                middle(problem, edge),
                input.name.value
            )))
        })
    }

    /// A is not proved to be positive definite and bounded somewhere.
    fn not_definite(problem: &Problem) -> Option<Self> {
        let at = problem.coefficients.pieces.values().find_map(Pieces::unproved)?;
        Some(Self(format!(
            "A is not proved to be bounded and positive definite near {}: nothing tells the energy there",
            place(at)
        )))
    }

    /// The kernel's reason; `data` gives that of data which never allow for a bound.
    pub fn of_verdict<R: Scalar>(
        verdict: &Verdict<R>,
        problem: &Problem,
        data: impl FnOnce() -> Option<Self>,
    ) -> Option<Self> {
        Some(match verdict {
            Verdict::Certified(_) => return None,
            Verdict::Pulled { edge } => Self::pulled(problem, *edge),
            Verdict::Unpressed => Self::new(
                "contact alone holds a part of the mesh, and no edge is pressed hard enough to take what its fluxes \
                 leave unbalanced",
            ),
            Verdict::BelowGap => Self::new(
                "a Dirichlet value lies below the gap where both boundaries meet: no solution has both",
            ),
            Verdict::Unavailable => return data().or(Some(Self::not_asked())),
            Verdict::NotFinite => Self::overflow::<R>(),
            Verdict::NotAsked => Self::not_asked(),
        })
    }

    /// Contact alone holds a part, and the surplus of an iterate would pull at a contact edge.
    pub fn pulled(problem: &Problem, edge: usize) -> Self {
        Self(format!(
            "contact alone holds a part of the mesh, and what its fluxes leave unbalanced would pull at \
             boundary.{} around {}: more sweeps may give a bound",
            boundary(problem, edge),
            middle(problem, edge)
        ))
    }

    /// Neither a Dirichlet, Robin nor contact edge belongs to the part of a cell, so that nothing can take its surplus.
    pub(super) fn held_by_nothing(problem: &Problem, cell: usize) -> Self {
        Self(format!(
            "the part of the mesh around {} has neither a dirichlet, a robin nor a contact edge: nothing can take \
             what its fluxes leave unbalanced",
            place(Cell::of(problem, cell).middle())
        ))
    }

    /// Contact alone holds the part of a cell, and no edge of it is active in an iterate.
    pub(super) fn nothing_active(problem: &Problem, cell: usize) -> Self {
        Self(format!(
            "contact alone holds the part of the mesh around {}, and nothing touches there: no edge can take what \
             its fluxes leave unbalanced",
            place(Cell::of(problem, cell).middle())
        ))
    }

    /// A load that has no finite square integral near a point, or is not proved to have one.
    pub(super) fn not_square(field: Field, at: [f64; 2], is_proved: bool) -> Self {
        let name = match field {
            Field::Flux => "the flux",
            Field::Limit => "the limit",
            Field::Ambient => "the ambient value",
            _ => "f",
        };
        let place = place(at);
        Self(match is_proved {
            true => format!(
                "{name} is not square integrable near {place}: what its means leave out has no finite norm"
            ),
            false => format!(
                "{name} can't be enclosed near {place}: what its means leave out is not known"
            ),
        })
    }

    /// So much of the loads' integrals may be missed, and nothing can take it.
    pub(super) fn unbalanced(missed: f64) -> Self {
        let reason = match missed.is_finite() {
            true => {
                format!("up to {missed:.2e} of the integrals of f, flux and limit is not resolved")
            }
            false => "f, flux or limit can't be enclosed somewhere".to_owned(),
        };
        Self(format!(
            "{reason}, and no dirichlet or robin edge can take it: a finer mesh may give a bound"
        ))
    }

    /// Numbers of the bound overflow the scalar.
    pub fn overflow<R: Scalar>() -> Self {
        Self(format!("the numbers of the bound overflow {}", R::NAME))
    }

    /// Nobody asked for a bound.
    pub fn not_asked() -> Self {
        Self::new("no bound was asked for")
    }
}

impl fmt::Display for NoBound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

fn middle(problem: &Problem, edge: usize) -> String {
    let [a, b] = problem.segment(edge);
    place([0, 1].map(|k| 0.5 * (a[k] + b[k])))
}

/// The name of the boundary that an edge lies on.
fn boundary(problem: &Problem, edge: usize) -> &str {
    problem.boundary_of(edge).map_or("default", |of| &of.name.value)
}

/// A point with six digits: where data are rough is not known better.
fn place(at: [f64; 2]) -> String {
    let [x, y] = at.map(|x| format!("{:.5e}", x + 0.0).parse().unwrap_or(x));
    format!("({x}, {y})")
}
