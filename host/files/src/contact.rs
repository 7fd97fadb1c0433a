//! States of contact edges: where u is, and how far from the gap.

use signorini_draw::ContactState;
use signorini_kernel::law::EdgeLaw;

use super::vtu::Contact;
use signorini_problem::Problem;
use signorini_solve::Solution;

/// Where u is on contact edge `at`, counted from the first one.
pub fn state(problem: &Problem, solution: &Solution, at: usize) -> ContactState {
    let (gap, range) = (solution.gap(problem, at), problem.loads.flux_range(at));
    let law = EdgeLaw::above(gap).with_span(range.span());
    match solution.u[problem.topology.counts.free + at] {
        u if law.touches(u) => ContactState::Touching,
        u if law.is_saturated(u) => ContactState::Saturated,
        _ => ContactState::Open,
    }
}

/// The word of a state in files, and its number there: the sign of u − ψ.
pub const fn written(state: ContactState) -> (&'static str, i8) {
    match state {
        ContactState::Open => ("open", 1),
        ContactState::Touching => ("touching", 0),
        ContactState::Saturated => ("saturated", -1),
    }
}

/// u − ψ on contact edge `at`; 0 where it touches.
pub fn opening(problem: &Problem, solution: &Solution, at: usize) -> f64 {
    match state(problem, solution, at) {
        ContactState::Touching => 0.0,
        _ => solution.u[problem.topology.counts.free + at] - solution.gap(problem, at),
    }
}

/// All contact edges for `contact.vtu`.
pub fn contact(problem: &Problem, solution: &Solution) -> Contact {
    let counts = problem.topology.counts;
    let names = problem.scene.boundaries.iter().map(|boundary| boundary.name.value.clone());
    let mut contact = Contact { names: names.collect(), ..Contact::default() };
    for at in 0..counts.contact {
        let edge = counts.free + at;
        contact.ends.push(problem.segment(edge));
        contact.lambda.push(solution.multiplier(problem, at) + 0.0);
        contact.gap.push(opening(problem, solution, at));
        contact.state.push(written(state(problem, solution, at)).1);
        let boundary = problem.binding.boundary(problem.ends[edge]);
        contact.boundary.push(boundary.unwrap_or_default());
    }
    contact
}
