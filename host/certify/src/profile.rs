//! How fluxes vary along sides between quads, so that what means of f leave out need not stay in its cell.
//!
//! What leaves one cell enters the other; on D s − u is 0, and a weight of an output is constant along each edge. So ρ·n may be any
//! profile without a mean on sides between stretched quads and on D. In a row of quads from side to opposite side, profiles
//! L and R of P_n take R − L off the factor d of P_n in det DF (f − f̄), which would have to go across the row otherwise:
//! ```text
//!   Σ a (L² + LR + R²)/(3(2n + 1)) + b (d − (R − L))² ∫I_n²,    a and b the squares of both columns of DF over det DF, by A⁻¹,
//! ```
//! is least where a tridiagonal system holds for each n. Profiles of any other kind are as good for the bound.

use signorini_problem::{EdgeKind, Problem};

use super::legendre::DEGREES;

/// Factors of Legendre's polynomials in |E| times a flux without a mean along a side, outward, in the direction of that side.
pub type Profile = [f64; DEGREES];

/// The profiles of a cell's sides; those of a triangle are 0.
pub type Sides = [Profile; 4];

/// Nothing leaves through any side.
pub const NO_SIDES: Sides = [[0.0; DEGREES]; 4];

/// A quad in both of its rows, along x̂ and along ŷ: the weights a and b, and d.
#[derive(Debug, Clone, Copy)]
pub struct InRows(pub [([f64; 2], Profile); 2]);

/// The profiles of all edges, in the direction of each; `quads` has the stretched ones among all cells.
pub fn profiles(problem: &Problem, quads: &[Option<InRows>]) -> Vec<Profile> {
    let mut profiles = vec![[0.0; DEGREES]; problem.kinds.len()];
    let mut seen = vec![[false; 2]; quads.len()];
    let is_open = |edge: usize| match problem.kinds[edge] {
        EdgeKind::Interior => {
            problem.topology.cells_of(edge).iter().flatten().all(|&at| quads[at].is_some())
        }
        kind => kind == EdgeKind::Dirichlet,
    };
    // Rows that end first; what is left are rings, cut anywhere.
    for rings in [false, true] {
        for at in (0..quads.len()).filter(|&at| quads[at].is_some()) {
            for side in 0..4 {
                let edge = problem.topology.edges_of(at)[side] as usize;
                let begins = problem.kinds[edge] != EdgeKind::Interior || !is_open(edge);
                if !seen[at][axis(side)] && (begins || rings) {
                    let row = row(problem, &is_open, (at, side), &mut seen);
                    settle(problem, quads, &is_open, &row, &mut profiles);
                }
            }
        }
    }
    profiles
}

/// The profiles of the sides of a cell.
pub fn of_cell(problem: &Problem, at: usize, profiles: &[Profile]) -> Sides {
    let mut sides = NO_SIDES;
    for (side, own) in sides.iter_mut().enumerate().take(problem.topology.edges_of(at).len()) {
        let edge = problem.topology.edges_of(at)[side] as usize;
        *own = std::array::from_fn(|n| sign(problem, (at, side), n) * profiles[edge][n]);
    }
    sides
}

/// 0 of the sides at x̂ = 0 and 1, 1 of the others.
fn axis(side: usize) -> usize {
    usize::from(side.is_multiple_of(2))
}

/// The sign of P_n along a side: backwards t is 1 − t, and out is in.
fn sign(problem: &Problem, (at, side): (usize, usize), n: usize) -> f64 {
    let edge = problem.topology.edges_of(at)[side] as usize;
    let is_along = problem.topology.first_side(edge) == (at, side);
    if is_along || n % 2 == 1 { 1.0 } else { -1.0 }
}

/// Quads from side to opposite side, each with the side that it is entered by.
fn row(
    problem: &Problem,
    is_open: &impl Fn(usize) -> bool,
    start: (usize, usize),
    seen: &mut [[bool; 2]],
) -> Vec<(usize, usize)> {
    let (mut row, mut next) = (Vec::new(), start);
    loop {
        let (at, side) = next;
        if std::mem::replace(&mut seen[at][axis(side)], true) {
            return row;
        }
        row.push((at, side));
        let edge = problem.topology.edges_of(at)[(side + 2) % 4] as usize;
        if problem.kinds[edge] != EdgeKind::Interior || !is_open(edge) {
            return row;
        }
        let sides = problem.topology.sides_of(edge);
        next = if sides[0] == (at, (side + 2) % 4) { sides[1] } else { sides[0] };
    }
}

