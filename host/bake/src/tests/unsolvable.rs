//! Inputs whose loads contact cannot hold, or holds at no one place, in ticks of a condensed model: against loads added up by hand and what the host
//! says of the same problem, and the ticks that follow against a controller that was never asked.

use crate::Bakes;
use crate::condensed::{Baked, Controller, Work};
use signorini_condense::condense;
use signorini_kernel::Error;
use signorini_kernel::error::CellId;
use signorini_problem::fixtures::{changed, on_grid};
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_problem::{Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};

/// ∫f = 0.6, ∫g = −1 + push, and at least −0.2 of the contact: loads push on it for push < 0.6.
const FREE: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "0.3 - x"
boundary.dirichlet = { kind = "neumann", flux = "0.1*x" }
boundary.left = { kind = "neumann", flux = "-1" }
boundary.right = { kind = "contact", gap = "0.1*y", flux = "-0.2" }
boundary.contact = { kind = "contact", gap = "0.1*x^2" }
input.push = { of = "left", field = "flux", pattern = "1", range = [-3, 3] }
input.sink = { of = "source", field = "f", pattern = "1 - y", range = [-0.1, 0.1] }
output.force = { kind = "force" }
output.skin = { kind = "mean", of = "contact" }
"#;

/// The same, whose contact carries at most 0.3 on the right and 2 (0.5 + supply) below: only push > −0.9 − 2 supply is held.
fn two_ends() -> String {
    let supply = "input.supply = { of = \"contact\", field = \"limit\", pattern = \"1\", range = [-0.4, 1] }\n";
    let limits = [
        ("flux = \"-0.2\"", "flux = \"-0.2\", limit = \"0.3\""),
        ("gap = \"0.1*x^2\"", "gap = \"0.1*x^2\", flux = \"0\", limit = \"0.5\""),
    ];
    changed(FREE, &limits) + supply
}

/// Nothing holds u from below: only push > −0.9 is held.
fn from_above() -> String {
    let limits = [
        ("flux = \"-0.2\"", "flux = \"-inf\", limit = \"0.3\""),
        ("gap = \"0.1*x^2\"", "gap = \"0.1*x^2\", flux = \"-inf\", limit = \"0.5\""),
        ("range = [-3, 3]", "default = 1, range = [-3, 3]"),
    ];
    changed(FREE, &limits)
}

/// How a tick is refused, if it is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Answered,
    NotUnique,
    NoSolution,
}
use End::{Answered, NoSolution, NotUnique};

fn end(error: Option<Error>) -> End {
    match error {
        None => Answered,
        Some(Error::NotUnique { .. }) => NotUnique,
        Some(Error::NoSolution { .. }) => NoSolution,
        Some(other) => panic!("{other}"),
    }
}

/// The host's verdict on the problem with these inputs.
fn of_host(problem: &Problem, inputs: &[f64]) -> Result<End> {
    let error = Parts::examine(&problem.with_inputs(inputs)?).err();
    Ok(end(error.map(|error| error.cause().unwrap_or(Error::Degenerate(CellId::Triangle(0))))))
}

/// Ticks of one controller, and those among them that it answers of another one, which has the same answers.
fn ticked<R: Bakes>(problem: &Problem, baked: &Baked<R>, inputs: &[Vec<f64>]) -> Result<Vec<End>> {
    let (mut controller, mut spared) = (Controller::new(baked), Controller::new(baked));
    let mut ends = Vec::new();
    for p in inputs {
        let own: Vec<R> = p.iter().map(|&p| R::narrow(p)).collect();
        let before = controller.x().to_vec();
        let found = match controller.tick(&own) {
            Ok((outputs, report)) => {
                let (others, other) = spared.tick(&own).expect("the same answer");
                assert_eq!((&outputs, report), (&others, other), "{p:?}");
                Answered
            }
            Err(error) => {
                assert_eq!(controller.x(), before, "{p:?}: a refused tick has moved x");
                end(Some(error))
            }
        };
        let expected = of_host(problem, p)?;
        assert_eq!(found, expected, "{} at {p:?}", R::NAME);
        ends.push(found);
    }
    Ok(ends)
}

/// The inputs one after the other, and many drawn in their ranges, in both scalars and by both methods.
fn held(text: &str, given: &[(&[f64], End)]) -> Result<()> {
    let (_, problem) = on_grid(text, grid(4, Cells::Triangles))?;
    let model = condense(&problem)?;
    let steps: Vec<Vec<f64>> = given.iter().map(|(p, _)| p.to_vec()).collect();
    let expected: Vec<End> = given.iter().map(|(_, end)| *end).collect();
    let many: Vec<Vec<f64>> = drawn(&InputSpace::of(&problem.scene), 200).collect();
    for pivots in [Some(400), None] {
        let work = Work { pivots, sweeps: 400 };
        let wide = Baked::<f64>::new(&model, work, true).expect("in range");
        let narrow = Baked::<f32>::new(&model, work, true).expect("in range");
        assert_eq!(ticked(&problem, &wide, &steps)?, expected);
        assert_eq!(ticked(&problem, &narrow, &steps)?, expected);
        for ends in [ticked(&problem, &wide, &many)?, ticked(&problem, &narrow, &many)?] {
            assert!(ends.contains(&Answered) && ends.contains(&NoSolution));
        }
    }
    Ok(())
}

#[test]
fn loads_that_pull_off_the_contact_are_refused() -> Result<()> {
    held(
        FREE,
        &[
            (&[0.0, 0.0], Answered),
            (&[0.61, 0.0], NoSolution),
            (&[0.59, 0.0], Answered),
            (&[0.6, 0.0], NotUnique),
            // ∫(1 − y) = 1
            (&[0.5, 0.1], NotUnique),
            (&[0.6, -0.05], Answered),
            (&[3.0, 0.0], NoSolution),
            (&[0.0, 0.0], Answered),
        ],
    )
}

#[test]
fn loads_beyond_both_ends_of_the_fluxes_are_refused() -> Result<()> {
    held(
        &two_ends(),
        &[
            (&[0.0, 0.0, 0.0], Answered),
            (&[-0.91, 0.0, 0.0], NoSolution),
            (&[-0.9, 0.0, 0.0], NotUnique),
            (&[-0.89, 0.0, 0.0], Answered),
            (&[-1.1, 0.0, 0.1], NotUnique),
            (&[-1.1, 0.0, 0.2], Answered),
            (&[0.6, 0.0, 0.2], NotUnique),
            (&[0.7, 0.0, 0.2], NoSolution),
            (&[0.0, 0.0, 0.0], Answered),
        ],
    )
}

#[test]
fn loads_that_no_limit_from_above_carries_are_refused() -> Result<()> {
    held(
        &from_above(),
        &[
            (&[1.0, 0.0], Answered),
            (&[-0.91, 0.0], NoSolution),
            (&[-0.9, 0.0], NotUnique),
            (&[-0.89, 0.0], Answered),
            (&[3.0, 0.0], Answered),
        ],
    )
}
