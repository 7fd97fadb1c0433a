//! The exact solution by principal pivoting: finitely many exchanges lead to it, and next to the last
//! answer a few do.
//!
//! With the touching edges x_A = 0 and the rest in balance, w_I = 0, the tableau knows the answer
//! z = (−x_I, w_A) for any load. Where a z has the wrong sign, x_i < 0 or w_i < 0, the unknown is on the
//! wrong side. A round goes over all unknowns and exchanges each that is wrong when its turn comes; for
//! an M-matrix, which S nearly is, edges that lift off make no other one right again, and edges that
//! touch down spare some of those behind them. For any other positive definite S rounds need not end: when
//! for some of them the number of wrong unknowns has not fallen, only the last one moves (Murty), until
//! it has (Júdice and Pires). That is finite.
//!
//! Every exchange leaves its rounding errors in the tableau. The answer is therefore checked against S
//! itself, Sx − b on the edges in balance, and corrected with the tableau as an approximate inverse; a
//! tableau that no longer corrects is given up, and built anew from the next tick on.

use super::Iterate;
use super::panels::Panels;
use super::tableau::Tableau;
use crate::error::Error;
use crate::real::Real;

/// Rounds without progress before single exchanges begin.
const PATIENCE: u32 = 3;

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// Nothing is on the wrong side: x is the solution, but for rounding.
    Exact,
    /// The exchanges allowed are used up; those made count for the next search.
    OutOfPivots,
    /// Rounding has eaten the tableau; the next search builds it anew.
    Worn,
}

/// Finds x ≥ 0 with w = Sx − b ≥ 0 and xᵀw = 0 by at most `cap` exchanges; returns how many it took.
///
/// # Errors
/// Arrays of the wrong length.
pub fn find<R: Real>(
    matrix: &Panels<R>,
    load: &[R],
    tableau: &mut Tableau<R>,
    cap: u32,
    iterate: Iterate<R>,
) -> Result<(Found, u32), Error> {
    let Iterate { x, residual, scratch: answer } = iterate;
    tableau.answer(load, answer)?;
    let (mut found, pivots) = search(load, tableau, cap, answer)?;
    take_over(answer, tableau.exchanged(), x);
    settle(matrix, load, x, residual)?;
    if found == Found::Exact {
        let limit = limit(load, x);
        let before = unbalanced(residual, tableau.exchanged());
        if !(before <= limit) {
            correct(tableau, residual, answer, x)?;
            settle(matrix, load, x, residual)?;
            let after = unbalanced(residual, tableau.exchanged());
            if !(after <= limit || after <= R::QUARTER * before) {
                found = Found::Worn;
            }
        }
    }
    if found == Found::Worn {
        tableau.reset(matrix)?;
    }
    Ok((found, pivots))
}

/// Rounds of exchanges until nothing is wrong.
fn search<R: Real>(
    load: &[R],
    tableau: &mut Tableau<R>,
    cap: u32,
    z: &mut [R],
) -> Result<(Found, u32), Error> {
    let (mut fewest, mut patience, mut pivots) = (usize::MAX, PATIENCE, 0);
    loop {
        let noise = noise(load, z);
        let wrong = |at: usize, z: &[R], within: &[bool]| {
            let sides = z.get(at).zip(within.get(at));
            sides.is_some_and(|(&z, &within)| !((if within { -z } else { z }) >= -noise))
        };
        let all = 0..z.len();
        let count = all.clone().filter(|&at| wrong(at, z, tableau.exchanged())).count();
        if count == 0 {
            return Ok((Found::Exact, pivots));
        }
        let single = count >= fewest && patience == 0;
        if count < fewest {
            (fewest, patience) = (count, PATIENCE);
        } else {
            patience = patience.saturating_sub(1);
        }
        for at in all.rev() {
            if !wrong(at, z, tableau.exchanged()) {
                continue;
            }
            if pivots >= cap {
                return Ok((Found::OutOfPivots, pivots));
            }
            if !tableau.exchange(at, z)? {
                return Ok((Found::Worn, pivots));
            }
            pivots += 1;
            if single {
                break;
            }
        }
    }
}

/// How large a wrong sign may be and still be rounding: a few digits of the largest number.
fn noise<R: Real>(load: &[R], z: &[R]) -> R {
    R::from_count(8) * R::EPSILON * largest(z).or_larger(largest(load))
}

/// What may be left of the balance on the edges in balance.
fn limit<R: Real>(load: &[R], x: &[R]) -> R {
    R::from_count(32) * R::EPSILON * largest(x).or_larger(largest(load))
}

/// max |x_i|
pub(super) fn largest<R: Real>(numbers: &[R]) -> R {
    numbers.iter().fold(R::ZERO, |most, number| most.or_larger(number.magnitude()))
}

/// The largest |r_i| of the unknowns in balance, NaN where one is.
fn unbalanced<R: Real>(residual: &[R], exchanged: &[bool]) -> R {
    let within = residual.iter().zip(exchanged).filter(|(_, within)| **within);
    within.fold(R::ZERO, |most, (r, _)| if r.magnitude() <= most { most } else { r.magnitude() })
}

/// x of the answer (−x_I, w_A), not below 0.
fn take_over<R: Real>(answer: &[R], exchanged: &[bool], x: &mut [R]) {
    for ((x, &z), &within) in x.iter_mut().zip(answer).zip(exchanged) {
        *x = if within && z < R::ZERO { -z } else { R::ZERO };
    }
}

/// `residual` = Sx − b
pub(super) fn settle<R: Real>(
    matrix: &Panels<R>,
    load: &[R],
    x: &[R],
    residual: &mut [R],
) -> Result<(), Error> {
    residual.iter_mut().zip(load).for_each(|(residual, &load)| *residual = -load);
    matrix.multiply_add(x, residual)
}

/// x_I −= S_II⁻¹ r_I, not below 0.
fn correct<R: Real>(
    tableau: &mut Tableau<R>,
    residual: &[R],
    change: &mut [R],
    x: &mut [R],
) -> Result<(), Error> {
    tableau.respond(residual, change)?;
    for ((x, &change), &within) in x.iter_mut().zip(change.iter()).zip(tableau.exchanged()) {
        let corrected = *x + change;
        *x = if within && corrected > R::ZERO { corrected } else { R::ZERO };
    }
    Ok(())
}
