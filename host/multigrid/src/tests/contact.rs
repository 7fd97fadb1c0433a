//! Whole contact problems.

use signorini_tolerances::solve::MULTIGRID_RELAXED;

use super::Square;
use crate::active_set::ActiveSet;
use crate::{Failure, Settings, Side, Solution, solve};

const SETTINGS: Settings = Settings { tolerance: 1e-13, accuracy: 1e-10, most_iterations: 400 };

/// Pulls down on the left and up on the right.
fn slope(x: f64, _: f64) -> f64 {
    8.0 * x - 5.0
}

fn solved(what: &str, square: &Square) -> Solution {
    let found = solve(&square.problem(), &SETTINGS, &[]).expect(what);
    let expected = square.relaxed();
    MULTIGRID_RELAXED.check_each(what, &found.u, &expected);
    found
}

fn count(found: &Solution, side: Side) -> usize {
    found.sides.iter().filter(|&&of| of == side).count()
}

#[test]
fn an_obstacle_is_met_where_relaxation_meets_it() {
    for n in [2, 8, 24] {
        let found = solved("obstacle", &Square::new(n, 1.0, true, slope));
        assert!(count(&found, Side::Touching) > 0 && count(&found, Side::Saturated) == 0);
        assert_eq!(count(&found, Side::Open) + count(&found, Side::Touching), n as usize);
    }
}

/// A correction may leave nothing to correct: one unknown, and numbers that f32 has exactly.
#[test]
fn an_exact_answer_is_no_breakdown() {
    for load in [1.0, -3.0] {
        let mut square = Square::new(1, 1.0, true, |_, _| 0.0);
        (square.row_ptr, square.col_idx) = (vec![0, 1], vec![0]);
        (square.values, square.load) = (vec![4.0], vec![load]);
        (square.lower, square.floating, square.ends) = (Vec::new(), Vec::new(), vec![[0, 1]]);
        let found = solve(&square.problem(), &SETTINGS, &[]).expect("an answer");
        assert_eq!(found.u, [0.25 * load]);
    }
}

#[test]
fn limits_have_three_sides() {
    let mut square = Square::new(16, 1.0, true, slope);
    square.spans = vec![0.02; 16];
    let found = solved("limit", &square);
    let sides = [Side::Open, Side::Touching, Side::Saturated].map(|side| count(&found, side));
    assert!(sides.iter().all(|&count| count > 0), "{sides:?}");
    // u ≤ ψ is the mirror image of u ≥ ψ.
    square.spans = vec![f64::NEG_INFINITY; 16];
    let found = solved("from below", &square);
    assert!(count(&found, Side::Open) == 0 && count(&found, Side::Saturated) > 0);
}

#[test]
fn contact_alone_holds_a_part() {
    let square = Square::new(12, 1.0, false, |x, _| 12.0 * x - 7.0);
    let found = solved("held by contact", &square);
    assert!(count(&found, Side::Touching) > 0 && count(&found, Side::Open) > 0);
}

#[test]
fn iterations_do_not_grow_with_the_mesh() {
    let longest = [16, 32, 64, 128].map(|n| {
        solve(&Square::new(n, 1.0, true, slope).problem(), &SETTINGS, &[])
            .expect("a solution")
            .longest
    });
    assert!(longest.iter().all(|&longest| longest <= 20), "{longest:?}");
}

/// Edges one by one would take PROBE at the last.
#[test]
fn a_direction_of_the_material_hardly_matters() {
    let longest = [5.0, 25.0, 1e3, 1e4].map(|a| {
        solve(&Square::new(64, a, true, slope).problem(), &SETTINGS, &[])
            .expect("a solution")
            .longest
    });
    assert!(longest.iter().all(|&longest| longest <= 20), "{longest:?}");
}

/// It goes on from what it is given.
#[test]
fn a_solution_is_its_own_start() {
    let square = Square::new(24, 1.0, true, slope);
    let cold = solve(&square.problem(), &SETTINGS, &[]).expect("a solution");
    let warm = solve(&square.problem(), &SETTINGS, &cold.u).expect("a solution");
    assert!(warm.sets <= 1 && warm.iterations * 3 < cold.iterations, "{warm:?}");
    assert_eq!(warm.sides, cold.sides);
}

#[test]
fn equal_problems_have_equal_bits() {
    let square = Square::new(24, 5.0, true, slope);
    let [one, other] =
        [0; 2].map(|_| solve(&square.problem(), &SETTINGS, &[]).expect("a solution"));
    assert_eq!(one, other);
}

#[test]
fn what_does_not_end_is_told() {
    let square = Square::new(16, 1.0, true, slope);
    let few = Settings { most_iterations: 3, ..SETTINGS };
    let slow = solve(&square.problem(), &few, &[]);
    assert!(matches!(slow, Err(Failure::Slow { iterations: 3, .. })), "{slow:?}");
    let mut short = square.problem();
    short.contact.load = &square.load[1..];
    assert_eq!(solve(&short, &SETTINGS, &[]), Err(Failure::Malformed));
    let mut lost = Square::new(16, 1.0, true, slope);
    lost.load[3] = f64::NAN;
    assert_eq!(solve(&lost.problem(), &SETTINGS, &[]), Err(Failure::Malformed));
    let mut indefinite = Square::new(16, 1.0, true, slope);
    indefinite.values.iter_mut().skip(1).step_by(3).for_each(|value| *value = -5.0);
    assert!(solve(&indefinite.problem(), &SETTINGS, &[]).is_err());
}

#[test]
fn sides_change_by_the_law() {
    let spans = [f64::INFINITY, 2.0, -2.0, f64::NEG_INFINITY];
    let set = |start: &[f64]| ActiveSet::new(&[0.0; 4], &spans, Vec::new(), start);
    let touching = set(&[]);
    let at = |values: [f64; 4]| move |at: usize| values[at];
    let ones = at([1.0; 4]);
    let wrong = touching.wrong(1e-9, at([0.0; 4]), at([-1.0, 3.0, 1.0, 1.0]), ones);
    let expected =
        [(0, Side::Open), (1, Side::Saturated), (2, Side::Saturated), (3, Side::Saturated)];
    assert_eq!(wrong, expected);
    assert_eq!(touching.wrong(1e-9, at([0.0; 4]), at([1.0, 1.0, -1.0, -1.0]), ones), []);
    let above = set(&[1.0; 4]);
    assert_eq!(above.sides, [Side::Open, Side::Open, Side::Open, Side::Touching]);
    assert_eq!([0, 1, 2].map(|at| above.force(at)), [0.0, 0.0, -2.0]);
    let back = above.wrong(1e-9, at([-1.0, 1.0, -1.0, 0.0]), at([0.0; 4]), ones);
    assert_eq!(back, [(0, Side::Touching), (2, Side::Touching)]);
}

/// The one with the largest force.
#[test]
fn one_edge_of_a_part_always_touches() {
    let force = |at: usize| [-3.0, -1.0, -2.0][at];
    let mut set = ActiveSet::new(&[0.0; 3], &[], vec![vec![0, 1, 2]], &[]);
    set.change(&[(0, Side::Open), (1, Side::Open), (2, Side::Open)], force);
    assert_eq!(set.sides, [Side::Open, Side::Touching, Side::Open]);
}
