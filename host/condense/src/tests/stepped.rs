//! Steps of condensed models against those of the full solver.

use super::*;
use crate::{SteppedModel, stepped};
use signorini_problem::State;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::{Options, SolverKind, Start, solve, step_of};
use signorini_tolerances::solve::{STEPPED, STEPPED_START};

/// A capacity all over, in one half alone, or next to none beside some.
const CAPACITIES: [&str; 3] = [
    "material.default = { conductivity = [\"2\", \"0.5\", \"1\"], capacity = \"1 + x^2\" }",
    "material.left = { conductivity = [\"2\", \"0.5\", \"1\"] }\n\
     material.right = { conductivity = \"1\", capacity = \"3\" }",
    "material.left = { conductivity = \"5\", capacity = \"1e-6\" }\n\
     material.right = { conductivity = \"1\", capacity = \"3\" }",
];

fn scene_of(capacity: &str, more: &str) -> String {
    let own = "material.default.conductivity = [\"2\", \"0.5\", \"1\"]";
    let limited = "flux = \"-0.1*x^2\"";
    let changes = [(own, capacity), (limited, "flux = \"-0.1*x^2\", limit = \"0.5\"")];
    changed(ALL, &changes) + "\ntime.step = 0.05\n" + more
}

/// By how much u of the condensed ticks differs from that of the full ones on any edge, tick by tick, over the largest u; and the sides
/// that edges were on.
fn differences(
    text: &str,
    cells: Cells,
    memory: usize,
    ticks: usize,
) -> Result<(Vec<f64>, SteppedModel)> {
    let (_, problem) = on_grid(text, grid(4, cells))?;
    let (of, recovery) = stepped(&problem, Some(memory))?;
    let (length, model) = (step_of(&problem.scene)?, &of.model);
    let mut state = Start::of(&problem, length)?.expect("a start").solution.state();
    let mut past = of.start().to_vec();
    let (mut found, mut seen) = (Vec::new(), [0; 3]);
    for tick in 0..ticks {
        let mut p = moved(model, 0.4, 17 * (tick / 3));
        p.truncate(of.inputs);
        let now = problem.with_inputs(&p[1..])?.stepping(length, state)?;
        let solution = solve(&now, &Options::by(SolverKind::Direct))?;
        let terms = [&p[..], &past].concat();
        let x = model.solve(&terms).expect("a solution");
        add_to(&mut seen, states(&x));
        let (u, flux) = recovery.field(model, &terms, &x);
        let apart =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let largest = solution.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        let of_flux = apart(&flux, &solution.flux) / solution.largest_flux().max(largest);
        found.push((apart(&u, &solution.u) / largest).max(of_flux));
        of.advance(&mut past, &p, &x);
        state = State { ..solution.state() };
    }
    assert!(seen.iter().all(|&count| count > 0), "{seen:?}");
    Ok((found, of))
}

/// With all modes each tick is the full model's, on every edge.
#[test]
fn with_all_modes_a_tick_is_that_of_the_full_model() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for capacity in CAPACITIES {
            let (found, of) = differences(&scene_of(capacity, ""), cells, usize::MAX, 12)?;
            assert_eq!(of.fading.len(), of.modes);
            let most = found.into_iter().fold(0.0, f64::max);
            STEPPED.check_over(format_args!("{cells:?} {capacity}"), most, 1.0);
        }
    }
    Ok(())
}

/// Fewer states are further off, and soon near.
#[test]
fn states_bring_the_memory_back() -> Result<()> {
    for initial in ["", "time.initial = \"x*y\"\n"] {
        let mut before = f64::INFINITY;
        for memory in [1, 8, 32] {
            let text = scene_of(CAPACITIES[0], initial);
            let (found, of) = differences(&text, Cells::Triangles, memory, 9)?;
            let most = found.iter().fold(0.0, |most: f64, x| most.max(*x));
            assert!(
                of.fading.len() == memory
                    && of.fading.iter().all(|omega| (0.0..1.0).contains(omega))
            );
            assert!(most < 0.5 * before, "{initial} {memory}: {most} {before}");
            before = most;
        }
        assert!(before < 1e-4, "{initial}: {before}");
    }
    Ok(())
}

/// A steady state stays, whatever little is remembered.
#[test]
fn a_steady_state_is_exact_with_any_states() -> Result<()> {
    for capacity in CAPACITIES {
        let (_, problem) = on_grid(&scene_of(capacity, ""), grid(4, Cells::Mixed))?;
        let steady = problem.with_inputs(&[])?;
        let full = solve(&steady, &Options::by(SolverKind::Direct))?;
        for memory in [0, 1, 5] {
            let (of, recovery) = stepped(&problem, Some(memory))?;
            let mut past = of.start().to_vec();
            let p = of.model.defaults[..of.inputs].to_vec();
            for _ in 0..3 {
                let terms = [&p[..], &past].concat();
                let x = of.model.solve(&terms).expect("a solution");
                let (u, _) = recovery.field(&of.model, &terms, &x);
                let largest = full.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
                for (found, expected) in u.iter().zip(&full.u) {
                    STEPPED_START.check_over("u", found - expected, largest);
                }
                of.advance(&mut past, &p, &x);
            }
            assert!(past[past.len() - memory..].iter().all(|y| y.abs() < 1e-10), "{past:?}");
        }
    }
    Ok(())
}

/// A part that contact alone holds, or nothing, and a coefficient that moves have no such model.
#[test]
fn what_has_no_condensed_steps_is_refused() -> Result<()> {
    let why = |text: &str| -> Result<String> {
        let (_, problem) = on_grid(text, grid(3, Cells::Triangles))?;
        Ok(stepped(&problem, Some(4)).err().map_or_else(String::new, |error| error.to_string()))
    };
    let own = "material.default = { conductivity = \"1\", capacity = \"1\" }\ntime = { step = 0.1, initial = \"0\" }\nmesh = \"grid\"\n";
    let contact = "boundary.contact = { kind = \"contact\" }\nboundary.dirichlet = { kind = \"neumann\", flux = \"-1\" }\n";
    let found = why(&format!("{own}{contact}"))?;
    assert!(found.contains("contact alone holds a part"), "{found}");
    let wall =
        signorini_problem::fixtures::transfer_wall("1", "pattern = \"1\", range = [0.0, 1.0]");
    let found = why(&(changed(
        &wall,
        &[(
            "material.default.conductivity = \"2\"",
            "material.default = { conductivity = \"2\", capacity = \"1\" }",
        )],
    ) + "time.step = 0.1\n"))?;
    assert!(found.contains("it changes the matrix"), "{found}");
    Ok(())
}
