//! Parts that only contact holds, and parts that nothing holds.

use serde_json::Value;
use signorini_files::answer::Answer;
use signorini_intervals::Coverage;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::Cells;
use signorini_solve::{Options, ScalarKind, SolverKind, solve};
use signorini_tests::random::Random;
use signorini_tests::written::{Contact, Side, Smooth, TwoMaterials, Units, Written};
use signorini_tolerances::cases;
use signorini_tolerances::twins::{GUARANTEE, IDENTITY};

use super::run::{Run, options, posed, run};
use crate::mesh::{KINDS, regular, scattered, split};

fn draw(random: &mut Random) -> Written {
    match random.below(5) {
        0 => TwoMaterials::a().written(),
        1 => TwoMaterials::b().written(),
        2 => TwoMaterials::h(random.between(0.2, 0.9)).written(),
        3 => TwoMaterials::jump(10f64.powf(random.between(-4.0, 4.0))).written(),
        _ => Smooth { contact: Contact::Closed, ..Smooth::random(random) }.written(),
    }
}

/// Pushed onto its contact edges, with nothing else to hold it.
fn on_contact_alone(random: &mut Random, sweeps: Option<u32>) -> Run {
    let text = draw(random).scene([Side::Neumann; 3], Units::ONE);
    let (n, cells) = (3 + random.below(4), KINDS[random.below(3) as usize]);
    let mesh = scattered(random, n, cells);
    let scalar = if random.below(2) == 0 { ScalarKind::F32 } else { ScalarKind::F64 };
    let run = run(&text, mesh, &options(scalar, sweeps));
    assert_eq!((run.solution.parts.contact, run.solution.parts.held), (1, 0));
    run
}

fn holds(what: &str, run: &Run) {
    let found = run.certified().unwrap_or_else(|| panic!("{what}: no bound"));
    GUARANTEE.check_at_most(what, found.combined, found.bound.total);
    IDENTITY.check_relative(what, found.bound.duality_gap, found.identity);
}

#[test]
fn contact_alone_has_a_bound_at_convergence() {
    for seed in 0..cases(50) {
        let run = on_contact_alone(&mut Random::new(seed), None);
        holds(&format!("seed {seed}"), &run);
    }
}

/// Under way the surplus may pull at a contact edge; then there is none.
#[test]
fn contact_alone_under_way_has_a_bound_that_holds_or_none() {
    let mut with = 0;
    for seed in 0..50 {
        let random = &mut Random::new(seed);
        let sweeps = 1 << random.below(8);
        let run = on_contact_alone(random, Some(sweeps));
        if run.solution.bound.is_some() {
            holds(&format!("seed {seed}, {sweeps} sweeps"), &run);
            with += 1;
        }
    }
    assert!(with >= 10, "{with} of 50");
}

/// H is even in x: cut along x = 0, both halves keep it, the left one on its Dirichlet side.
#[test]
fn a_part_on_contact_alone_beside_one_that_is_held() {
    let sides = [Side::Dirichlet, Side::Neumann, Side::Neumann];
    let slit = "[boundary.slit]\nkind = \"neumann\"\nflux = 0\n";
    let text = TwoMaterials::h(0.55).written().scene(sides, Units::ONE) + slit;
    for cells in KINDS {
        let run = run(&text, split(regular(6, cells)), &options(ScalarKind::F64, None));
        let parts = run.solution.parts;
        assert_eq!((parts.held, parts.contact, parts.floating), (1, 1, 0));
        holds(&format!("{cells:?}"), &run);
    }
}

/// No contact edge, and nothing else on the sides of the right half.
const FLOATING: &str = r#"
mesh = "none.msh"
material.default.conductivity = 1
source.f = "sin(2*pi*x)"
boundary.default = { kind = "neumann", flux = 0 }
"#;

fn summary(text: &str, mesh: Mesh) -> Value {
    let problem = posed(text, mesh);
    let solution = solve(&problem, &Options::default()).expect("loads in balance");
    assert!(solution.converged() && solution.bound.is_none());
    let answer = Answer::new(problem, solution, None, SolverKind::Kernel, Coverage::Usual, None);
    serde_json::from_str(&answer.expect("an answer").summary().json()).expect("valid JSON")
}

#[test]
fn parts_held_by_nothing_have_no_bound_and_the_summary_says_null() {
    let held = FLOATING.to_owned() + "[boundary.left]\nkind = \"dirichlet\"\nvalue = 0\n";
    for (text, held) in [(FLOATING, 0), (&held, 1)] {
        let summary = summary(text, split(regular(4, Cells::Mixed)));
        assert_eq!(summary["parts"]["held"], held);
        assert_eq!(summary["parts"]["up_to_a_constant"], 2 - held);
        assert_eq!(summary.get("error_bound"), Some(&Value::Null));
    }
}
