//! The exact solution by principal pivoting: finitely many exchanges lead to it, and next to the last
//! answer a few do.
//!
//! With the touching edges x_A = 0 and the rest in balance, w_I = 0, the tableau knows the answer
//! z = (−x_I, w_A) for any load. Where a z has the wrong sign, x_i < 0 or w_i < 0, the unknown is on the
//! wrong side; so it is where w_i is outside of a range with two ends ([`super::ranges`]). Which of them is exchanged next is up to a [`Rule`]; one after the other, until none is wrong.
//!
//! Every exchange leaves its rounding errors in the tableau. The answer is therefore checked against S
//! itself, Sx − b on the edges in balance, and corrected with the tableau as an approximate inverse; a
//! tableau that no longer corrects goes back to where it began, and exchanges from there.

use super::Iterate;
use super::blocks::{Blocks, multiply_add};
use super::falling::{self, Way};
use super::ranges::{Given, Ranges};
use super::rule::{Rule, Step};
use super::sizes;
use super::tableau::{InitialTableau, Tableau};
use signorini_kernel::Real;
use signorini_kernel::error::Error;
use signorini_kernel::features;
use signorini_kernel::index::read;

/// Largest imbalance that rounding may leave without a correction, in ε of the first answer.
const LIMIT: u32 = 48;

/// Largest imbalance after a correction, in ε of the larger of the first and the last answer: 32 times as much.
const FLOOR: u32 = 1536;

/// Thresholds are drawn anew where the answer has shrunk by more than this since they were.
const SHRUNK: u32 = 64;

/// Least factor by which the imbalance of a solution is below the load, whatever rounding allows.
const SANE: u32 = 16;

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

/// Finds x ≥ 0 with w = Sx − b ≥ 0 and xᵀw = 0 as long as `may_exchange` after so
/// many exchanges; returns how many it took.
///
/// # Errors
/// Arrays of the wrong length, loads whose answer may overflow: nothing is changed then.
pub fn find<R: Real>(
    matrix: &Blocks<R>,
    given: Given<R>,
    tableau: &mut Tableau<R>,
    start: &InitialTableau<R>,
    rule: &mut impl Rule,
    may_exchange: impl FnMut(u32) -> bool,
    iterate: Iterate<R>,
) -> Result<(Found, u32), Error> {
    let Iterate { x, residual, scratch: answer, open } = iterate;
    let own = sizes::of_load(given.load)?;
    given.ranges.begin(tableau.exchanged(), x);
    given.answer(tableau, x, residual, answer)?;
    let mut size = own.or_larger(sizes::norm(answer));
    if sizes::is_absurd(size, own) {
        // No matrix that this scalar holds has such an answer: loads without a solution have led here.
        tableau.reset(start)?;
        given.answer(tableau, x, residual, answer)?;
        size = own.or_larger(sizes::norm(answer));
    }
    let (mut found, pivots, now) = exchange_all(
        (given, own),
        (tableau, start),
        (rule, may_exchange),
        &mut size,
        [answer, x, residual],
    )?;
    tableau.finish();
    take_over(answer, tableau.exchanged(), given.ranges, x);
    settle(matrix, given, x, residual, open)?;
    if found == Found::Exact {
        let limit = R::from_count(LIMIT) * R::EPSILON * size;
        let sane = own / R::from_count(SANE);
        let before = given.ranges.unbalanced(residual, x);
        if !(before <= limit && before <= sane) {
            correct(tableau, given.ranges, residual, answer, x)?;
            settle(matrix, given, x, residual, open)?;
            // What is left now may be the floor of this matrix, where openings are much larger than loads; more is a tableau
            // gone wrong.
            let after = given.ranges.unbalanced(residual, x);
            let floor = R::from_count(FLOOR) * R::EPSILON * size.or_larger(now);
            let is_floor = after <= floor || after <= R::QUARTER * before;
            if !(is_floor && after <= sane) {
                found = Found::Worn;
            }
        }
        if sizes::is_absurd(now, own) {
            found = Found::Worn;
        }
    }
    if found == Found::OutOfPivots
        && pivots as usize >= rule.most(matrix.order(), given.ranges.are_limited())
    {
        found = Found::Worn;
    }
    if found == Found::Worn {
        tableau.reset(start)?;
        x.fill(R::ZERO);
    }
    Ok((found, pivots))
}

/// Exchanges with thresholds for answers of this `size`; returns the size of the last one too.
fn exchange_all<R: Real>(
    (given, own): (Given<R>, R),
    (tableau, start): (&mut Tableau<R>, &InitialTableau<R>),
    (rule, mut may_exchange): (&mut impl Rule, impl FnMut(u32) -> bool),
    size: &mut R,
    [answer, x, scratch]: [&mut [R]; 3],
) -> Result<(Found, u32, R), Error> {
    let mut pivots = 0;
    loop {
        let noise = R::from_count(3) * R::EPSILON * *size;
        let allowed = |more| may_exchange(pivots + more);
        let (found, more) = search(tableau, rule, allowed, (given.ranges, noise), answer, x)?;
        pivots += more;
        if found.is_none() {
            tableau.reset(start)?;
            given.answer(tableau, x, scratch, answer)?;
        }
        let now = own.or_larger(sizes::norm(answer));
        // A first answer that was far too large hides what is wrong with the last one.
        match found {
            Some(found) if found != Found::Exact || !(R::from_count(SHRUNK) * now < *size) => {
                return Ok((found, pivots, now));
            }
            _ => *size = now,
        }
    }
}

