//! Which unknown on the wrong side is exchanged next.
//!
//! ```text
//!   Largest   the one that is wrong by most, and after n exchanges the first: few, and an end for every positive
//!             definite S (Murty)
//!   Phases    first those that must leave, x_i < 0, the worst of them first; then those that must come in, w_i < 0
//! ```
//! [`Largest`] takes as many exchanges as edges change sides, or hardly more, where a pass over all that are wrong takes a
//! sixth more. How many it takes at worst nobody knows. Where no entry of S off the diagonal is positive, and S is
//! positive definite, [`Phases`] come to an end for every load:
//! ```text
//!   1.  Each leaves once at most, for none comes in. S_II⁻¹ ≥ 0: as one leaves, the other x_I rise, and may stay after all.
//!   2.  With x_I ≥ 0 and some w_k < 0, k comes in with x_k > 0, and x_I rise: none ever has to leave, and w_A falls.
//! ```
//! From m open edges of n, k of which leave, that takes at most k + n − (m − k) exchanges. Where nothing is open it takes as
//! many as edges open, n at most. So once one has left, and those that have and those that would are more than m/2, the
//! tableau goes back to where nothing is open: at most m/2 exchanges are lost, and n + n/2 is the worst case of all states.
//!
//! Where fluxes have limits, edges at the upper end stay there in both phases, whatever their x. Then none is below its
//! least flux, and x is nowhere less than the solution. In a third phase x only falls, edge by edge (`falling`): an
//! open edge touches, a touching one reaches its limit, one at its limit with x > 0 leaves it, and may come back. That is
//! two exchanges an edge at most, 3n + n/2 in all.

use super::blocks::{SIDE, groups, padded};
use signorini_kernel::Real;
use signorini_kernel::features;

/// The choice of the next exchange.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// Nothing is wrong by more than rounding.
    End,
    /// Exchange this unknown.
    Exchange(usize),
    /// Go back to the first tableau: there is less to do from there.
    StartAnew,
}

impl Step {
    fn exchange(found: Option<usize>) -> Self {
        found.map_or(Self::End, Self::Exchange)
    }
}

/// Chooses exchanges.
pub trait Rule {
    /// Whether edges above their ranges wait for a phase of their own, in which x falls.
    const FALLS: bool;

    /// Exchanges, for a matrix of this order, after which there is no solution or rounding has eaten the tableau;
    /// `has_limits` where a flux has a third side.
    fn most(&self, order: usize, has_limits: bool) -> usize;

    /// Chooses the step after so many `pivots`, where nothing counts as wrong up to `noise`.
    ///
    /// z = −x where an unknown is exchanged, w elsewhere.
    fn next<R: Real>(&mut self, z: &[R], exchanged: &[bool], noise: R, pivots: u32) -> Step;
}

/// The one that is wrong by most, and after n exchanges the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Largest;

impl Rule for Largest {
    const FALLS: bool = false;

    fn most(&self, order: usize, has_limits: bool) -> usize {
        if features::LIMITED && has_limits { 2 * padded(order) } else { padded(order) }
    }

    fn next<R: Real>(&mut self, z: &[R], exchanged: &[bool], noise: R, pivots: u32) -> Step {
        Step::exchange(wrong(z, exchanged, noise, pivots < z.len() as u32))
    }
}

/// Those that must leave, then those that must come in. The first tableau has nothing exchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Phases {
    phase: Phase,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Phase {
    /// Before the first step.
    #[default]
    Begins,
    /// So many more may have to leave, before it is quicker to start anew.
    Leaves(u32),
    ComesIn,
}

impl Rule for Phases {
    const FALLS: bool = true;

    fn most(&self, order: usize, has_limits: bool) -> usize {
        let two = order + order / 2;
        if features::LIMITED && has_limits { two + 2 * order } else { two }
    }

    fn next<R: Real>(&mut self, z: &[R], exchanged: &[bool], noise: R, _: u32) -> Step {
        if self.phase != Phase::ComesIn {
            let (worst, leaving) = wrong_on(true, z, exchanged, noise);
            let room = match self.phase {
                Phase::Leaves(room) => room,
                _ => exchanged.iter().filter(|within| **within).count() as u32 / 2,
            };
            // One leaves in any case: often the others rise then, and may stay.
            let is_quicker = leaving <= room || self.phase == Phase::Begins;
            self.phase = match worst {
                Some(_) if is_quicker => Phase::Leaves(room.saturating_sub(1)),
                _ => Phase::ComesIn,
            };
            if worst.is_some() {
                return if is_quicker { Step::exchange(worst) } else { Step::StartAnew };
            }
        }
        Step::exchange(wrong_on(false, z, exchanged, noise).0)
    }
}

/// Of those within, or of those outside: the one that is wrong by most, and how many are.
#[inline(never)]
fn wrong_on<R: Real>(side: bool, z: &[R], exchanged: &[bool], noise: R) -> (Option<usize>, u32) {
    let (mut found, mut most, mut count) = (None, noise, 0);
    for (at, (&z, &within)) in z.iter().zip(exchanged).enumerate() {
        let excess = excess(z, side);
        if within == side && excess > noise {
            count += 1;
            if excess > most {
                (found, most) = (Some(at), excess);
            }
        }
    }
    (found, count)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_must_leave_goes_first() {
        use Step::{End, Exchange};
        let exchanged = [true, true, false, false, true];
        let mut phases = Phases::default();
        let mut next = |z: [f64; 5]| phases.next(&z, &exchanged, 0.5, 0);
        assert_eq!(next([0.5, 2.0, -9.0, -3.0, -4.0]), Exchange(1));
        assert_eq!(next([0.5, 0.5, -2.0, -3.0, -4.0]), Exchange(3));
        // Nothing goes back: whoever would have to is rounding, or S has another sign.
        assert_eq!(next([9.0, 0.5, -2.0, -0.5, f64::NAN]), Exchange(2));
        assert_eq!(next([9.0, 0.5, -0.5, 3.0, 0.0]), End);
    }

    #[test]
    fn where_most_must_leave_it_starts_anew() {
        use Step::{Exchange, StartAnew};
        let open = [true; 5];
        // Two of five may leave.
        let two = [1.0, 2.0, -3.0, -4.0, -5.0];
        let mut phases = Phases::default();
        let mut next = |z: [f64; 5], exchanged| phases.next(&z, exchanged, 0.5, 0);
        assert_eq!(next(two, &open), Exchange(1));
        let another = [1.0, -2.0, 3.0, -4.0, -5.0];
        assert_eq!(next(another, &[true, false, true, true, true]), StartAnew);
        // Then nothing leaves any more.
        assert_eq!(next([-1.0, -2.0, 9.0, 9.0, 9.0], &[false; 5]), Exchange(1));
        // Three of six may leave.
        let mut phases = Phases::default();
        let mut next = |z: [f64; 6], exchanged| phases.next(&z, exchanged, 0.5, 0);
        assert_eq!(next([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], &[true; 6]), Exchange(2));
        let others = [true, true, false, true, true, true];
        assert_eq!(next([1.0, 2.0, 0.0, 0.0, 0.0, 0.0], &others), Exchange(1));
        // One leaves in any case.
        let mut phases = Phases::default();
        let mut next = |z: [f64; 3], exchanged| phases.next(&z, exchanged, 0.5, 0);
        assert_eq!(next([1.0, 2.0, 3.0], &[true; 3]), Exchange(2));
        assert_eq!(next([1.0, -2.0, 3.0], &[true, true, false]), StartAnew);
    }

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
