//! Projected successive over-relaxation, one sweep at a time.
//!
//! ```text
//!   u_i ← u_i + ω (b_i − Σ_j K_ij u_j) / K_ii = (1 − ω) u_i + ω b_i / K_ii − Σ_{j≠i} (ω K_ij / K_ii) u_j
//!                                                                  on free edges,
//!   u_i ← max(ψ_i, the same)                                       on contact edges.
//! ```
//! Where the flux of a contact edge has two ends, the same with the load of each is what u_i lies between, and ψ_i if it may:
//! a proximal step, which lowers the energy for any ω in (0, 2) too ([`crate::law::EdgeLaw::project`]).
//! It converges for any ω in (0, 2) and any start, since K is symmetric positive definite. It knows
//! rows and bounds, and nothing of elements. A NaN becomes the gap on a contact edge, and spreads
//! elsewhere: the residual tells.
//!
//! This is the inner loop of the product, and the one place of the kernel with `unsafe` code: reading
//! u without a test of the position saves half of the instructions of plain safe code, and a fifth of those
//! of the best that was found (`host/bake/records/cost.txt`, `docs/decisions/packed-rows.md`).

use crate::error::{Array, Error, same_length};
use crate::index::{Index, read};
use crate::law::{EdgeLaw, Law, Move};
use crate::rows::{Row, Rows};
use crate::{Real, features};

/// One sweep over all unknowns in order; `u` has one entry an edge, Dirichlet values included.
///
/// # Errors
/// Arrays of the wrong length.
// Neither is inlined, so that symbols tell whether an image holds code for contact.
#[inline(never)]
#[allow(unsafe_code)]
pub fn sweep<R: Real, I: Index, const WIDTH: usize>(
    rows: &Rows<R, I, WIDTH>,
    law: Law<R>,
    u: &mut [R],
) -> Result<(), Error> {
    same_length(Array::Unknowns, u.len(), rows.counts().edges())?;
    law.check_length(rows.counts())?;
    // SAFETY: u has an entry for each edge of the rows' mesh.
    unsafe {
        relax_free(rows, u);
        if features::CONTACT {
            // Whoever has no limits pays for none.
            match law.is_limited() {
                true => relax_contact(rows, u, law.edges().zip(rows.contact()).map(soft)),
                false => relax_contact(rows, u, law.edges().map(|law| (law, R::ZERO))),
            }
        }
    }
    Ok(())
}

/// One sweep over the free edges alone: all of it where nothing is in contact.
///
/// # Errors
/// Arrays of the wrong length.
#[inline(never)]
#[allow(unsafe_code)]
pub fn sweep_free<R: Real, I: Index, const WIDTH: usize>(
    rows: &Rows<R, I, WIDTH>,
    u: &mut [R],
) -> Result<(), Error> {
    same_length(Array::Unknowns, u.len(), rows.counts().edges())?;
    // SAFETY: u has an entry for each edge of the rows' mesh.
    unsafe { relax_free(rows, u) };
    Ok(())
}

/// How far an iterate is from complementarity, measured with the rows of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Defect<R> {
    /// max |r_i|/K_ii, on contact edges |min(u_i − ψ_i, −r_i/K_ii)|; NaN where anything is.
    pub largest: R,
    /// The sum of the same over all unknowns.
    pub sum: R,
}

/// Measures `u` at the cost of a sweep; the solver's residual without CSR ([`crate::system`]).
///
/// # Errors
/// Arrays of the wrong length.
#[inline(never)]
#[allow(unsafe_code)]
pub fn defect<R: Real, I: Index, const WIDTH: usize>(
    rows: &Rows<R, I, WIDTH>,
    law: Law<R>,
    u: &[R],
) -> Result<Defect<R>, Error> {
    same_length(Array::Unknowns, u.len(), rows.counts().edges())?;
    law.check_length(rows.counts())?;
    let (keep, per_omega) = (R::ONE - rows.omega(), R::ONE / rows.omega());
    let softness = |row: &Row<R, I, WIDTH>| row.softness() * per_omega;
    let step = |row: &Row<R, I, WIDTH>, neighbours: usize, own: R| {
        // SAFETY: u has an entry for each edge of the rows' mesh.
        (unsafe { relaxed(row, neighbours, keep, own, u.as_ptr()) } - own) * per_omega
    };
    let mut defect = Defect::default();
    let mut include = |size: R| {
        // Written so that a NaN is taken over and then stays.
        let is_nan = !(defect.largest >= R::ZERO);
        if !(size <= defect.largest || is_nan) {
            defect.largest = size;
        }
        defect.sum += size;
    };
    for (row, &own) in rows.free().iter().zip(u) {
        include(step(row, WIDTH, own).magnitude());
    }
    if !features::CONTACT {
        return Ok(defect);
    }
    let on_contact = u.iter().skip(rows.free().len());
    for ((row, &own), law) in rows.contact().iter().zip(on_contact).zip(law.edges()) {
        let step = step(row, WIDTH / 2, own);
        let (Move::Row(size) | Move::Gap(size)) =
            law.movement(law.opening(own), step, softness(row));
        include(size.magnitude());
    }
    Ok(defect)
}

