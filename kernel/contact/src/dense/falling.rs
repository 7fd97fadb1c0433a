//! The third phase of exchanges with limits: the load of one edge falls until the edge is within its range.
//!
//! Off the diagonal no entry of S is positive, so S_II⁻¹ ≥ 0, and with one load all x_I fall:
//! ```text
//!   touching, w > hi       comes in with x = 0, and its flux falls from w to hi
//!   at hi with x > 0       its flux falls from hi until x = 0, or to lo
//!   the first open edge whose x becomes 0 on the way touches, and the way goes on from there
//! ```
//! The load moves by s, and x_i by −s (S_II⁻¹)_ik = s T_ik. Touching edges only gain flux meanwhile, x never rises again, and
//! edges at hi with x < 0 stay there: whoever is above its range afterwards gets a way of its own.

use super::ranges::Ranges;
use super::tableau::Tableau;
use signorini_kernel::Real;
use signorini_kernel::error::Error;
use signorini_kernel::index::{read, write};

/// How a way ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// The edge is within its range.
    Done,
    /// No more exchanges are allowed: x is not yet on its side.
    Stopped,
    /// A pivot that rounding has eaten.
    Worn,
}

/// The edge that is above its range by most, if by more than `noise`.
pub(super) fn worst<R: Real>(
    ranges: Ranges<R>,
    (z, x, exchanged): (&[R], &[R], &[bool]),
    noise: R,
) -> Option<usize> {
    let (mut found, mut most) = (None, noise);
    for (at, ((&z, &x), &within)) in z.iter().zip(x).zip(exchanged).enumerate() {
        let above = ranges.above(at, z, x, within);
        if above > most {
            (found, most) = (Some(at), above);
        }
    }
    found
}

/// Lets the load of `edge` fall. `z` is the answer and moves along, the sign of `x` tells the sides; counts in `pivots`.
pub(super) fn fall<R: Real>(
    tableau: &mut Tableau<R>,
    ranges: Ranges<R>,
    edge: usize,
    [z, x]: [&mut [R]; 2],
    mut may_exchange: impl FnMut(u32) -> bool,
    pivots: &mut u32,
) -> Result<Way, Error> {
    let [least, most] = ranges.ends(edge);
    let was_at_limit = read(tableau.exchanged(), edge);
    let mut flux = if was_at_limit { most } else { read(z, edge) };
    let end = if was_at_limit { least } else { most };
    let mut exchange = |tableau: &mut Tableau<R>, at: usize, z: &mut [R], pivots: &mut u32| {
        if !may_exchange(*pivots) {
            return Ok(Way::Stopped);
        }
        // What is exchanged is 0 on both sides: z of the others stays.
        write(z, at, R::ZERO);
        *pivots += 1;
        tableau.exchange(at, z).map(|done| if done { Way::Done } else { Way::Worn })
    };
    if !was_at_limit {
        let way = exchange(tableau, edge, z, pivots)?;
        if way != Way::Done {
            write(z, edge, flux);
            return Ok(way);
        }
        write(x, edge, -R::ONE);
    }
    loop {
        let (first, by) = leg(tableau, edge, [z, x], flux - end, was_at_limit);
        flux -= by;
        let Some(first) = first else {
            // At the end of its way: at its limit, or open.
            write(x, edge, if was_at_limit { R::ONE } else { -R::ONE });
            return Ok(Way::Done);
        };
        let way = exchange(tableau, first, z, pivots)?;
        if way != Way::Done {
            return Ok(way);
        }
        let touches_at = if first == edge { flux } else { ranges.excess(first, R::ONE) };
        write(z, first, touches_at);
        write(x, first, R::ZERO);
        if first == edge {
            return Ok(Way::Done);
        }
    }
}

/// Moves on by `left` at most: returns the edge whose x becomes 0 before that, and how far it went.
fn leg<R: Real>(
    tableau: &mut Tableau<R>,
    edge: usize,
    [z, x]: [&mut [R]; 2],
    left: R,
    may_touch: bool,
) -> (Option<usize>, R) {
    let (column, exchanged) = tableau.column(edge);
    let (mut first, mut by) = (None, left);
    let all = z.iter().zip(&*x).zip(column).zip(exchanged).enumerate();
    for (at, (((&z, &x), &t), &within)) in all {
        let falls = within && t < R::ZERO && (x > R::ZERO || at == edge && may_touch);
        if !falls {
            continue;
        }
        // z = −x, and what rounding has put below 0 has no way to go.
        let way = if z < R::ZERO { z / t } else { R::ZERO };
        if way < by {
            (first, by) = (Some(at), way);
        }
    }
    z.iter_mut().zip(column).for_each(|(z, &t)| *z -= by * t);
    (first, by)
}
