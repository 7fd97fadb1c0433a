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
        let found = solve(&problem, &Options { solver, ..Options::default() })?;
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
            let found = solve(&problem, &Options { solver, ..Options::default() })?;
            assert_eq!(free_levels(&problem, &found)?, [], "{solver:?}: {:?}", found.u);
        }
    }
    Ok(())
}
