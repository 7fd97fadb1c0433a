//! Problems whose solution is known in closed form.

use super::stencil::Stencil;
use crate::{Factor, ReferenceError, Solution};
use signorini_tolerances::solve::{KNOWN, PRESSED};

/// Springs between neighbours k − 1 and k, one before the first and after the last unknown each.
fn chain(springs: &[f64], load: Vec<f64>, lower: Vec<f64>) -> Stencil {
    let n = springs.len() - 1;
    let row = |i: usize| {
        let mut row = vec![(i as u32, springs[i] + springs[i + 1])];
        row.extend((i + 1 < n).then(|| (i as u32 + 1, -springs[i + 1])));
        row.extend((i > 0).then(|| (i as u32 - 1, -springs[i])));
        row
    };
    Stencil::from_rows(&(0..n).map(row).collect::<Vec<_>>(), load, lower)
}

fn solve(stencil: &Stencil) -> Result<Solution, ReferenceError> {
    stencil.solve(&Factor::new(&stencil.problem())?, None)
}

/// A string under the load −1 over a flat floor at −26.25, held at both ends: it touches from
/// point 7 to point N − 7 and hangs in the parabola ½(7 − i)² + ¼(7 − i) above the floor before.
#[test]
fn string_over_a_floor() {
    for stiffness in [2.0_f64.powi(-500), 1.0, 2.0_f64.powi(500)] {
        let (points, touch, floor) = (30, 7, -26.25);
        let stencil = chain(&[stiffness; 31], vec![-stiffness; points], vec![floor; points]);
        let solution = solve(&stencil).expect("solvable");
        for i in 1..=points {
            let from_touch = (touch as f64 - i.min(points + 1 - i) as f64).max(0.0);
            let expected = floor + 0.5 * from_touch * from_touch + 0.25 * from_touch;
            KNOWN.check(format_args!("point {i}"), solution.u[i - 1] - expected);
            assert_eq!(solution.active[i - 1], from_touch == 0.0, "point {i}");
        }
        KNOWN.check("where it first touches", solution.multiplier[touch - 1] / stiffness - 0.25);
        KNOWN.check("where it lies", solution.multiplier[touch] / stiffness - 1.0);
    }
}

/// Integers throughout, so load = K u is exact and u must come out to the last digit although the
/// springs differ by 10⁸ and cond(K) is about 10¹¹.
#[test]
fn refinement_reaches_the_last_digit_across_jumps() {
    let n = 400;
    let springs: Vec<f64> = (0..=n).map(|i| [1.0, 1e4, 1e8][i / 9 % 3]).collect();
    let u: Vec<f64> = (0..n).map(|i| ((i * i) % 97) as f64 + 1.0).collect();
    let at = |i: usize| if (1..=n).contains(&i) { u[i - 1] } else { 0.0 };
    let load =
        (1..=n).map(|i| springs[i - 1] * (at(i) - at(i - 1)) + springs[i] * (at(i) - at(i + 1)));
    let mut load: Vec<f64> = load.collect();
    let contact = 40;
    let lower = (n - contact..n).map(|i| u[i] - (i % 2) as f64).collect();
    for i in (n - contact..n).filter(|i| i % 2 == 0) {
        load[i] -= 5.0;
    }
    let solution = solve(&chain(&springs, load, lower)).expect("solvable");
    for (found, expected) in solution.u.iter().zip(&u) {
        KNOWN.check_over("u", found - expected, 97.0);
    }
    solution.multiplier.iter().step_by(2).for_each(|force| PRESSED.check("a force", force - 5.0));
}

#[test]
fn plain_linear_solve_without_contact() {
    let stencil = chain(&[1.0; 10], vec![2.0; 9], Vec::new());
    let solution = solve(&stencil).expect("solvable");
    for (i, u) in solution.u.iter().enumerate() {
        KNOWN.check(format_args!("point {i}"), u - ((i + 1) * (9 - i)) as f64);
    }
    assert_eq!(Factor::new(&stencil.problem()).map(|factor| factor.schur().nrows()), Ok(0));
}

#[test]
fn nothing_to_solve() {
    let solution = solve(&Stencil::from_rows(&[], Vec::new(), Vec::new())).expect("solvable");
    assert!(solution.u.is_empty());
}

/// Two chains a – free – b that nothing holds but contact at a and b (unknowns 2, 3 and 4, 5).
fn floating_chains(load: [f64; 6]) -> Stencil {
    let rows = [
        vec![(0, 2.0), (3, -1.0), (2, -1.0)],
        vec![(1, 2.0), (4, -1.0), (5, -1.0)],
        vec![(2, 1.0), (0, -1.0)],
        vec![(3, 1.0), (0, -1.0)],
        vec![(4, 1.0), (1, -1.0)],
        vec![(5, 1.0), (1, -1.0)],
    ];
    let mut stencil = Stencil::from_rows(&rows, load.to_vec(), vec![0.0; 4]);
    stencil.floating = vec![true; 4];
    stencil
}

#[test]
fn floating_components_rest_where_the_load_presses() {
    // The first is pressed at both ends, the second lifted at one end and pressed at the other.
    let stencil = floating_chains([-1.0, -1.0, 0.0, 0.0, 3.0, -3.0]);
    for start in [None, Some(&[false; 4][..]), Some(&[false, true, true, false][..])] {
        let factor = Factor::new(&stencil.problem()).expect("K_FF is definite");
        let solution = stencil.solve(&factor, start).expect("solvable");
        assert_eq!(solution.active, [true, true, false, true]);
        let expected = [-0.5, 2.0, 0.0, 0.0, 5.0, 0.0];
        KNOWN.check_each("u", &solution.u, &expected);
        let forces = [0.5, 0.5, 0.0, 1.0];
        KNOWN.check_each("forces", &solution.multiplier, &forces);
    }
}

#[test]
fn floating_component_that_is_lifted_has_no_minimum() {
    let outcome = solve(&floating_chains([-1.0, -1.0, 0.0, 0.0, 3.0, 3.0]));
    assert!(matches!(outcome, Err(ReferenceError::Unbounded { unknown: 4 | 5 })), "{outcome:?}");
}
