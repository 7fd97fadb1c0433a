//! Parts of the domain that are weakly held: the one slow direction that is known beforehand.
//!
//! Where a connected part is held by a weak transfer coefficient only, or by a few contact edges,
//! adding a constant to u costs next to no energy, and sweeps need millions of rounds to find it. Let
//! d be 1 on the unknowns P of the part that are not in contact. The energy along u + t d is least at
//! ```text
//!   t = dᵀr / dᵀKd,    dᵀKd = −Σ K_ij + Σ c_i,    dᵀr = Σ b_i − Σ K_ij (u_j − u_i) − Σ c_i u_i,
//! ```
//! with i in P, j outside of it, and c_i what K_ii has beyond the element matrices ([`crate::mesh::diagonal`]). What flows
//! inside of P cancels, and left out it leaves no rounding errors behind. t < 0 ends where the first open edge touches, and
//! t > 0 where the first one below its gap does; there b contains what its flux has beyond the base. Each
//! shift lowers the energy, as every sweep does.

use crate::index::{Index, read};
use crate::system::{Shifts, System};
use crate::{Real, features};

/// Parts beyond these are left to the sweeps: a shift reads the whole matrix for every part.
const MOST_PARTS: usize = 16;

/// Shifts every part to where its energy is least.
pub(crate) fn all<R: Real, I: Index>(system: &System<R, I>, u: &mut [R]) {
    let Some(shifts) = system.shifts() else { return };
    for part in 0..shifts.parts.min(MOST_PARTS) {
        let shift = best(system, &shifts, part, u);
        if shift != R::ZERO && shift.finite() {
            for i in 0..system.counts().unknowns() {
                if moves(system, &shifts, part, u, i)
                    && let Some(entry) = u.get_mut(i)
                {
                    *entry += shift;
                }
            }
        }
    }
    // A shift that ends at a touch may round to the wrong side of it.
    system.make_feasible(u);
}

fn moves<R: Real, I: Index>(
    system: &System<R, I>,
    shifts: &Shifts<R, I>,
    part: usize,
    u: &[R],
    i: usize,
) -> bool {
    let counts = system.counts();
    let active = system.law_on(i).is_some_and(|law| law.touches(read(u, i)));
    i < counts.unknowns() && !active && read(shifts.part, i).at() == part
}

fn best<R: Real, I: Index>(
    system: &System<R, I>,
    shifts: &Shifts<R, I>,
    part: usize,
    u: &[R],
) -> R {
    let (mut force, mut stiffness) = (R::ZERO, R::ZERO);
    let [mut down, mut up] = [R::INFINITY; 2];
    for (i, (row, &load)) in system.matrix().iter().zip(system.load()).enumerate() {
        if !moves(system, shifts, part, u, i) {
            continue;
        }
        let own = read(u, i);
        // What an edge stores cancels most of its load: their difference is summed.
        let stored = read(shifts.diagonal.of_step(), i);
        force += if features::STORAGE { load - stored * own } else { load };
        stiffness += stored;
        for (j, value) in row.entries().skip(1) {
            if !moves(system, shifts, part, u, j) {
                force -= value * (read(u, j) - own);
                stiffness -= value;
            }
        }
        if let Some(law) = system.law_on(i) {
            let opening = law.opening(own);
            if features::LIMITED {
                force += law.missing(own);
            }
            if features::LIMITED && opening < R::ZERO {
                up = up.or_smaller(-opening);
            } else {
                down = down.or_smaller(opening);
            }
        }
    }
    for (i, term) in shifts.diagonal.of_laws() {
        if moves(system, shifts, part, u, i) {
            force -= term * read(u, i);
            stiffness += term;
        }
    }
    let shift = if stiffness > R::ZERO {
        force / stiffness
    } else if force < R::ZERO {
        -down
    } else if features::LIMITED && force > R::ZERO && up.finite() {
        up
    } else {
        R::ZERO
    };
    let shift = shift.or_larger(-down);
    if features::LIMITED { shift.or_smaller(up) } else { shift }
}
