//! Contact whose flux has two ends, condensed: the answers and outputs of the full solver.

use super::*;
use signorini_problem::fixtures::distorted;
use signorini_problem::fixtures::limited::{drawn, wall};
use signorini_reference::ReferenceError;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::cases;

/// Every input of the fixture, with a limit that lets a part of the edge fall below the gap.
pub(super) fn limited(ends: &str, more: &str) -> String {
    let text = ALL.replace("flux = \"-0.1*x^2\"", ends);
    assert_ne!(text, ALL);
    let saturated = "output.short = { kind = \"saturated\", of = \"contact\" }\n\
                     output.through = { kind = \"flux\", of = \"contact\" }\n";
    text + saturated + more
}

/// The ends of the fixture: from below, with a base above, without a lower end, and with both finite ones.
pub(super) const ENDS: [&str; 5] = [
    "flux = \"-0.1*x^2\", limit = \"0.3\"",
    "flux = \"-3\", limit = \"0.2 + 0.1*x\"",
    "flux = \"-inf\", limit = \"0.1*x\"",
    "flux = \"-0.4 - 0.1*x\", limit = \"-0.1*x\"",
    "flux = \"-0.1\", limit = \"1e9\"",
];

#[test]
fn every_input_and_range_on_all_cells() -> Result<()> {
    let mut sums = [0; 3];
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for ends in ENDS {
            let text = limited(ends, "");
            // No input of an end: `rain` acts on the flux.
            let fixed = text
                .replace("of = \"contact\", field = \"flux\"", "of = \"right\", field = \"flux\"");
            assert_ne!(fixed, text);
            for mesh in [grid(5, cells), distorted(grid(4, cells))] {
                let (_, problem) = on_grid(&fixed, mesh)?;
                add_to(&mut sums, compare(&problem, 0.3, 4)?.states);
            }
        }
    }
    assert!(sums.iter().all(|&count| count > 60), "{sums:?}");
    Ok(())
}

/// Inputs of both ends, which also turn round which end is the smaller one.
#[test]
fn inputs_of_both_ends() -> Result<()> {
    let room =
        "[input.room]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1 + x\"\ndefault = 0.6\n";
    let mut sums = [0; 3];
    for cells in [Cells::Triangles, Cells::Quads] {
        for (ends, more) in [(ENDS[0], room), (ENDS[1], room), (ENDS[1], ""), (ENDS[2], room)] {
            // Without a lower end nothing can be added to it.
            let text = match ends.contains("inf") {
                true => limited(ends, more).replace(
                    "field = \"flux\", pattern = \"1 + x\"",
                    "field = \"limit\", pattern = \"1 + x\"",
                ),
                false => limited(ends, more),
            };
            let (_, problem) = on_grid(&text, grid(5, cells))?;
            let model = condense(&problem)?;
            assert!(ends.contains("inf") || model.is_varying(), "{ends}");
            add_to(&mut sums, compare(&problem, 0.25, 6)?.states);
        }
    }
    assert!(sums.iter().all(|&count| count > 30), "{sums:?}");
    Ok(())
}

/// An input that puts the upper end below the lower one is refused.
#[test]
fn a_limit_below_the_flux_is_refused() -> Result<()> {
    let room = "[input.room]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1\"\n";
    let (_, problem) =
        on_grid(&limited("flux = \"0\", limit = \"1\"", room), grid(3, Cells::Triangles))?;
    let model = condense(&problem)?;
    let mut p = model.defaults.clone();
    p[2] = 0.0;
    let last = p.len() - 1;
    for (room, is_refused) in [(0.0, false), (-1.0, false), (-1.001, true)] {
        p[last] = room;
        assert_eq!(model.solve(&p).is_err(), is_refused, "{room}");
    }
    Ok(())
}

/// Ends that are equal, nearly equal, far, and infinite on either side, on two boundaries.
#[test]
fn random_problems_agree_with_the_full_solver() -> Result<()> {
    let mut sums = [0; 3];
    let (mut counted, all) = (0, cases(150));
    for seed in 1..=all {
        let (text, mesh) = drawn(seed);
        let Ok((_, problem)) = on_grid(&text, mesh) else { continue };
        add_to(&mut sums, compare(&problem, 0.0, 1)?.states);
        counted += 1;
    }
    assert!(counted > all / 2, "{counted}");
    assert!(sums.iter().all(|&count| count as u64 > all / 3), "{sums:?}");
    Ok(())
}

/// Duvaut and Lions in one dimension.
#[test]
fn walls_heat_as_the_full_model_does() -> Result<()> {
    for (above, ends) in [
        ("2", "flux = \"0\", limit = \"3\""),
        ("0.25", "flux = \"0\", limit = \"3\""),
        ("-1", "flux = \"-2\", limit = \"3\""),
        ("2.5", "flux = \"-inf\", limit = \"0\""),
        ("-1", "flux = \"-1e16\", limit = \"3\""),
        ("0", "flux = \"0.3\", limit = \"1e30\""),
        ("2", "flux = \"1.5\", limit = \"1.5\""),
    ] {
        let (_, problem) = on_grid(&wall(above, ends), grid(4, Cells::Mixed))?;
        compare(&problem, 0.0, 1)?;
    }
    Ok(())
}

/// A part that contact with limits alone holds: loads that its fluxes can balance.
#[test]
fn a_part_that_contact_with_limits_holds() -> Result<()> {
    let text = "mesh = \"grid\"\n[material.default]\nconductivity = \"1\"\n[boundary.default]\nkind = \"neumann\"\n\
        flux = \"0.2*sin(2*x) - 0.3\"\n[boundary.contact]\nkind = \"contact\"\ngap = \"0.02*cos(3*x)\"\nflux = \"-0.4\"\n\
        limit = \"0.9\"\n[source]\nf = \"0\"\n[input.heat]\nof = \"source\"\nfield = \"f\"\npattern = \"1 + x\"\n";
    let mut sums = [0; 3];
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(text, grid(5, cells))?;
        let model = condense(&problem)?;
        assert_eq!(model.held_by_contact.len(), 1);
        for heat in [-0.2, 0.0, 0.5, 0.9] {
            let p = [1.0, heat];
            let x = model.solve(&p).expect("a solution");
            add_to(&mut sums, states(&x));
            let (_, solution, _) = full_at(&problem, &p)?;
            let of_mesh = solution.bound.expect("a bound").total;
            let bound = model.bound(&p, &x).expect("a bound");
            assert!((0.5..1.25).contains(&(bound / of_mesh)), "{bound} {of_mesh}");
            compare(&problem.with_inputs(&[heat])?, 0.0, 1)?;
        }
        // ∫f = 2 heat against −1.2 at sides and top, and −0.8 to 1.8 below.
        for heat in [-0.31, 1.01] {
            assert!(
                matches!(model.solve(&[1.0, heat]), Err(ReferenceError::Unbounded { .. })),
                "{heat}"
            );
        }
    }
    assert!(sums.iter().all(|&count| count > 0), "{sums:?}");
    Ok(())
}
