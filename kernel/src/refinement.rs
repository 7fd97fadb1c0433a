//! Full accuracy from a short scalar: defect correction in fixed memory.
//!
//! In `f32` a solve ends where rounding hides the residual, and at a contrast of 10⁴ that can be
//! percents of u. The remedy is to know the defect of the iterate better than the sweep does. Written
//! with differences,
//! ```text
//!   d_i = b_i − Σ_{j≠i} K_ij (u_j − u_i) − c_i u_i,       c_i what K_ii has beyond the element matrices,
//! ```
//! each term is rounded by a few ε of *itself*: d is the exact defect of a matrix whose entries are
//! changed by a few ε, symmetric like K. A correction v then solves the same contact problem with load d
//! and bounds ψ − u, small numbers with the full relative precision of the scalar. u + v is kept as
//! two numbers (high and low part), so that the next defect profits from it.

use crate::conjugate;
use crate::error::{Array, Error, same_length};
use crate::index::{Index, read};
use crate::mesh::diagonal::DiagonalTerms;
use crate::mesh::edges::EdgeCounts;
use crate::relaxation::Relaxation;
use crate::rows::Rows;
use crate::solver::{Outcome, Settings, Solver, Status};
use crate::system::{Residual, System};
use crate::{Math, Real};

/// How much scratch [`run`] takes: an array over edges, two over unknowns and one over contact edges.
pub const fn scratch(counts: EdgeCounts) -> usize {
    counts.edges() + 2 * counts.unknowns() + counts.contact
}

/// Sweeps after which a solve that has not ended gets help: more than any well-shaped mesh of 10⁵
/// edges needs.
pub const PLAIN: u32 = 10_000;

/// Rounds of help at most; after each, sweeps judge the iterate.
const HELP: u32 = 8;

/// A solve whose slow parts are left to conjugate gradients where plain sweeps do not end.
fn solve<R: Real, I: Index, M: Math<R>, const WIDTH: usize>(
    system: &System<R, I>,
    settings: Settings<R>,
    u: &mut [R],
    rows: &mut Rows<R, I, WIDTH>,
    [direction, residual]: [&mut [R]; 2],
) -> Result<Outcome<R>, Error> {
    let most = settings.max_sweeps;
    let plain = Settings { max_sweeps: most.min(PLAIN), ..settings };
    let mut outcome = Solver::<R, M>::with_math(plain)?.run(system, rows, u)?;
    for _ in 0..HELP {
        let left = most.saturating_sub(outcome.sweeps);
        let ended = !matches!(outcome.status, Status::OutOfSweeps | Status::Stalled);
        if ended || left == 0 {
            break;
        }
        let unknowns = u32::try_from(system.load().len()).unwrap_or(u32::MAX);
        let iterations = left.min(unknowns.saturating_mul(4).max(PLAIN));
        let goal = outcome.residual.rounding;
        let help = [&mut *direction, &mut *residual];
        let used = conjugate::run(system, rows, goal, iterations, u, help)?;
        // At least one sweep judges, also where the help has used up all that was left.
        let check = left.saturating_sub(used).min(PLAIN / 4);
        let again = Settings { max_sweeps: check.saturating_add(1), ..settings };
        let before = outcome;
        outcome = Solver::<R, M>::with_math(again)?.run(system, rows, u)?;
        outcome.sweeps = outcome.sweeps.saturating_add(before.sweeps).saturating_add(used);
        outcome.conjugate = before.conjugate.saturating_add(used);
    }
    Ok(outcome)
}

