//! A flux that is admissible, from one that is not yet: the equilibrated τ of the error bound.
//!
//! The fluxes of the cells, formula (15), balance every cell but disagree across an edge while the
//! solver has not converged. τ has one value an edge and satisfies, up to rounding,
//! ```text
//!   Σ_i τ_i = −∫_T f on every cell,    τ = ∫g on N,    τ ≥ ∫q on C,    τ = ∫q where u > ψ.
//! ```
//! In two steps: one value an edge ([`agree`]), and then a walk over the cells from the leaves of a
//! forest to its roots that hands each cell's surplus on through its parent side ([`Cell::settle`]).
//! Inside, the two sides of an edge are weighted by 1/α, so that the soft cell decides: at jumps of
//! 10⁴ plain means cost a factor of 10 to 40 in the bound.

use crate::assembly::CellLoads;
use crate::boundary::Boundary;
use crate::edges::{Block, Edges};
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::flux::{on_quad, on_triangle};
use crate::forest::Forest;
use crate::index::{Index, read, write};
use crate::real::Real;
use crate::stiffness::Stiffness;

/// The iterate whose flux is equilibrated.
#[derive(Debug, Clone, Copy)]
pub struct Iterate<'a, R> {
    /// Means of u, one an edge.
    pub u: &'a [R],
    /// Means of ψ, one a contact edge.
    pub lower: &'a [R],
}

/// A cell with its sides: edges, and whether each is directed out of this cell.
#[derive(Debug, Clone, Copy)]
pub struct Cell<I, const SIDES: usize> {
    first_half: usize,
    edges: [I; SIDES],
}

impl<I: Index, const SIDES: usize> Cell<I, SIDES> {
    /// The cell whose half-edges begin with `first_half`.
    #[inline(always)]
    pub fn new(first_half: usize, edges: [I; SIDES]) -> Self {
        Self { first_half, edges }
    }

    /// ∫τ·n over the sides, outward; `tau` has one value an edge along its direction.
    #[inline(always)]
    pub fn outward<R: Real>(&self, half_edges: &[[I; 2]], tau: &[R]) -> [R; SIDES] {
        let mut half = self.first_half;
        self.edges.map(|edge| {
            let along = read(half_edges, edge.at())[0].at() == half;
            half += 1;
            let flux = read(tau, edge.at());
            if along { flux } else { -flux }
        })
    }

    /// Balances the cell through its side `parent` (a half-edge) and returns ∫τ·n over all sides.
    #[inline(always)]
    pub fn settle<R: Real>(
        &self,
        half_edges: &[[I; 2]],
        parent: usize,
        load: R,
        tau: &mut [R],
    ) -> [R; SIDES] {
        let mut out = self.outward(half_edges, tau);
        let side = parent.wrapping_sub(self.first_half);
        write(&mut out, side, R::ZERO);
        let rest = out.iter().fold(-load, |rest, &flux| rest - flux);
        write(&mut out, side, rest);
        let edge = read(&self.edges, side).at();
        let along = read(half_edges, edge)[0].at() == parent;
        write(tau, edge, if along { rest } else { -rest });
        out
    }
}

/// Fills `tau` with one value an edge, along its direction, from the iterate; `alpha` holds ½ tr A of
/// every cell, triangles first, or nothing where it is the same everywhere.
///
/// # Errors
/// Arrays of the wrong length.
pub fn agree<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    alpha: &[R],
    boundary: &Boundary<R, I>,
    loads: CellLoads<R>,
    iterate: Iterate<R>,
    tau: &mut [R],
) -> Result<(), Error> {
    let (triangles, quads) = (edges.of_triangles().len(), edges.of_quads().len());
    same_length(Array::Stiffness, stiffness.triangles.len(), triangles)?;
    same_length(Array::Stiffness, stiffness.quads.len(), quads)?;
    same_length_or_empty(Array::Coefficients, alpha.len(), edges.cells())?;
    same_length(Array::Unknowns, iterate.u.len(), edges.counts().edges())?;
    same_length(Array::LowerBounds, iterate.lower.len(), edges.counts().contact)?;
    same_length(Array::Fluxes, tau.len(), edges.counts().edges())?;
    same_length_or_empty(Array::CellLoads, loads.triangles.len(), triangles)?;
    same_length_or_empty(Array::CellLoads, loads.quads.len(), quads)?;
    tau.fill(R::ZERO);
    let soft = |cell: usize| match alpha.get(cell) {
        Some(&alpha) => R::ONE / alpha,
        None => R::ONE,
    };
    let halves = edges.half_edges();
    for (at, (sides, k)) in edges.of_triangles().iter().zip(stiffness.triangles).enumerate() {
        let out =
            on_triangle(k, &sides.map(|e| read(iterate.u, e.at())), read(loads.triangles, at));
        add(halves, 3 * at, sides, out.map(|flux| flux * soft(at)), tau);
    }
    for (at, (sides, k)) in edges.of_quads().iter().zip(stiffness.quads).enumerate() {
        let out = on_quad(k, &sides.map(|e| read(iterate.u, e.at())), read(loads.quads, at));
        let soft = soft(triangles + at);
        add(halves, 3 * triangles + 4 * at, sides, out.map(|flux| flux * soft), tau);
    }
    weigh(edges, soft, tau);
    impose(edges, boundary, iterate, tau);
    Ok(())
}