/// Exchanges until nothing is wrong by more than `noise`, which rounding may be; nothing is found where the rule asks to
/// start anew.
fn search<R: Real, U: Rule>(
    tableau: &mut Tableau<R>,
    rule: &mut U,
    mut may_exchange: impl FnMut(u32) -> bool,
    (ranges, noise): (Ranges<R>, R),
    z: &mut [R],
    x: &mut [R],
) -> Result<(Option<Found>, u32), Error> {
    let mut pivots = 0;
    loop {
        let step = match ranges.are_limited() {
            true => next_of_three(tableau, rule, (ranges, noise), z, x, pivots),
            false => rule.next(z, tableau.exchanged(), noise, pivots),
        };
        let at = match step {
            Step::Exchange(at) => at,
            Step::End if U::FALLS && ranges.are_limited() => {
                let sides = (&*z, &*x, tableau.exchanged());
                let Some(edge) = falling::worst(ranges, sides, noise) else {
                    return Ok((Some(Found::Exact), pivots));
                };
                let may = &mut may_exchange;
                match falling::fall(tableau, ranges, edge, [z, x], may, &mut pivots)? {
                    Way::Done => continue,
                    Way::Stopped => return Ok((Some(Found::OutOfPivots), pivots)),
                    Way::Worn => return Ok((Some(Found::Worn), pivots)),
                }
            }
            Step::End => return Ok((Some(Found::Exact), pivots)),
            Step::StartAnew => return Ok((None, pivots)),
        };
        if !may_exchange(pivots) {
            return Ok((Some(Found::OutOfPivots), pivots));
        }
        let was_within = features::LIMITED && read(tableau.exchanged(), at);
        ranges.before_exchange(at, was_within, z, x);
        if !tableau.exchange(at, z)? {
            return Ok((Some(Found::Worn), pivots));
        }
        ranges.after_exchange(at, was_within, z, x);
        pivots += 1;
    }
}

/// The step that `rule` takes where edges have three sides.
fn next_of_three<R: Real, U: Rule>(
    tableau: &mut Tableau<R>,
    rule: &mut U,
    (ranges, noise): (Ranges<R>, R),
    z: &[R],
    x: &[R],
    pivots: u32,
) -> Step {
    let (z, exchanged) = tableau.viewed(z, |at, z, within| match U::FALLS {
        true => ranges.violation_from_below(at, z, read(x, at), within),
        false => ranges.violation(at, z, read(x, at), within),
    });
    rule.next(z, exchanged, noise, pivots)
}

/// x of the answer (−x_I, w_A), not below 0 where it is not to be.
fn take_over<R: Real>(answer: &[R], exchanged: &[bool], ranges: Ranges<R>, x: &mut [R]) {
    for ((x, &z), &within) in x.iter_mut().zip(answer).zip(exchanged) {
        *x = on_side(ranges, *x, if within { -z } else { R::ZERO });
    }
}

/// `value` where it has the sign that x has had, 0 elsewhere.
#[inline(always)]
fn on_side<R: Real>(ranges: Ranges<R>, x: R, value: R) -> R {
    let is_below = ranges.are_limited() && x < R::ZERO;
    let stays = if is_below { value < R::ZERO } else { value > R::ZERO };
    if stays { value } else { R::ZERO }
}

/// `residual` = Sx − b, less what the sides of x have beyond b, and `open` where x is not 0.
#[inline(never)]
pub(crate) fn settle<R: Real>(
    matrix: &Blocks<R>,
    given: Given<R>,
    x: &[R],
    residual: &mut [R],
    open: &mut [bool],
) -> Result<(), Error> {
    let sides = residual.iter_mut().zip(&mut *open).zip(given.load).zip(x);
    if given.ranges.are_limited() {
        for (at, (((residual, open), &load), &x)) in sides.enumerate() {
            (*residual, *open) = (-given.on(at, load, x), x != R::ZERO);
        }
        return multiply_add(matrix, x, open, residual);
    }
    for (((residual, open), &load), &x) in sides {
        (*residual, *open) = (-load, x > R::ZERO);
    }
    multiply_add(matrix, x, open, residual)
}

/// x_I −= S_II⁻¹ r_I, not below 0 where it is not to be.
#[inline(never)]
fn correct<R: Real>(
    tableau: &mut Tableau<R>,
    ranges: Ranges<R>,
    residual: &[R],
    change: &mut [R],
    x: &mut [R],
) -> Result<(), Error> {
    // What it says of the other edges is not read.
    tableau.answer(residual, change)?;
    for ((x, &change), &within) in x.iter_mut().zip(change.iter()).zip(tableau.exchanged()) {
        *x = on_side(ranges, *x, if within { *x + change } else { R::ZERO });
    }
    Ok(())
}
