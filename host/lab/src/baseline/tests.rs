//! All solvers agree on small problems, and the record says so.

mod limits;

use super::condensed::condensed;
use super::load_case::load_cases;
use super::psor::quadratic;
use super::quadratic::{Quadratic, QuadraticLoads};
use super::sizes::{Sizes, size};
use super::table;
use crate::trade::tests::{problem, scene};
use signorini_condense::condense;
use signorini_problem::{Parts, Problem};
use signorini_reference::Factor;
use signorini_tolerances::lab::{AS_BAKED, PIVOTING};

/// Answers are compared inside: a solver that is further from the active set's than 1 % of the discretisation
/// error says so in its record.
#[test]
fn all_solvers_agree_on_small_grids() {
    let scene = scene("catalogue/moving-tri");
    let mut notes = Vec::new();
    let rows: Vec<_> =
        [3, 4, 8].map(|n| size(&scene, n, 3, None, &mut notes).unwrap()).into_iter().collect();
    for row in &rows {
        let cascade = usize::from(row.n != 3);
        assert_eq!(row.baselines.len(), 2 * 10 + cascade, "{:?}", row.baselines);
        for b in &row.baselines {
            assert!(b.algebraic_error <= b.target, "n = {}: {b:?}", row.n);
            assert!(b.cycles > 0.0 && b.ratio > 0.0 && b.to_condensed.is_some(), "{b:?}");
        }
        let exact = row.baselines.iter().filter(|b| b.solver == "kernel pivoting f64");
        exact.for_each(|b| PIVOTING.check("algebraic error", b.algebraic_error));
    }
    assert!(notes.iter().all(|note| note.contains("condensing")), "{notes:?}");
    let study = Sizes { title: scene.title, registers: String::new(), rows, notes };
    let text = table(&study).text();
    assert!(text.contains("Clarabel") && text.contains("kernel pivoting f64"), "{text}");
    let json = serde_json::to_string(&study).unwrap();
    assert_eq!(serde_json::from_str::<Sizes>(&json).unwrap().rows.len(), 3);
}

/// The problem of a scene in its first tick and so many others, with the factor of its matrix.
pub fn full(problem: &Problem, ticks: usize) -> (Quadratic, Factor) {
    let parts = Parts::examine(problem).unwrap();
    quadratic(problem, &parts, &load_cases(problem, ticks).unwrap()).unwrap()
}

/// Contact moves from tick to tick, so that warm starts have something to do.
#[test]
fn contact_moves() {
    for file in ["catalogue/h-tri", "scenes/benbelgacem"] {
        let (full, _) = full(&problem(file), 20);
        let free = full.free();
        let touching = |(u, tick): (&Vec<f64>, &QuadraticLoads)| {
            tick.lower.iter().zip(&u[free..]).map(|(psi, u)| u <= psi).collect::<Vec<_>>()
        };
        let mut sets: Vec<_> = full.answers.iter().zip(&full.ticks).map(touching).collect();
        sets.dedup();
        assert!(full.ticks.len() == 21 && sets.len() > 3, "{file}: {} sets", sets.len());
    }
}

/// The condensed problem is the one that is baked.
#[test]
fn condensed_as_baked() {
    let problem = problem("scenes/slab");
    let (full, factor) = full(&problem, 2);
    let (ours, model) = condensed(&problem, &full, &factor).unwrap();
    let baked = condense(&problem).unwrap();
    let largest = ours.ticks[0].load.iter().fold(0.0, |most: f64, b| most.max(b.abs()));
    for (a, b) in model.matrix.iter().zip(&baked.matrix) {
        AS_BAKED.check("matrix", a - b);
    }
    for (a, b) in ours.ticks[0].load.iter().zip(baked.load_of(&baked.defaults)) {
        let b = b * baked.energy_unit;
        AS_BAKED.check_over("load", a - b, largest);
    }
}