/// Adds what a cell says of the flux through its sides.
#[inline(always)]
fn add<R: Real, I: Index, const N: usize>(
    half_edges: &[[I; 2]],
    first_half: usize,
    sides: &[I; N],
    out: [R; N],
    tau: &mut [R],
) {
    for (k, (edge, out)) in sides.iter().zip(out).enumerate() {
        let along = read(half_edges, edge.at())[0].at() == first_half + k;
        if let Some(sum) = tau.get_mut(edge.at()) {
            *sum += if along { out } else { -out };
        }
    }
}

/// Turns the weighted sums into means.
fn weigh<R: Real, I: Index>(edges: &Edges<I>, soft: impl Fn(usize) -> R, tau: &mut [R]) {
    let of = |half: I| edges.cell_of(half.at()).map_or(R::ZERO, &soft);
    for (pair, tau) in edges.half_edges().iter().zip(tau) {
        let beyond = if pair[1] == I::NONE { R::ZERO } else { of(pair[1]) };
        *tau /= of(pair[0]) + beyond;
    }
}

/// What the boundary conditions ask of τ.
fn impose<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    iterate: Iterate<R>,
    tau: &mut [R],
) {
    let counts = edges.counts();
    let free = tau.iter_mut().zip(edges.half_edges()).take(counts.free);
    free.filter(|(_, pair)| pair[1] == I::NONE).for_each(|(tau, _)| *tau = R::ZERO);
    for record in boundary.neumann() {
        let sum = read(tau, record.edge.at()) + record.flux;
        write(tau, record.edge.at(), sum);
    }
    for record in boundary.robin() {
        let law = record.ambient - record.coefficient * read(iterate.u, record.edge.at());
        let sum = read(tau, record.edge.at()) + law;
        write(tau, record.edge.at(), sum);
    }
    let on_contact = iterate.u.iter().zip(tau.iter_mut()).skip(counts.free);
    for (at, ((&u, tau), &lower)) in on_contact.zip(iterate.lower).enumerate() {
        let given = boundary.contact_flux(at);
        *tau = if u > lower { given } else { tau.or_larger(given) };
    }
}

/// Hands each cell's surplus on, without looking at the cells: τ alone.
pub fn walk<R: Real, I: Index>(
    edges: &Edges<I>,
    forest: &Forest<I>,
    loads: CellLoads<R>,
    tau: &mut [R],
) {
    let (halves, triangles) = (edges.half_edges(), edges.of_triangles().len());
    for (cell, parent) in forest.from_leaves() {
        match edges.of_triangles().get(cell) {
            Some(&sides) => {
                let load = read(loads.triangles, cell);
                Cell::new(3 * cell, sides).settle(halves, parent, load, tau);
            }
            None => {
                let at = cell - triangles;
                let cell = Cell::new(3 * triangles + 4 * at, read(edges.of_quads(), at));
                cell.settle(halves, parent, read(loads.quads, at), tau);
            }
        }
    }
}

/// Contact edges may have taken a surplus; they must not be pulled at. The edge where τ < q, if any.
pub fn pulled<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    tau: &[R],
) -> Option<usize> {
    let counts = edges.counts();
    let on_contact = tau.iter().skip(counts.free).take(counts.contact).enumerate();
    let below = |&(at, tau): &(usize, &R)| !(*tau >= boundary.contact_flux(at));
    on_contact.into_iter().find(below).map(|(at, _)| counts.free + at)
}

/// Whether the flux through an edge may take a surplus whatever the iterate: on D, and on R with h > 0.
pub fn is_root<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    edge: usize,
) -> bool {
    match edges.counts().block(edge) {
        Block::Dirichlet => true,
        Block::Contact => false,
        Block::Free => {
            let records = boundary.robin();
            let found = records.binary_search_by(|record| record.edge.at().cmp(&edge));
            found.is_ok_and(|at| records.get(at).is_some_and(|law| law.coefficient > R::ZERO))
        }
    }
}