/// Solves, and where rounding ended the solve corrects until corrections vanish or `rounds` are up.
///
/// `u` is start and answer, as for [`Solver::run`], and `low` becomes its low part: u + low is the answer. Both have an entry an
/// edge. `rows` are swept over, of the system's numbering; the scratch is as long as [`scratch`] says. `diagonal` is what K has
/// on its diagonal beyond the element matrices. The outcome counts all sweeps; its residual is that of the corrected iterate,
/// relative to the size of u.
///
/// # Errors
/// Slices of the wrong length, a relaxation factor outside (0, 2).
pub fn run<R: Real, I: Index, M: Math<R>, const WIDTH: usize>(
    system: &System<R, I>,
    diagonal: DiagonalTerms<R, I>,
    settings: Settings<R>,
    rounds: u32,
    [u, low]: [&mut [R]; 2],
    mut rows: Rows<R, I, WIDTH>,
    all: &mut [R],
) -> Result<Outcome<R>, Error> {
    let counts = system.counts();
    same_length(Array::Scratch, low.len(), u.len())?;
    same_length(Array::Scratch, all.len(), scratch(counts))?;
    let (direction, rest) = all.split_at_mut_checked(counts.edges()).unwrap_or_default();
    let (residual, rest) = rest.split_at_mut_checked(counts.unknowns()).unwrap_or_default();
    let (defect, lower) = rest.split_at_mut_checked(counts.unknowns()).unwrap_or_default();
    low.fill(R::ZERO);
    let mut outcome =
        solve::<R, I, M, WIDTH>(system, settings, u, &mut rows, [direction, residual])?;
    let size = outcome.residual;
    for _ in 0..rounds {
        if outcome.status != Status::RoundingLimit {
            break;
        }
        measure_defect(system, diagonal, u, defect);
        let on_contact = u.get(counts.free..).unwrap_or(&[]);
        let law = system.law().of_correction(on_contact, lower);
        if law.check_finite().is_err() || defect.iter().any(|x| !x.finite()) {
            outcome.status = Status::NotFinite;
            low.fill(R::ZERO);
            break;
        }
        let correction = system.with_data(defect, law)?;
        let goal = goal(settings, &outcome, size.scale());
        let mut next =
            solve::<R, I, M, WIDTH>(&correction, goal, low, &mut rows, [direction, residual])?;
        next.residual = Residual { range: size.range, load: size.load, ..next.residual };
        next.sweeps = next.sweeps.saturating_add(outcome.sweeps);
        next.conjugate = next.conjugate.saturating_add(outcome.conjugate);
        outcome = next;
        if outcome.status == Status::NotFinite {
            low.fill(R::ZERO);
            break;
        }
        if let (Some(u), Some(low)) = (u.get_mut(counts.free..), low.get_mut(counts.free..)) {
            law.close(u, low, system.law());
        }
        let change = low.iter().fold(R::ZERO, |most, v| most.or_larger(v.magnitude()));
        renormalise(u, low);
        // u + (ψ − u) may round to less than ψ.
        if let (Some(u), Some(low)) = (u.get_mut(counts.free..), low.get_mut(counts.free..)) {
            system.law().snap_to_gap(u, low);
        }
        if u.iter().any(|u| !u.finite()) {
            outcome.status = Status::NotFinite;
            break;
        }
        if change <= R::EPSILON * size.range {
            break;
        }
    }
    Ok(outcome)
}

/// A correction is asked for the last digit of u, starting from the ω found so far.
fn goal<R: Real>(settings: Settings<R>, so_far: &Outcome<R>, scale: R) -> Settings<R> {
    let relaxation = match settings.relaxation {
        Relaxation::Adaptive(_) => Relaxation::Adaptive(so_far.omega),
        fixed => fixed,
    };
    Settings {
        relaxation,
        tolerance: settings.tolerance.or_larger(R::EPSILON),
        accuracy: settings.accuracy.or_larger(R::EPSILON),
        scale,
        max_sweeps: settings.max_sweeps.saturating_sub(so_far.sweeps),
    }
}

fn measure_defect<R: Real, I: Index>(
    system: &System<R, I>,
    diagonal: DiagonalTerms<R, I>,
    u: &[R],
    defect: &mut [R],
) {
    defect.iter_mut().zip(defects(system, u)).for_each(|(entry, defect)| *entry = defect);
    for (edge, product) in diagonal.products(u) {
        if let Some(defect) = defect.get_mut(edge) {
            *defect -= product;
        }
    }
}

/// b_i − Σ_{j≠i} K_ij (u_j − u_i) for every unknown; what K_ii has beyond the element matrices is left to the caller.
pub fn defects<R: Real, I: Index>(system: &System<R, I>, u: &[R]) -> impl Iterator<Item = R> {
    let rows = system.matrix().iter().zip(system.load()).enumerate();
    rows.map(|(i, (row, &load))| {
        let own = read(u, i);
        let others = row.entries().skip(1);
        others.fold(load, |sum, (j, value)| sum - value * (read(u, j) - own))
    })
}

/// u + low as the nearest number and the exact rest.
pub(crate) fn renormalise<R: Real>(u: &mut [R], low: &mut [R]) {
    for (u, low) in u.iter_mut().zip(low) {
        let sum = *u + *low;
        *low += *u - sum;
        *u = sum;
    }
}
