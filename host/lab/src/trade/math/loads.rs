//! Functions in the load data: u_D, ψ, f, g, q and the ambient, as a controller evaluates them.
//!
//! The patterns of inputs have no t and are tables on a device; their functions are not counted.

use super::super::record::FunctionCost;
use crate::mesh_solution::solve_directly;
use signorini_bake::costs::Costs;
use signorini_problem::{Assembled, EdgeKind, Problem};
use signorini_scene::expression::{Arithmetic, Elementary};
use signorini_scene::scene::term::each_load;
use signorini_scene::scene::{Field, Located};
use signorini_scene::{Expression, Result, Scene};
use signorini_solve::{Solution, unfit};

const FIELDS: [Field; 4] = [Field::Value, Field::Gap, Field::Flux, Field::Ambient];

/// The function's name in the row of f32 alone.
const SINGLE: &str = "f32 with libm";

/// A row for each function that the loads call, after one for f32 with libm, which any of them adds to.
pub(super) fn rows(problem: &Problem) -> Result<Vec<FunctionCost>> {
    let (loads, costs) = (loads(problem), Costs::measured());
    let row = |name: &str, keys: Vec<&str>, calls: usize| FunctionCost {
        function: name.to_owned(),
        used_in: keys.join(", "),
        calls: calls as u64,
        saved: costs.saved_by(name).unwrap_or_default(),
        ..FunctionCost::default()
    };
    let (mut uses, mut all) = (Vec::new(), Vec::new());
    for function in Elementary::ALL {
        let called = loads.iter().filter(|(load, _)| load.value.calls(function) > 0);
        let keys: Vec<&str> = called.clone().map(|(load, _)| load.key.as_str()).collect();
        let calls = called.map(|(load, places)| load.value.calls(function) * places).sum();
        if !keys.is_empty() {
            all.extend(keys.clone());
            uses.push((Arithmetic::Fast(function), row(function.name(), keys, calls)));
        }
    }
    if uses.is_empty() {
        return Ok(Vec::new());
    }
    all.sort_unstable();
    all.dedup();
    uses.insert(0, (Arithmetic::Single, row(SINGLE, all, 0)));
    let unfit = unfit::<f64>(&problem.scene);
    let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
    let before = solve_directly(problem)?;
    let changed =
        |(arithmetic, row): (Arithmetic, FunctionCost)| match replaced(problem, arithmetic) {
            Ok(solution) => row.changed(&assembled, &before, &solution).map_err(&unfit),
            Err(error) => Ok(FunctionCost { note: Some(error.reason()), ..row }),
        };
    uses.into_iter().map(changed).collect()
}

/// Every load, and the number of cells or edges that it stands on.
fn loads(problem: &Problem) -> Vec<(&Located<Expression>, usize)> {
    let mut edges = vec![0; problem.scene.boundaries.len()];
    for (&ends, &kind) in problem.ends.iter().zip(&*problem.kinds) {
        if let (Some(at), true) = (problem.binding.boundary(ends), kind != EdgeKind::Interior) {
            edges[at] += 1;
        }
    }
    let on_boundaries = problem.scene.boundaries.iter().zip(edges).flat_map(|(boundary, edges)| {
        FIELDS.iter().filter_map(move |&field| Some((boundary.condition.datum(field)?, edges)))
    });
    std::iter::once((&problem.scene.source, problem.cells())).chain(on_boundaries).collect()
}

/// The solution with all loads evaluated in `arithmetic`.
fn replaced(problem: &Problem, arithmetic: Arithmetic) -> Result<Solution> {
    let mut scene = Scene::clone(&problem.scene);
    each_load(&mut scene, |load| load.value = load.value.with_arithmetic(arithmetic));
    solve_directly(&problem.with_loads_of(scene)?)
}