/// Whether each row's residual is small enough to be rounding: at most `slack` ε of the sum
/// |b_i|/K_ii + Σ|K_ij u_j|/K_ii, on contact edges of |u_i| + |ψ_i| where the opening decides. Whoever
/// changes one entry of K by that much makes u the solution. Costs more than [`defect`], and is asked more seldom.
#[inline(never)]
pub fn is_rounding<R: Real, I: Index, const WIDTH: usize>(
    rows: &Rows<R, I, WIDTH>,
    law: Law<R>,
    u: &[R],
    slack: u32,
) -> bool {
    let slack = R::from_count(slack) * R::EPSILON;
    let omega = rows.omega();
    let all = rows.free().iter().chain(rows.contact()).zip(u).enumerate();
    all.into_iter().all(|(i, (row, &own))| {
        let neighbours = if i < rows.counts().free { WIDTH } else { WIDTH / 2 };
        let start = (row.load() - omega * own, row.load().magnitude() + omega * own.magnitude());
        let entries = row.entries().iter().zip(row.offsets()).take(neighbours);
        let (step, size) = entries.fold(start, |(step, size), (&entry, offset)| {
            let product = entry * read(u, offset.at() / size_of::<R>());
            (step - product, size + product.magnitude())
        });
        let Some(at) = i.checked_sub(rows.counts().free) else {
            return step.magnitude() <= slack * size;
        };
        let law = law.on(at);
        match law.movement(omega * law.opening(own), step, row.softness()) {
            Move::Gap(_) => {
                law.opening(own).magnitude() <= slack * (own.magnitude() + law.gap().magnitude())
            }
            Move::Row(moved) if features::LIMITED => {
                moved.magnitude() <= slack * (size + (moved - step).magnitude())
            }
            Move::Row(_) => step.magnitude() <= slack * size,
        }
    })
}

/// # Safety
/// `u` must have an entry for each edge of the rows' mesh.
#[inline(always)]
#[allow(unsafe_code)]
unsafe fn relax_free<R: Real, I: Index, const WIDTH: usize>(rows: &Rows<R, I, WIDTH>, u: &mut [R]) {
    let keep = R::ONE - rows.omega();
    let u = u.as_mut_ptr();
    let mut own = u;
    for row in rows.free() {
        // SAFETY: as the caller has promised, and the free edges come first in u.
        unsafe {
            own.write(relaxed(row, WIDTH, keep, *own, u));
            own = own.add(1);
        }
    }
}

/// Contact edges have one cell, and half a row of neighbours.
///
/// # Safety
/// `u` must have an entry for each edge of the rows' mesh.
#[inline(always)]
#[allow(unsafe_code)]
unsafe fn relax_contact<R: Real, I: Index, const WIDTH: usize>(
    rows: &Rows<R, I, WIDTH>,
    u: &mut [R],
    laws: impl Iterator<Item = (EdgeLaw<R>, R)>,
) {
    let keep = R::ONE - rows.omega();
    let u = u.as_mut_ptr();
    // SAFETY: as the caller has promised, and the contact edges follow the free ones in u.
    let mut own = unsafe { u.add(rows.free().len()) };
    for (row, (law, softness)) in rows.contact().iter().zip(laws) {
        // SAFETY: as above, and there is a row for each contact edge.
        unsafe {
            let relaxed = relaxed(row, WIDTH / 2, keep, *own, u);
            own.write(law.project(relaxed, softness));
            own = own.add(1);
        }
    }
}

/// The law of an edge, with ω/K_ii: by how much a unit of load moves its u.
#[inline(always)]
fn soft<R: Real, I: Index, const WIDTH: usize>(
    (law, row): (EdgeLaw<R>, &Row<R, I, WIDTH>),
) -> (EdgeLaw<R>, R) {
    (law, row.softness())
}

