//! Scenes whose steps leave what steady boxes say, and what is proved of them.

use signorini_problem::fixtures::on_grid;
use signorini_problem::{Problem, State};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::{Options, SolverKind, solve};

use super::super::sides::{EdgeSide, Sides};
use super::lasting::{check, proved, scene, trajectory};
use crate::{condense, stepped};

/// The steady sides of a scene, those of exact steps, and by how much openings of jumps leave the steady box, over all that they are.
fn beside_the_steady_box(text: &str) -> Result<([Sides; 2], f64)> {
    let (_, problem) = on_grid(text, grid(4, Cells::Triangles))?;
    let steady = condense(&problem)?;
    let of = stepped(&problem, Some(usize::MAX))?.0;
    let sides = Sides::new(&steady).expect("finite loads");
    let known = sides.enclosure.as_ref().expect("an enclosure");
    let (ticks, own) = (trajectory(&of, 300, 5), proved(&of, &of.full));
    check(&own, &ticks, 1e-12);
    let (mut off, mut most) = (0.0_f64, 0.0_f64);
    for (at, x) in ticks.iter().flat_map(|x| x.iter().enumerate()) {
        let x = of.model.opening[at] / steady.opening[at] * x;
        (off, most) = (off.max(x - known.hi[at]).max(known.lo[at] - x), most.max(x));
    }
    Ok(([sides, own], off / most))
}

/// A steady gap above all else always touches. Once it falls, u follows, and is above it until then.
#[test]
fn a_gap_that_moves_leaves_the_steady_box() -> Result<()> {
    let more = "
boundary.right = { kind = \"neumann\", flux = \"0\" }
boundary.contact = { kind = \"contact\", gap = \"1\" }
input.depth = { of = \"contact\", field = \"gap\", pattern = \"1\", range = [-0.5, 0.5] }
";
    let ([steady, own], off) = beside_the_steady_box(&scene(more, 0.1))?;
    assert_eq!(steady.count(EdgeSide::Touching), steady.of.len());
    assert_eq!(own.count(EdgeSide::MayChange), own.of.len());
    assert!(off > 0.99, "{off}");
    Ok(())
}

/// A source near contact and one far from it, whose fluxes cancel there in the end and not before: ∫(1 − y)(1 − 3y) = 0.
#[test]
fn sources_that_cancel_leave_the_steady_box() -> Result<()> {
    let more = "
boundary.right = { kind = \"neumann\", flux = \"0\" }
boundary.contact = { kind = \"contact\", gap = \"-0.1\" }
input.heat = { of = \"source\", field = \"f\", pattern = \"1 - 3*y\", range = [-5.0, 5.0] }
";
    let ([steady, own], off) = beside_the_steady_box(&scene(more, 0.05))?;
    assert_eq!(steady.count(EdgeSide::Open), steady.of.len());
    assert!(own.count(EdgeSide::MayChange) > 0 && off > 0.3, "{off}");
    Ok(())
}

/// All openings of u at these inputs: steady, or after the step from `state`.
fn openings(problem: &Problem, p: &[f64], state: Option<State>) -> Result<(Vec<f64>, State)> {
    let direct = Options::by(SolverKind::Direct);
    let given = problem.with_inputs(p)?;
    let given = match state {
        Some(state) => given.stepping(0.05, state)?,
        None => given,
    };
    let found = solve(&given, &direct)?;
    let free = problem.topology.counts.free;
    let edges = given.loads.gap.iter().enumerate();
    let all = edges.map(|(at, gap)| found.u[free + at] - gap).collect();
    Ok((all, found.state()))
}

/// The union of steady answers over a coefficient's range is left while it moves, by more than half of its width. Nothing is claimed: there are no
/// condensed steps.
#[test]
fn a_coefficient_that_moves_leaves_all_steady_answers() -> Result<()> {
    let more = "
boundary.right = { kind = \"robin\", coefficient = \"0\", ambient = \"0\" }
boundary.contact = { kind = \"contact\", gap = \"-0.2\" }
input.wind = { of = \"right\", field = \"coefficient\", pattern = \"1\", default = 1.0, range = [0.2, 20.0] }
input.heat = { of = \"source\", field = \"f\", pattern = \"1 - 3*y\", range = [-5.0, 5.0] }
";
    let (_, problem) = on_grid(&scene(more, 0.05), grid(4, Cells::Triangles))?;
    assert!(
        stepped(&problem, Some(4)).err().is_some_and(|error| error.to_string().contains("matrix"))
    );
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    for wind in [0.2, 0.7, 2.0, 6.0, 20.0] {
        for heat in [-5.0, 0.0, 5.0] {
            for x in openings(&problem, &[wind, heat], None)?.0 {
                ends = [ends[0].min(x), ends[1].max(x)];
            }
        }
    }
    let mut state = openings(&problem, &[1.0, 0.0], None)?.1;
    let mut off = 0.0_f64;
    for tick in 0..40 {
        let p = if tick / 4 % 2 == 0 { [0.2, 5.0] } else { [20.0, -5.0] };
        let (x, after) = openings(&problem, &p, Some(state))?;
        state = after;
        off = x.iter().fold(off, |off, x| off.max(x - ends[1]).max(ends[0] - x));
    }
    assert!(off > 0.5 * (ends[1] - ends[0]), "{off} {ends:?}");
    Ok(())
}
