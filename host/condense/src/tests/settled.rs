//! Models of steps without the edges that no step puts on another side.

use super::*;
use crate::ranges::lasting::lasting;
use crate::{Recovery, SteppedModel, settled, stepped};
use signorini_certify::ends::Ends;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::{SETTLED, SETTLED_FLUX};

/// Contact below that touches on the left, is open on the right, and goes to and fro between.
const SCENE: &str = r#"
mesh = "grid"
material.left = { conductivity = ["2", "0.2", "1"], capacity = "2" }
material.right = { conductivity = "1", capacity = "3" }
boundary.dirichlet = { kind = "dirichlet", value = "0" }
boundary.left = { kind = "neumann", flux = "0" }
boundary.right = { kind = "robin", coefficient = "0.5", ambient = "0" }
boundary.contact = { kind = "contact", gap = "-0.1 - 0.5*x", flux = "-0.05*x" }
input.air = { of = "right", field = "ambient", pattern = "1", range = [-0.3, 0.2] }
input.heat = { of = "source", field = "f", pattern = "1 + x", default = -0.1, range = [-0.2, 0.1] }
input.suction = { of = "contact", field = "flux", pattern = "1", range = [-0.02, 0.02] }
output.force = { kind = "force" }
output.flux = { kind = "flux", of = ["contact", "right"] }
output.length = { kind = "length" }
output.air = { kind = "mean", of = "right" }
output.middle = { kind = "probe", at = [0.1, 0.4] }
"#;

/// The model of a step of this length with all edges and without those that keep their side, each with its way back.
fn both(length: f64, memory: usize) -> Result<(Problem, [(SteppedModel, Recovery); 2])> {
    let text = format!("{SCENE}time.step = {length}\n");
    let (_, problem) = on_grid(&text, grid(8, Cells::Triangles))?;
    let whole = stepped(&problem, Some(memory))?;
    let sides = lasting(&whole.0, &whole.0.full, 16.0 * f64::EPSILON).expect("finite loads");
    let less = settled(&problem, &whole.0, &sides.expect("a box"), Some(memory))?;
    Ok((problem, [whole, less.expect("edges that keep their side")]))
}

/// Inputs of a tick: at an end of their range, or where they were.
fn jumped(of: &SteppedModel, p: &mut [f64], seed: usize) {
    for (at, (p, [lo, hi])) in p.iter_mut().zip(&of.model.ranges).enumerate().skip(1) {
        *p = match (4.0 * (scatter(seed + 31 * at) + 1.0)) as u32 {
            0..=1 => *lo,
            2..=3 => *hi,
            _ => *p,
        };
    }
}

/// With all modes u, the fluxes and the outputs of each tick are those of the model with all edges.
#[test]
fn ticks_are_those_of_all_edges() -> Result<()> {
    let (_, [(whole, of_whole), (less, of_less)]) = both(0.1, usize::MAX)?;
    let (open, touching) = (less.settled.open.len(), less.settled.touching.len());
    assert!(open > 1 && touching > 1, "{:?}", less.settled);
    assert_eq!(less.model.contact + open + touching, whole.model.contact);
    let mut past = [&whole, &less].map(|of| of.start().to_vec());
    let (mut p, mut seen) = (whole.model.defaults[..whole.inputs].to_vec(), [0; 3]);
    for tick in 0..40 {
        jumped(&whole, &mut p, 7 * tick);
        let found = [(&whole, &of_whole), (&less, &of_less)].map(|(of, recovery)| {
            let past = &mut past[usize::from(of.model.contact < whole.model.contact)];
            let terms = [&p[..], past].concat();
            let x = of.model.solve(&terms).expect("a solution");
            of.advance(past, &p, &x);
            (recovery.field(&of.model, &terms, &x), of.model.outputs(&terms, &x), x)
        });
        let [((u, flux), outputs, _), ((own, own_flux), own_outputs, x)] = found;
        add_to(&mut seen, states(&x));
        for (u, own) in u.iter().zip(&own).chain(flux.iter().zip(&own_flux)) {
            SETTLED.check(format_args!("tick {tick}"), u - own);
        }
        for (value, own) in outputs.iter().zip(&own_outputs) {
            SETTLED.check("output", value.expect("a value") - own.expect("a value"));
        }
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
    Ok(())
}

/// Whatever a tick leaves unfinished, s is not below ψ along edges that are open, and τ presses those that touch and brings the others q.
#[test]
fn what_the_bound_takes_for_granted_holds_for_any_openings() -> Result<()> {
    for (length, memory) in [(0.1, 3), (1e3, 1), (0.02, 8)] {
        let (problem, [_, (of, recovery)]) = both(length, memory)?;
        let counts = problem.topology.counts;
        let (mut past, mut p) = (of.start().to_vec(), of.model.defaults[..of.inputs].to_vec());
        for tick in 0..60 {
            jumped(&of, &mut p, 11 * tick);
            let x: Vec<f64> = of
                .model
                .limits
                .iter()
                .enumerate()
                .map(|(at, [lo, hi])| {
                    let part = (0.5 + scatter(5 * tick + 3 * at)).clamp(0.0, 1.0);
                    lo + part * (hi - lo)
                })
                .collect();
            let terms = [&p[..], &past].concat();
            let now = problem.with_inputs(&p[1..])?;
            let fields = recovery.admissible(&of.model, &now, &terms, &x).expect("a bound");
            let ends = Ends::of(&now)?;
            let (_, flux) = recovery.field(&of.model, &terms, &x);
            let q = |edge: usize| now.loads.contact_flux[edge];
            for &edge in &of.settled.open {
                for (end, vertex) in problem.ends[counts.free + edge].into_iter().enumerate() {
                    let gap = ends.gap[edge][end];
                    assert!(fields.vertices[vertex as usize] >= gap, "{length} {tick} {edge}");
                }
                SETTLED_FLUX.check("open", fields.tau[counts.free + edge] - q(edge));
            }
            for &edge in &of.settled.touching {
                assert!(fields.tau[counts.free + edge] >= q(edge), "{length} {tick} {edge}");
                // What mends the others goes elsewhere.
                let mended = fields.tau[counts.free + edge] - flux[counts.free + edge];
                SETTLED_FLUX.check("touching", mended);
            }
            of.advance(&mut past, &p, &x);
        }
    }
    Ok(())
}

/// Held by a transfer law alone, all contact open.
#[test]
fn nothing_is_left_where_no_edge_ever_touches() -> Result<()> {
    let text = r#"
mesh = "grid"
material.default = { conductivity = "1", capacity = "1" }
source.f = "-2"
boundary.dirichlet = { kind = "robin", coefficient = "1e4", ambient = "x^2" }
boundary.left = { kind = "neumann", flux = "2" }
boundary.right = { kind = "neumann", flux = "2" }
boundary.contact = { kind = "contact", gap = "-5" }
time = { step = 0.1 }
"#;
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(text, grid(2, cells))?;
        let whole = stepped(&problem, Some(2))?.0;
        let sides = lasting(&whole, &whole.full, 16.0 * f64::EPSILON).expect("finite loads");
        let less = settled(&problem, &whole, &sides.expect("a box"), Some(2))?;
        assert_eq!(less.expect("edges that stay open").0.model.contact, 0, "{cells:?}");
    }
    Ok(())
}
