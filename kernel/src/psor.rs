//! Projected successive over-relaxation, one sweep at a time.
//!
//! ```text
//!   u_i ← u_i + ω (b_i − Σ_j K_ij u_j) / K_ii          on free edges
//!   u_i ← max(ψ_i, the same)                           on contact edges
//! ```
//! It converges for any ω in (0, 2) and any start, since K is symmetric positive definite. It knows
//! rows and bounds, and nothing of elements.

use crate::csr::Row;
use crate::index::{Index, read};
use crate::real::Real;
use crate::signorini::System;

/// One sweep over all unknowns in order; `u` has one entry an edge, Dirichlet values included.
pub fn sweep<R: Real, I: Index>(system: &System<R, I>, u: &mut [R], omega: R) {
    let rows = system.matrix().iter().zip(system.load()).enumerate();
    for (i, (row, &load)) in rows.clone().take(system.counts().free) {
        let relaxed = relax(&row, load, u, i, omega);
        write(u, i, relaxed);
    }
    for ((i, (row, &load)), &lower) in rows.skip(system.counts().free).zip(system.lower()) {
        let relaxed = relax(&row, load, u, i, omega);
        write(u, i, if relaxed > lower { relaxed } else { lower });
    }
}

#[inline(always)]
fn relax<R: Real, I: Index>(row: &Row<R, I>, load: R, u: &[R], i: usize, omega: R) -> R {
    // ω / K_ii first: the division then waits for no neighbour, and runs beside the row before.
    read(u, i) + omega / row.diagonal() * (load - row.dot(u))
}

#[inline(always)]
fn write<R>(u: &mut [R], i: usize, value: R) {
    if let Some(entry) = u.get_mut(i) {
        *entry = value;
    }
}
