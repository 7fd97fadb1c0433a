//! Condensed models against the full solver, and what has none.

mod equality;
mod gaps;
mod limits;
mod limits_bound;
mod limits_same;
mod modes;
mod rejected;
mod settled;
mod stepped;
mod stepped_bound;
mod transfer;

use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_tolerances::Tolerance;
use signorini_tolerances::solve::CONDENSED;

use crate::{CondensedModel, Measure, condense};
use signorini_problem::Problem;
use signorini_problem::fixtures::{EVERY_INPUT as ALL, changed, on_grid, scatter};
use signorini_solve::fixtures::full_at;

/// Inputs of size `amount` around the defaults.
fn moved(model: &CondensedModel, amount: f64, seed: usize) -> Vec<f64> {
    let input = |(at, p): (usize, &f64)| p + amount * scatter(seed + at);
    let others = model.defaults.iter().enumerate().skip(1).map(input);
    std::iter::once(1.0).chain(others).collect()
}

/// Outputs against those of the full solver, over `scale` or their own size; bounds are the business of other tests.
fn check_outputs(
    allowed: Tolerance,
    model: &CondensedModel,
    [p, x]: [&[f64]; 2],
    expected: &[Option<f64>],
    scale: f64,
) {
    let found = model.outputs(p, x);
    for ((found, expected), measure) in found.iter().zip(expected).zip(&model.outputs) {
        if *measure != Measure::Bound {
            let (found, expected) = (found.expect("a value"), expected.expect("a value"));
            let size = expected.abs().max(scale);
            allowed.check_over(format_args!("{measure:?}"), found - expected, size);
        }
    }
}

/// How many are open, touch, and are at their limit.
fn states(x: &[f64]) -> [usize; 3] {
    let count = |is: fn(f64) -> bool| x.iter().filter(|&&x| is(x)).count();
    [count(|x| x > 0.0), count(|x| x == 0.0), count(|x| x < 0.0)]
}

/// Adds up what [`states`] counts.
fn add_to(sums: &mut [usize; 3], counts: [usize; 3]) {
    counts.into_iter().zip(sums).for_each(|(count, sum)| *sum += count);
}

/// States and lengths that [`compare`] has seen.
#[derive(Default)]
struct Seen {
    states: [usize; 3],
    /// Of contact, as the outputs have it.
    lengths: Vec<f64>,
}

/// Openings, fluxes and outputs of both models at some inputs of size `amount` around the defaults.
fn compare(problem: &Problem, amount: f64, rounds: usize) -> Result<Seen> {
    let model = condense(problem)?;
    assert_eq!(model.inputs, 1 + problem.scene.inputs.len());
    let mut seen = Seen::default();
    for round in 0..rounds {
        let p = moved(&model, amount, 17 * round);
        let (full, solution, expected) = full_at(problem, &p)?;
        let x = model.solve(&p).expect("a solution");
        add_to(&mut seen.states, states(&x));
        let largest = solution.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        // Between limits nothing may flow: fluxes are the rounding of u then.
        let flows = solution.largest_flux();
        let scale = if model.is_limited() { flows.max(largest) } else { flows };
        check_outputs(CONDENSED, &model, [&p, &x], &expected, scale);
        let lengths = expected.iter().zip(&model.outputs);
        let lengths = lengths.filter(|(_, of)| matches!(of, Measure::Length { .. }));
        seen.lengths.extend(lengths.filter_map(|(length, _)| *length));
        let edges = model.edges.iter().zip(&x).zip(model.residual(&p, &x)).enumerate();
        for (at, ((&of_contact, x), r)) in edges {
            let edge = full.topology.counts.free + of_contact;
            let opening = solution.u[edge] - full.loads.gap[of_contact];
            CONDENSED.check_over("opening", model.opening[at] * x - opening, largest);
            // The base of a model whose ends inputs change is the lower end, that of a scene the smaller one.
            let range = full.loads.flux_range(of_contact);
            let [least, most] = range.ends();
            let is_above = range.base() == most && !(model.is_varying() && least.is_finite());
            let base = if is_above { most } else { least };
            let off = r * model.multiplier[at] - (solution.flux[edge] - base);
            let size = if model.is_limited() { scale.max(base.abs()) } else { scale };
            CONDENSED.check_over(format_args!("flux {of_contact} {x} {range:?}"), off, size);
        }
    }
    Ok(seen)
}
