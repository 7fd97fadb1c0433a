//! States of contact edges: where u is, and how far from the gap.

use signorini_kernel::law::EdgeLaw;

use super::vtu::Contact;
use signorini_problem::Problem;
use signorini_solve::Solution;

/// Where u is on a contact edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// u > ψ
    Open,
    /// u = ψ
    Touching,
    /// u < ψ: the flux is at its limit.
    Saturated,
}

impl State {
    /// Of contact edge `at`, counted from the first one.
    pub fn of(problem: &Problem, solution: &Solution, at: usize) -> Self {
        let (gap, range) = (solution.gap(problem, at), problem.loads.flux_range(at));
        let law = EdgeLaw::above(gap).with_span(range.span());
        match solution.u[problem.topology.counts.free + at] {
            u if law.touches(u) => Self::Touching,
            u if law.is_saturated(u) => Self::Saturated,
            _ => Self::Open,
        }
    }

    /// Its word in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Touching => "touching",
            Self::Saturated => "saturated",
        }
    }

    /// Its number in files: the sign of u − ψ.
    pub const fn sign(self) -> i8 {
        match self {
            Self::Open => 1,
            Self::Touching => 0,
            Self::Saturated => -1,
        }
    }
}

/// All contact edges for `contact.vtu`.
pub fn contact(problem: &Problem, solution: &Solution) -> Contact {
    let counts = problem.topology.counts;
    let names = problem.scene.boundaries.iter().map(|boundary| boundary.name.value.clone());
    let mut contact = Contact { names: names.collect(), ..Contact::default() };
    for at in 0..counts.contact {
        let edge = counts.free + at;
        let state = State::of(problem, solution, at);
        let opening = solution.u[edge] - solution.gap(problem, at);
        contact.ends.push(problem.segment(edge));
        contact.lambda.push(solution.multiplier(problem, at) + 0.0);
        contact.gap.push(if state == State::Touching { 0.0 } else { opening });
        contact.state.push(state.sign());
        let boundary = problem.binding.boundary(problem.ends[edge]);
        contact.boundary.push(boundary.unwrap_or_default());
    }
    contact
}
