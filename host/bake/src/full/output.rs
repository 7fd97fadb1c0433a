//! Declared outputs as the arrays that the target evaluates.

use signorini_device::full::Contribution;

use signorini_problem::Problem;
use signorini_problem::functional::{Functional, basis_at};
use signorini_problem::scalar::Scalar;
use signorini_scene::scene::Quantity;
use signorini_scene::scene::units::Units;

/// An output with its arrays.
#[derive(Debug, Clone)]
pub(super) enum Output<R> {
    Flux(Vec<u32>),
    Force(Vec<u32>),
    Length(Vec<Contribution<R, u32>>),
    Saturated(Vec<Contribution<R, u32>>),
    Probe(Vec<Contribution<R, u32>>),
    Bound,
}

impl<R: Scalar> Output<R> {
    /// In the scene's unit but for that of u, by which a controller multiplies: a content has that of A, too.
    #[must_use]
    pub fn in_scene(self, quantity: Quantity, units: &Units) -> Self {
        let unit = R::narrow(units.of_output(quantity) / units.u);
        match (self, quantity) {
            (Self::Probe(mut shares), Quantity::Content) => {
                shares.iter_mut().for_each(|share| share.weight *= unit);
                Self::Probe(shares)
            }
            (other, _) => other,
        }
    }
}

/// The arrays of what is read off a solution.
pub(super) fn output<R: Scalar>(problem: &Problem, functional: &Functional) -> Output<R> {
    let free = problem.topology.counts.free;
    let all = |edges: &[usize], first| edges.iter().map(|&edge| (edge - first) as u32).collect();
    let shares = |weights: &[(usize, f64)], first| {
        let share =
            |&(edge, weight)| Contribution { at: (edge - first) as u32, weight: R::narrow(weight) };
        weights.iter().map(share).collect()
    };
    match functional {
        Functional::Flux(edges) => Output::Flux(all(edges, 0)),
        Functional::Force(edges) => Output::Force(all(edges, free)),
        Functional::Probe(cell, point) => {
            Output::Probe(shares(&basis_at(problem, *cell, point), 0))
        }
        Functional::Linear(parts) => Output::Probe(shares(parts, 0)),
        Functional::Length(lengths) => Output::Length(shares(lengths, free)),
        // Where no flux has a limit the kernel has no code for it, and the length is 0.
        Functional::Saturated(_) if problem.loads.spans.is_empty() => Output::Probe(Vec::new()),
        Functional::Saturated(lengths) => Output::Saturated(shares(lengths, free)),
        // The controller puts the window in its place.
        Functional::Bound | Functional::Window => Output::Bound,
    }
}
