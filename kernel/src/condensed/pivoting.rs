//! The exact solution by principal pivoting: finitely many exchanges lead to it, and next to the last
//! answer a few do.
//!
//! With the touching edges x_A = 0 and the rest in balance, w_I = 0, the tableau knows the answer
//! z = (−x_I, w_A) for any load. Where a z has the wrong sign, x_i < 0 or w_i < 0, the unknown is on the
//! wrong side. The one that is wrong by most is exchanged, until none is: that takes as many exchanges
//! as edges change sides, or hardly more, where a pass over all that are wrong takes a sixth more. It
//! need not end for every positive definite S, and after n exchanges the first wrong one is taken instead,
//! which does (Murty).
//!
//! Every exchange leaves its rounding errors in the tableau. The answer is therefore checked against S
//! itself, Sx − b on the edges in balance, and corrected with the tableau as an approximate inverse; a
//! tableau that no longer corrects goes back to where it began, and exchanges from there.

use super::Iterate;
use super::blocks::{Blocks, SIDE, groups, multiply_add};
use super::tableau::{Start, Tableau};
use crate::error::Error;
use crate::real::Real;

/// How many times the limit may be left after a correction.
const WORN: u32 = 32;

/// An answer may be larger than the load by 1/(this many ε).
const ABSURD: u32 = 64;

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// Nothing is on the wrong side: x is the solution, but for rounding.
    Exact,
    /// The exchanges allowed are used up; those made count for the next search.
    OutOfPivots,
    /// Rounding has eaten the tableau, or there is no solution: more exchanges than unknowns have not led to
    /// one. x is zeros then, and the next search begins with the first tableau.
    Worn,
}

/// Finds x ≥ 0 with w = Sx − b ≥ 0 and xᵀw = 0 by at most `cap` exchanges; returns how many it took.
///
/// # Errors
/// Arrays of the wrong length.
pub fn find<R: Real>(
    matrix: &Blocks<R>,
    load: &[R],
    tableau: &mut Tableau<R>,
    start: &Start<R>,
    cap: u32,
    iterate: Iterate<R>,
) -> Result<(Found, u32), Error> {
    let Iterate { x, residual, scratch: answer, open } = iterate;
    let own = square(load).rounded_sqrt();
    tableau.answer(load, answer)?;
    let mut size = (square(load) + square(answer)).rounded_sqrt();
    if !(R::from_count(ABSURD) * R::EPSILON * size <= own) {
        // No matrix that this scalar holds has such an answer: loads without a solution have led here.
        tableau.reset(start)?;
        tableau.answer(load, answer)?;
        size = (square(load) + square(answer)).rounded_sqrt();
    }
    let (mut found, pivots) = search(tableau, cap, R::TWO * R::EPSILON * size, answer)?;
    tableau.finish();
    take_over(answer, tableau.exchanged(), x);
    settle(matrix, load, x, residual, open)?;
    if found == Found::Exact {
        let limit = R::from_count(32) * R::EPSILON * size;
        let before = unbalanced(residual, x);
        if !(before <= limit) {
            correct(tableau, residual, answer, x)?;
            settle(matrix, load, x, residual, open)?;
            // What is left now may be the floor of this matrix; much more is a tableau gone wrong.
            let after = unbalanced(residual, x);
            if !(after <= R::from_count(WORN) * limit || after <= R::QUARTER * before) {
                found = Found::Worn;
            }
        }
    }
    if found == Found::OutOfPivots && pivots as usize >= x.len() {
        found = Found::Worn;
    }
    if found == Found::Worn {
        tableau.reset(start)?;
        x.fill(R::ZERO);
    }
    Ok((found, pivots))
}

/// Exchanges until nothing is wrong by more than `noise`, which rounding may be.
fn search<R: Real>(
    tableau: &mut Tableau<R>,
    cap: u32,
    noise: R,
    z: &mut [R],
) -> Result<(Found, u32), Error> {
    let patience = z.len() as u32;
    let mut pivots = 0;
    loop {
        let is_patient = pivots < patience;
        let Some(at) = wrong(z, tableau.exchanged(), noise, is_patient) else {
            return Ok((Found::Exact, pivots));
        };
        if pivots >= cap {
            return Ok((Found::OutOfPivots, pivots));
        }
        if !tableau.exchange(at, z)? {
            return Ok((Found::Worn, pivots));
        }
        pivots += 1;
    }
}

/// The unknown that is on the wrong side by most, or the first that is.
fn wrong<R: Real>(z: &[R], exchanged: &[bool], noise: R, by_most: bool) -> Option<usize> {
    if by_most && cfg!(not(target_arch = "arm")) {
        return in_lanes(z, exchanged, noise);
    }
    in_turn(z, exchanged, noise, by_most)
}

