//! The optimality conditions on finite element matrices of some thousand unknowns, checked naively.

use super::Random;
use super::stencil::{Side, Stencil, crouzeix_raviart};
use crate::{Factor, Solution};
use signorini_tolerances::solve::{OPTIMAL, WARM};

const CELLS: usize = 24;

/// Displaced vertices make some off-diagonal entries positive; `jump` is the largest ratio of the
/// coefficients.
fn distorted(sides: [Side; 4], jump: f64, mean_load: f64) -> Stencil {
    let mut random = Random(11);
    let nodes = CELLS + 1;
    let shifts = random.vector(2 * nodes * nodes);
    let exponents = random.vector(CELLS * CELLS);
    let place = |i: usize, j: usize| {
        let inside = (1..CELLS).contains(&i) && (1..CELLS).contains(&j);
        let reach = if inside { 0.3 } else { 0.0 };
        let at = 2 * (j * nodes + i);
        [i as f64 + reach * shifts[at], j as f64 + reach * shifts[at + 1]].map(|x| x / CELLS as f64)
    };
    let coefficient = |i: usize, j: usize| jump.powf(0.5 * exponents[j * CELLS + i]);
    let load = |x: f64, y: f64| 10.0 * (7.0 * x).sin() * (5.0 * y).cos() + mean_load;
    crouzeix_raviart(CELLS, sides, place, coefficient, load, |x, _| 0.02 * (20.0 * x).sin())
}

fn assert_optimal(stencil: &Stencil, solution: &Solution) {
    let free = stencil.load.len() - stencil.lower.len();
    let scale = solution.u.iter().fold(0.0, |scale: f64, u| scale.max(u.abs()));
    for row in 0..stencil.load.len() {
        let entries = stencil.row_ptr[row] as usize..stencil.row_ptr[row + 1] as usize;
        let diagonal = stencil.values[entries.start];
        let terms = entries.map(|k| stencil.values[k] * solution.u[stencil.col_idx[k] as usize]);
        let scaled = (terms.sum::<f64>() - stencil.load[row]) / diagonal;
        let what = format!("row {row}");
        match row.checked_sub(free) {
            None => OPTIMAL.check_over(&what, scaled, scale),
            Some(i) if solution.active[i] => {
                assert_eq!(solution.u[row], stencil.lower[i]);
                OPTIMAL.check_over(&what, scaled.min(0.0), scale);
                let force = solution.multiplier[i] / diagonal;
                OPTIMAL.check_over(&what, force - scaled, scale);
            }
            Some(i) => {
                let below = (solution.u[row] - stencil.lower[i]).min(0.0);
                OPTIMAL.check_over(&what, below, scale);
                OPTIMAL.check_over(&what, scaled, scale);
                assert_eq!(solution.multiplier[i], 0.0);
            }
        }
    }
}

fn check(sides: [Side; 4], jump: f64, mean_load: f64) {
    let stencil = distorted(sides, jump, mean_load);
    let factor = Factor::new(&stencil.problem()).expect("definite");
    let solve = |guess| stencil.solve(&factor, guess).expect("solvable");
    let cold = solve(None);
    assert_optimal(&stencil, &cold);
    let contacts = cold.active.iter().filter(|&&active| active).count();
    assert!(contacts > 0 && contacts < cold.active.len(), "{contacts} is no interesting contact");

    let bare = vec![false; cold.active.len()];
    assert_eq!(solve(Some(&bare)).active, cold.active);
    let warm = solve(Some(&cold.active));
    assert_eq!(warm.steps, warm.passes, "one step a pass when the contact set is known");
    let scale = cold.u.iter().fold(0.0, |scale: f64, u| scale.max(u.abs()));
    for (warm, cold) in warm.u.iter().zip(&cold.u) {
        WARM.check_over("a warm start", warm - cold, scale);
    }
}

use Side::{Contact, Dirichlet, Neumann};

#[test]
fn held_on_three_sides() {
    check([Contact, Dirichlet, Dirichlet, Dirichlet], 1.0, 0.0);
}

#[test]
fn contact_on_three_sides_with_jumps() {
    check([Contact, Contact, Dirichlet, Contact], 1e8, 0.0);
}

#[test]
fn floating_square_with_jumps() {
    check([Contact, Neumann, Neumann, Neumann], 1e4, -1.0);
}

#[test]
fn floating_square_with_contact_all_around() {
    check([Contact; 4], 1e4, -1.0);
}
