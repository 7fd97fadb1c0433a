//! Proofs about models whose matrix follows a transfer coefficient, against solutions of drawn inputs.

use super::super::follow::FollowedRanges;
use super::super::interval::Interval;
use super::{ALL, check_enclosed, inputs};
use crate::{ModalModel, modal};
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};

/// Warm below, cold air above that moves: the middle of the contact boundary is warmed least.
fn scene(limit: &str, air: [f64; 2], transfer: [f64; 2]) -> String {
    let (power, limit) = match limit {
        "input" => (
            "input.power = { of = \"contact\", field = \"limit\", pattern = \"1 + x/2\", \
             default = 1.0, range = [0.5, 1.5] }\n",
            "0",
        ),
        other => ("", other),
    };
    format!(
        "
mesh = \"grid\"
material.default.conductivity = \"1\"
boundary.dirichlet = {{ kind = \"robin\", coefficient = \"0\", ambient = \"0\" }}
boundary.left = {{ kind = \"robin\", coefficient = \"4\", ambient = \"5\" }}
boundary.right = {{ kind = \"neumann\", flux = \"0\" }}
boundary.contact = {{ kind = \"contact\", gap = \"0\", limit = \"{limit}\" }}
{power}[input.air]
of = \"dirichlet\"
field = \"ambient\"
pattern = \"1 + x/4\"
default = {}
range = {air:?}
[input.transfer]
of = \"dirichlet\"
field = \"coefficient\"
pattern = \"1\"
default = {}
range = {transfer:?}
[output]
power = {{ kind = \"force\" }}
passed = {{ kind = \"flux\", of = \"contact\" }}
mean = {{ kind = \"mean\", of = \"dirichlet\" }}
held = {{ kind = \"length\" }}
short = {{ kind = \"saturated\" }}
",
        air[0], transfer[0]
    )
}

/// Every solution and output of drawn inputs lies where it is proved to; how wide intervals of outputs are beside what was seen.
fn compare(modes: &ModalModel, found: &FollowedRanges, seed: u64) -> Vec<f64> {
    let ranges = &modes.model.ranges[..modes.inputs];
    let none = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY };
    let mut seen = vec![none; found.outputs.len()];
    for p in inputs(ranges, 300, seed) {
        let model = modes.in_own_scale(p[modes.input]);
        let values = check_enclosed(&model, &p, (&found.sides, &found.outputs), 0.0);
        values.iter().zip(&mut seen).for_each(|(x, of)| *of = of.hull(Interval::point(*x)));
    }
    let widths = seen.iter().zip(&found.outputs);
    widths.map(|(seen, proved)| proved.expect("one").width() / seen.width()).collect()
}

#[test]
fn solutions_outputs_and_sides_are_enclosed() -> Result<()> {
    let mut counts = [0; 4];
    for limit in ["inf", "1.5", "input"] {
        for air in [[-6.0, -5.0], [-20.0, -19.0], [-3.0, 1.0]] {
            for transfer in [[1.0, 1.2], [0.0, 50.0]] {
                let text = scene(limit, air, transfer);
                let (_, problem) = on_grid(&text, grid(6, Cells::Triangles))?;
                let (modes, _) = modal(&problem, 1e-12)?;
                let found = FollowedRanges::new(&modes).expect("finite loads").expect("proved");
                let sides = ALL.map(|side| found.sides.count(side));
                let widths = compare(&modes, &found, 7);
                // Of force, flux and mean, where they move at all; lengths are seen at few edges.
                let is_sharp = |&width: &f64| !(1.2..=1e9).contains(&width);
                assert!(widths[..3].iter().all(is_sharp), "{widths:?}");
                sides.iter().zip(&mut counts).for_each(|(count, sum)| *sum += count);
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 10), "{counts:?}");
    Ok(())
}

/// A range of one value is one piece, and reaches what it proves; an input without a range leaves nothing to prove.
#[test]
fn one_value_is_one_piece() -> Result<()> {
    let text = scene("1.5", [-6.0, -5.0], [3.0, 3.0]);
    let (_, problem) = on_grid(&text, grid(6, Cells::Triangles))?;
    let (modes, _) = modal(&problem, 0.0)?;
    let found = FollowedRanges::new(&modes).expect("finite loads").expect("proved");
    assert_eq!(found.pieces, 1);
    compare(&modes, &found, 3);
    let without = text.replace("range = [-6.0, -5.0]\n", "");
    let (_, problem) = on_grid(&without, grid(6, Cells::Triangles))?;
    let (modes, _) = modal(&problem, 0.0)?;
    assert!(FollowedRanges::new(&modes).expect("finite loads").is_none());
    Ok(())
}