/// One after the other: z = −x within, w elsewhere, and both are wrong where their signs say otherwise.
fn in_turn<R: Real>(z: &[R], exchanged: &[bool], noise: R, by_most: bool) -> Option<usize> {
    let (mut found, mut most) = (None, noise);
    for (at, (&z, &within)) in z.iter().zip(exchanged).enumerate() {
        if (z > R::ZERO) == within && z.magnitude() > most {
            (found, most) = (Some(at), z.magnitude());
            if !by_most {
                break;
            }
        }
    }
    found
}

/// The same by most, where a register holds several numbers: by how much first, and then who.
fn in_lanes<R: Real>(z: &[R], exchanged: &[bool], noise: R) -> Option<usize> {
    let most = largest(z, exchanged);
    let is_it = |(&z, &within)| excess(z, within) >= most;
    if most > noise { z.iter().zip(exchanged).position(is_it) } else { None }
}

/// What the one that is wrong by most is wrong by; 0 where none is.
fn largest<R: Real>(z: &[R], exchanged: &[bool]) -> R {
    let mut most = [R::ZERO; SIDE];
    for (z, exchanged) in groups(z).iter().zip(groups(exchanged)) {
        for ((most, &z), &within) in most.iter_mut().zip(z).zip(exchanged) {
            *most = most.or_larger(excess(z, within));
        }
    }
    most.into_iter().fold(R::ZERO, R::or_larger)
}

/// By how much an unknown is on the wrong side, below 0 where it is on the right one.
fn excess<R: Real>(z: R, within: bool) -> R {
    if within { z } else { -z }
}

/// Σ x_i², padded
pub(crate) fn square<R: Real>(x: &[R]) -> R {
    let mut sums = [R::ZERO; SIDE];
    for group in groups(x) {
        sums.iter_mut().zip(group).for_each(|(sum, &x)| *sum += x * x);
    }
    total(sums)
}

/// The root of the sum of r_i² over the edges that are open, or should be.
fn unbalanced<R: Real>(residual: &[R], x: &[R]) -> R {
    let mut sums = [R::ZERO; SIDE];
    for (group, x) in groups(residual).iter().zip(groups(x)) {
        for ((sum, &r), &x) in sums.iter_mut().zip(group).zip(x) {
            let wrong = if x > R::ZERO { r } else { r.or_smaller(R::ZERO) };
            *sum += wrong * wrong;
        }
    }
    total(sums).rounded_sqrt()
}

/// The sum of eight numbers.
fn total<R: Real>([a, b, c, d, e, f, g, h]: [R; SIDE]) -> R {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// x of the answer (−x_I, w_A), not below 0.
fn take_over<R: Real>(answer: &[R], exchanged: &[bool], x: &mut [R]) {
    for ((x, &z), &within) in x.iter_mut().zip(answer).zip(exchanged) {
        *x = if within && z < R::ZERO { -z } else { R::ZERO };
    }
}

/// `residual` = Sx − b, and `open` where x > 0.
#[inline(never)]
pub(super) fn settle<R: Real>(
    matrix: &Blocks<R>,
    load: &[R],
    x: &[R],
    residual: &mut [R],
    open: &mut [bool],
) -> Result<(), Error> {
    for (((residual, open), &load), &x) in residual.iter_mut().zip(&mut *open).zip(load).zip(x) {
        (*residual, *open) = (-load, x > R::ZERO);
    }
    multiply_add(matrix, x, open, residual)
}

/// x_I −= S_II⁻¹ r_I, not below 0.
#[inline(never)]
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_find_the_same_unknown() {
        let exchanged: [bool; 24] = core::array::from_fn(|at| at % 3 == 0);
        let (mut some, mut none) = (0, 0);
        for shift in 0..200 {
            // Every value twice, some of both signs.
            let number = |at: usize| ((at % 12 * 37 + shift * 53) % 101) as f64 - 70.0;
            let z: [f64; 24] =
                core::array::from_fn(|at| if at % 5 == 4 { 0.0 } else { number(at) });
            for noise in [0.0, 28.0, 69.0] {
                let one = in_turn(&z, &exchanged, noise, true);
                assert_eq!(in_lanes(&z, &exchanged, noise), one, "{shift}, {noise}");
                *(if one.is_some() { &mut some } else { &mut none }) += 1;
            }
            let first = in_turn(&z, &exchanged, 1.0, false);
            let by = z.iter().zip(&exchanged).map(|(z, within)| if *within { *z } else { -z });
            assert_eq!(first, by.into_iter().position(|by| by > 1.0));
        }
        assert!(none > 0 && some > 100, "{none} {some}");
    }
}