/// The new value of an unknown before projection, from the first `neighbours` of its row.
///
/// # Safety
/// `u` must point to one number an edge of the mesh that `row` was made for.
#[inline(always)]
#[allow(unsafe_code)]
unsafe fn relaxed<R: Real, I: Index, const WIDTH: usize>(
    row: &Row<R, I, WIDTH>,
    neighbours: usize,
    keep: R,
    own: R,
    u: *const R,
) -> R {
    let entries = row.entries().iter().take(neighbours).enumerate();
    entries.fold(row.load() + keep * own, |sum, (k, &entry)| {
        // SAFETY: every offset of a row is a multiple of the size of R inside of u.
        sum - entry * unsafe { *u.byte_add(offset(row.offsets(), k)) }
    })
}

/// Offset k of a row. Two short ones are read as one word: that saves a load.
#[inline(always)]
#[allow(unsafe_code)]
fn offset<I: Index, const WIDTH: usize>(offsets: &[I; WIDTH], k: usize) -> usize {
    if size_of::<I>() > 2 {
        return read(offsets, k).at();
    }
    // SAFETY: WIDTH is even, and offsets stand behind scalars in a `repr(C)` row: words are aligned.
    let word = unsafe { *offsets.as_ptr().cast::<u32>().add(k / 2) };
    let high = (k % 2 == 1) == cfg!(target_endian = "little");
    (if high { word >> 16 } else { word & 0xffff }) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csr::Csr;
    use crate::mesh::edges::EdgeCounts;
    use crate::system::System;

    const EPSILON: f64 = f64::EPSILON;
    /// Multiples of ε that rounding may make.
    const SLACK: u32 = 64;

    /// Asks u of a row u_0 − `joined` u_1 = `load`, where u_1 is given, with rows for this ω: of a contact edge with this
    /// gap, or of a free one.
    fn asked(
        load: f64,
        joined: f64,
        u: [f64; 2],
        gap: Option<f64>,
        omega: f64,
    ) -> Result<bool, Error> {
        let (values, gap) = ([1.0, -joined], gap.as_slice());
        let matrix = Csr::new(&[0, 2], &[0_u16, 1], &values, 2)?;
        let contact = gap.len();
        let counts = EdgeCounts { free: 1 - contact, contact, dirichlet: 1 };
        let mut memory = [Row::<f64, u16, 2>::EMPTY];
        let mut rows = Rows::of_matrix(&matrix, counts, &mut memory)?;
        rows.set(&System::new(matrix, &[load], Law::above(gap), counts)?, omega)?;
        Ok(is_rounding(&rows, Law::above(gap), &u, SLACK))
    }

    /// b = 8 and u = 8 + d are terms of 16 in all, of which 64 ε may be off: d up to 1024 ε, for every ω.
    #[test]
    fn a_row_may_be_off_by_its_terms() -> Result<(), Error> {
        for omega in [0.5, 1.0, 1.5] {
            for (steps, solves) in [(0.0, true), (768.0, true), (1016.0, true), (1280.0, false)] {
                for d in [steps * EPSILON, -steps * EPSILON] {
                    let found = asked(8.0, 1.0, [8.0 + d, 0.0], None, omega)?;
                    assert_eq!(found, solves, "{omega} {d:e}");
                }
            }
            // Of u = 1000 + 1 − 1001 there may be more.
            let off = 32768.0 * EPSILON;
            assert!(asked(-1000.0, 1001.0, [1.0 + off, 1.0], None, omega)?, "{omega}");
            assert!(!asked(-1000.0, 1001.0, [1.0 + 8.0 * off, 1.0], None, omega)?, "{omega}");
        }
        Ok(())
    }

    /// Where a row is pressed its opening decides, and may be 64 ε of |u| + |ψ|.
    #[test]
    fn a_pressed_edge_is_next_to_its_gap() -> Result<(), Error> {
        for (gap, steps, solves) in [
            (0.5, 0.0, true),
            (0.5, 48.0, true),
            (0.5, 96.0, false),
            (2.0, 128.0, true),
            (2.0, 320.0, false),
            (4.0, 384.0, true),
            (4.0, 768.0, false),
        ] {
            for omega in [0.5, 1.0, 1.5] {
                let u = [gap + steps * EPSILON, 0.0];
                assert_eq!(asked(-100.0, 1.0, u, Some(gap), omega)?, solves, "{gap} {steps}");
            }
        }
        Ok(())
    }

    /// b = 1000, u = 1 + o and 999 u_1 leave −o, as much as the opening is: the row decides, of terms of 2000.
    #[test]
    fn an_edge_that_is_pulled_to_its_gap_asks_its_row() -> Result<(), Error> {
        for (steps, solves) in [(65536.0, true), (262_144.0, false)] {
            let u = [1.0 + steps * EPSILON, 1.0];
            assert_eq!(asked(1000.0, -999.0, u, Some(1.0), 1.0)?, solves, "{steps}");
        }
        Ok(())
    }
}
