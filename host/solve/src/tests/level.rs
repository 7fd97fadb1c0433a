//! Parts that contact with limits alone holds, and whose level may move.

use signorini_tolerances::solve::DUVAUT;

use super::{Options, SolverKind, solve};
use crate::free_levels;
use signorini_problem::Problem;
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};

/// A slab between a drain on the left and a heater on the right, each with its gap and ends; insulated above and below.
fn slab(f: &str, left: [&str; 3], right: [&str; 3]) -> Result<Problem> {
    let contact = |name: &str, [gap, least, most]: [&str; 3]| {
        format!(
            "[boundary.{name}]\nkind = \"contact\"\ngap = \"{gap}\"\nflux = \"{least}\"\nlimit = \"{most}\"\n"
        )
    };
    let closed = |name: &str| format!("[boundary.{name}]\nkind = \"neumann\"\nflux = \"0\"\n");
    let text = format!(
        "mesh = \"grid\"\n[material.default]\nconductivity = \"1\"\n[source]\nf = \"{f}\"\n{}{}{}{}",
        contact("left", left),
        contact("right", right),
        closed("dirichlet"),
        closed("contact"),
    );
    Ok(on_grid(&text, grid(3, Cells::Mixed))?.1)
}

/// u = c on all of it for any c from -0.1 to 0.2, with no flux anywhere.
#[test]
fn a_level_between_two_gaps_is_free_and_told() -> Result<()> {
    let problem = slab("0", ["0.2", "-1", "0"], ["-0.1", "0", "1"])?;
    // The reference's active set does not settle there, and says so.
    for solver in [SolverKind::Kernel, SolverKind::Auto] {
        let found = solve(&problem, &Options::by(solver))?;
        let levels = free_levels(&problem, &found)?;
        let [level] = levels[..] else { panic!("{solver:?}: {levels:?}") };
        let u = found.u[0];
        DUVAUT.check(format_args!("{solver:?}: down"), level.by[0] - (u + 0.1));
        DUVAUT.check(format_args!("{solver:?}: up"), level.by[1] - (0.2 - u));
        assert!(level.sentence().contains("more than one solution"), "{}", level.sentence());
    }
    Ok(())
}

/// With a load, or gaps the other way round, one edge at least holds on to its gap.
#[test]
fn a_level_that_an_edge_holds_is_not_told() -> Result<()> {
    let cases = [
        slab("0.1", ["0.2", "-1", "0"], ["-0.1", "0", "1"])?,
        slab("-0.1", ["0.2", "-1", "0"], ["-0.1", "0", "1"])?,
        slab("0", ["-0.1", "-1", "0"], ["0.2", "0", "1"])?,
        slab("0", ["0.2", "-1", "1"], ["-0.1", "-1", "1"])?,
    ];
    for problem in cases {
        for solver in [SolverKind::Kernel, SolverKind::Direct] {
            let found = solve(&problem, &Options::by(solver))?;
            assert_eq!(free_levels(&problem, &found)?, [], "{solver:?}: {:?}", found.u);
        }
    }
    Ok(())
}

/// What rains on a plate leaves below at the most that may pass, or not at all and above: u may be anywhere between both gaps, less what it
/// rises by. A solver that stops at an end of that leaves edges on their gap, with a flux that is at its end but for rounding.
#[test]
fn a_level_is_told_at_the_end_of_its_room() -> Result<()> {
    let text = "
mesh = \"grid\"
material.default.conductivity = \"1\"
source.f = \"-1\"
boundary.contact = { kind = \"contact\", gap = \"-10\", flux = \"0\", limit = \"1\" }
boundary.dirichlet = { kind = \"contact\", gap = \"10\", flux = \"0\", limit = \"1\" }
boundary.left = { kind = \"neumann\", flux = \"0\" }
boundary.right = { kind = \"neumann\", flux = \"0\" }
";
    for n in [1, 4, 8, 16] {
        let (_, problem) = on_grid(text, grid(n, Cells::Triangles))?;
        for solver in [SolverKind::Kernel, SolverKind::Auto] {
            let found = solve(&problem, &Options::by(solver))?;
            let levels = free_levels(&problem, &found)?;
            let [level] = levels[..] else { panic!("{n}, {solver:?}: {levels:?}") };
            let room = level.by[0] + level.by[1];
            assert!((room - 19.5).abs() < 1e-6, "{n}, {solver:?}: {room}");
        }
    }
    Ok(())
}
