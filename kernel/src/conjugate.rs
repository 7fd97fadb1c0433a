//! Conjugate gradients on a face: for the problems on which projected SOR crawls.
//!
//! Where A jumps by 10⁴ from cell to cell, D⁻¹K has a few eigenvalues near 0 and sweeps need 10⁵ rounds
//! for them; conjugate gradients need a few iterations for each. On the face of contact edges that
//! touch now, K is a plain positive definite matrix, so
//! ```text
//!   1. sweep once with ω = 1: edges that are pulled off the gap leave it
//!   2. hold the edges with u = ψ; minimise over the others, each with the load of its side of the gap, by conjugate
//!      gradients, preconditioned with D; a step that would cross the gap ends on it, and 1. follows
//!   3. back to 1. until nothing leaves the face and its residual is small
//! ```
//! Every step lowers the energy. Two vectors of scratch; K p is computed twice instead of stored.

use crate::error::{Array, Error, same_length};
use crate::index::{Index, read};
use crate::rows::Rows;
use crate::system::System;
use crate::{Real, features, psor};

/// Iterates at most `iterations` times, until every |r_i|/K_ii on the face is below `goal`; returns
/// the number of iterations. `u` must be feasible, and stays so; `rows` are set for the sweeps. The scratch is the direction p, one
/// entry an edge, and the residual r = b − Ku on the face, one an unknown.
///
/// # Errors
/// Arrays that do not belong to the same mesh.
pub fn run<R: Real, I: Index, const WIDTH: usize>(
    system: &System<R, I>,
    rows: &mut Rows<R, I, WIDTH>,
    goal: R,
    iterations: u32,
    u: &mut [R],
    [direction, residual]: [&mut [R]; 2],
) -> Result<u32, Error> {
    same_length(Array::Unknowns, u.len(), system.counts().edges())?;
    same_length(Array::Scratch, direction.len(), u.len())?;
    same_length(Array::Scratch, residual.len(), system.load().len())?;
    let buffers = &mut Buffers { direction, residual };
    let mut used = 0;
    rows.set(system, R::ONE)?;
    while used < iterations {
        psor::sweep(rows, system.law(), u)?;
        used += 1;
        let small = start(system, u, buffers, goal);
        if small && system.residual(u).largest <= goal {
            break;
        }
        let mut product = along(system, buffers);
        while used < iterations {
            used += 1;
            match step(system, u, buffers, product, goal) {
                Some(next) => product = next,
                None => break,
            }
        }
    }
    Ok(used)
}

struct Buffers<'a, R> {
    direction: &'a mut [R],
    /// 0 on held edges.
    residual: &'a mut [R],
}

/// r on the face and p = D⁻¹r; tells whether the residual is small already.
fn start<R: Real, I: Index>(
    system: &System<R, I>,
    u: &[R],
    buffers: &mut Buffers<R>,
    goal: R,
) -> bool {
    buffers.direction.fill(R::ZERO);
    let mut small = true;
    let rows = system.matrix().iter().zip(system.load()).enumerate();
    for ((i, (row, &load)), residual) in rows.zip(buffers.residual.iter_mut()) {
        *residual = if is_held(system, u, i) { R::ZERO } else { load - row.dot(u) };
        if features::LIMITED
            && let Some(law) = system.law_on(i)
        {
            *residual += law.missing(read(u, i));
        }
        let step = *residual / row.diagonal();
        small &= step.magnitude() <= goal;
        if let Some(entry) = buffers.direction.get_mut(i) {
            *entry = step;
        }
    }
    small
}

fn is_held<R: Real, I: Index>(system: &System<R, I>, u: &[R], i: usize) -> bool {
    system.law_on(i).is_some_and(|law| law.touches(read(u, i)))
}

/// rᵀD⁻¹r, the numerator of the step.
fn along<R: Real, I: Index>(system: &System<R, I>, buffers: &Buffers<R>) -> R {
    let rows = system.matrix().iter().zip(buffers.residual.iter());
    rows.fold(R::ZERO, |sum, (row, &r)| sum + r * (r / row.diagonal()))
}

/// One iteration; `None` where the face is done or has changed.
fn step<R: Real, I: Index>(
    system: &System<R, I>,
    u: &mut [R],
    buffers: &mut Buffers<R>,
    product: R,
    goal: R,
) -> Option<R> {
    let (mut curvature, mut room) = (R::ZERO, R::ONE / R::ZERO);
    for (i, row) in system.matrix().iter().enumerate() {
        let p = read(buffers.direction, i);
        curvature += p * row.dot(buffers.direction);
        if let Some(most) = system.law_on(i).and_then(|law| law.room(read(u, i), p)) {
            room = room.or_smaller(most);
        }
    }
    let length = product / curvature;
    if !(curvature > R::ZERO && length.finite()) {
        return None;
    }
    let crosses = room <= length;
    let length = length.or_smaller(room);
    for (u, &p) in u.iter_mut().zip(buffers.direction.iter()) {
        *u += length * p;
    }
    if crosses {
        snap_to_gap(system, u, buffers.direction, room);
        return None;
    }
    turn(system, u, buffers, length, product, goal)
}

/// Puts the edges that the step has brought to the gap exactly onto it.
fn snap_to_gap<R: Real, I: Index>(system: &System<R, I>, u: &mut [R], direction: &[R], room: R) {
    let entries = u.iter_mut().zip(direction).skip(system.counts().free);
    for ((u, &p), law) in entries.zip(system.law().edges()) {
        let rounding = R::EPSILON * (u.magnitude() + room * p.magnitude());
        if law.lands(*u, p, rounding) {
            *u = law.gap();
        }
    }
    system.make_feasible(u);
}

/// The new residual and the next conjugate direction.
fn turn<R: Real, I: Index>(
    system: &System<R, I>,
    u: &[R],
    buffers: &mut Buffers<R>,
    length: R,
    product: R,
    goal: R,
) -> Option<R> {
    let mut small = true;
    let mut next = R::ZERO;
    for (i, (row, residual)) in system.matrix().iter().zip(buffers.residual.iter_mut()).enumerate()
    {
        if !is_held(system, u, i) {
            *residual -= length * row.dot(buffers.direction);
        }
        let step = *residual / row.diagonal();
        next += *residual * step;
        small &= step.magnitude() <= goal;
    }
    if small || !next.finite() {
        return None;
    }
    let keep = next / product;
    let rows = system.matrix().iter().zip(buffers.residual.iter());
    for ((row, &residual), p) in rows.zip(buffers.direction.iter_mut()) {
        *p = residual / row.diagonal() + keep * *p;
    }
    Some(next)
}