/// The best profiles along a row.
fn settle(
    problem: &Problem,
    quads: &[Option<InRows>],
    is_open: &impl Fn(usize) -> bool,
    row: &[(usize, usize)],
    profiles: &mut [Profile],
) {
    let edge = |(at, side): (usize, usize)| problem.topology.edges_of(at)[side] as usize;
    let mut edges: Vec<usize> = row.iter().map(|&entry| edge(entry)).collect();
    edges.extend(row.last().map(|&(at, side)| edge((at, (side + 2) % 4))));
    let is_ring = edges.first() == edges.last();
    for n in 1..DEGREES {
        // Rows of the system: diagonal, the entry behind it, right-hand side.
        let mut rows = vec![[0.0; 3]; edges.len()];
        for (k, &(at, side)) in row.iter().enumerate() {
            let Some(InRows(both)) = &quads[at] else { continue };
            let ([a, b], wanted) = &both[axis(side)];
            let degree = (2 * n + 1) as f64;
            let square = (1.0 / (degree + 2.0) + 1.0 / (degree - 2.0)) / (4.0 * degree * degree);
            let (p, q) = (a / (3.0 * degree), b * square);
            let ends = [side, (side + 2) % 4];
            let signs = ends.map(|side| inward(side, n) * sign(problem, (at, side), n));
            // R − L is the last less the first where the row runs along the axis.
            let pull = 2.0 * q * wanted[n] * if side == 3 || side == 0 { 1.0 } else { -1.0 };
            rows[k][0] += 2.0 * (p + q);
            rows[k + 1][0] += 2.0 * (p + q);
            rows[k][1] += (p - 2.0 * q) * signs[0] * signs[1];
            rows[k][2] -= pull * signs[0];
            rows[k + 1][2] += pull * signs[1];
        }
        let last = rows.len() - 1;
        if is_ring || !is_open(edges[0]) {
            rows[0] = [1.0, 0.0, 0.0];
        }
        if is_ring || !is_open(edges[last]) {
            (rows[last - 1][1], rows[last]) = (0.0, [1.0, 0.0, 0.0]);
        }
        for (&edge, value) in edges.iter().zip(solved(rows)) {
            profiles[edge][n] = value;
        }
    }
}

/// φ at a side for a profile of 1 of P_n through it: [`super::local_flux`] has the ends at x̂ = 0 and ŷ = 1 backwards.
fn inward(side: usize, n: usize) -> f64 {
    let backwards = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
    [-1.0, 1.0, backwards, -backwards][side]
}

/// The solution of a symmetric tridiagonal system; 0 where it has none.
fn solved(mut rows: Vec<[f64; 3]>) -> Vec<f64> {
    for k in 1..rows.len() {
        let [diagonal, beside, right] = rows[k - 1];
        rows[k][0] -= beside * (beside / diagonal);
        rows[k][2] -= right * (beside / diagonal);
    }
    let mut behind = 0.0;
    let mut found: Vec<f64> = rows
        .iter()
        .rev()
        .map(|[diagonal, beside, right]| {
            behind = (right - beside * behind) / diagonal;
            behind
        })
        .collect();
    found.reverse();
    if found.iter().all(|value| value.is_finite()) { found } else { vec![0.0; rows.len()] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legendre::legendre;
    use signorini_problem::fixtures::{CURVED, distorted, on_grid, scatter};
    use signorini_scene::error::Result;
    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_tolerances::solve::LOCAL_FLUX;

    /// At each point of an inner edge what leaves one cell enters the other.
    #[test]
    fn what_leaves_one_cell_enters_the_other() -> Result<()> {
        let (_, problem) = on_grid(CURVED, distorted(grid(3, Cells::Quads)))?;
        let all = |edge: usize| std::array::from_fn(|n| scatter(DEGREES * edge + n));
        let profiles: Vec<Profile> = (0..problem.kinds.len()).map(all).collect();
        let out = |(at, side): (usize, usize), t: f64| -> f64 {
            let profile = of_cell(&problem, at, &profiles)[side];
            profile.iter().zip(legendre(t)).map(|(q, p)| q * p).sum()
        };
        let inner = |&edge: &usize| problem.kinds[edge] == EdgeKind::Interior;
        for edge in (0..problem.kinds.len()).filter(inner) {
            let [first, second] = problem.topology.sides_of(edge);
            for t in [0.0, 0.2, 0.7] {
                LOCAL_FLUX.check(format_args!("{edge}"), out(first, t) + out(second, 1.0 - t));
            }
        }
        Ok(())
    }

    /// Where all of a row's d can pass on to D, R − L takes all of it.
    #[test]
    fn a_row_between_dirichlet_sides_passes_all_on() -> Result<()> {
        let (_, problem) = on_grid(CURVED, grid(2, Cells::Quads))?;
        let quad = |at: usize| {
            let wanted: Profile = std::array::from_fn(|n| scatter(DEGREES * at + n));
            Some(InRows([([1e-9, 1.0], wanted), ([1.0, 1e-9], wanted)]))
        };
        let quads: Vec<_> = (0..problem.cells()).map(quad).collect();
        let profiles = profiles(&problem, &quads);
        for (at, quad) in quads.iter().enumerate() {
            let sides = of_cell(&problem, at, &profiles);
            let [(_, wanted), _] = quad.expect("a quad").0;
            for (n, wanted) in wanted.into_iter().enumerate().skip(1) {
                let rise = inward(1, n) * sides[1][n] - inward(3, n) * sides[3][n];
                assert!((rise - wanted).abs() < 1e-6, "{at} {n}: {rise} {wanted}");
            }
        }
        Ok(())
    }

    #[test]
    fn tridiagonal_systems_are_solved() {
        let rows = vec![[4.0, 1.0, 6.0], [5.0, -2.0, 5.0], [3.0, 0.0, 5.0]];
        LOCAL_FLUX.check_each("x", &solved(rows), &[1.0, 2.0, 3.0]);
    }
}
