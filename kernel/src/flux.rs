//! The conservative flux σ = A∇u, recovered locally: formula (15).
//!
//! ```text
//!   F_E = ∫_E σ·n_T = Σ_j K_ij u_j − (∫_T f)/m      for side i = E of a cell T with m sides
//! ```
//! The F are the Raviart–Thomas degrees of freedom. Their sum over a cell is −∫_T f for *any* u; from
//! both sides of an edge they are equal and opposite as far as u solves the discrete problem.

use crate::assembly::CellLoads;
use crate::element::{crouzeix_raviart, rannacher_turek};
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::index::{Index, read};
use crate::mesh::edges::Edges;
use crate::stiffness::Stiffness;
use crate::storage::Storage;
use crate::{Real, features};

/// Outward fluxes through the sides of a triangle: `k` its stiffness, `u` the means over its sides,
/// `load` = ∫_T f.
#[inline(always)]
pub fn on_triangle<R: Real>(k: &[R; 3], u: &[R; 3], load: R) -> [R; 3] {
    let share = load * R::THIRD;
    crouzeix_raviart::product(k, u).map(|flow| flow - share)
}

/// Outward fluxes through the sides of a quad.
#[inline(always)]
pub fn on_quad<R: Real>(k: &[R; 6], u: &[R; 4], load: R) -> [R; 4] {
    let share = load * R::QUARTER;
    rannacher_turek::product(k, u).map(|flow| flow - share)
}

/// Fills `flux` with the outward fluxes through the sides of every triangle, from the iterate `u`
/// alone: the fast way, for images without quads too. Not inlined: symbols tell what is there. `loads` holds ∫_T f, or nothing where f = 0.
///
/// # Errors
/// Slices of the wrong length.
#[inline(never)]
pub fn of_triangles<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    loads: &[R],
    u: &[R],
    flux: &mut [[R; 3]],
) -> Result<(), Error> {
    same_length(Array::Unknowns, u.len(), edges.counts().edges())?;
    same_length(Array::Stiffness, stiffness.triangles.len(), edges.of_triangles().len())?;
    same_length(Array::Fluxes, flux.len(), edges.of_triangles().len())?;
    same_length_or_empty(Array::CellLoads, loads.len(), edges.of_triangles().len())?;
    if loads.is_empty() {
        for ((sides, k), flux) in edges.of_triangles().iter().zip(stiffness.triangles).zip(flux) {
            let Some(means) = on_sides(sides, u) else { break };
            *flux = crouzeix_raviart::product(k, &means);
        }
    } else {
        loaded_triangles(u, edges.of_triangles(), stiffness.triangles, loads, flux);
    }
    Ok(())
}

/// A function of its own keeps the pointers of this loop in registers.
#[inline(never)]
fn loaded_triangles<R: Real, I: Index>(
    u: &[R],
    of_triangles: &[[I; 3]],
    k: &[[R; 3]],
    loads: &[R],
    flux: &mut [[R; 3]],
) {
    for (((sides, k), &load), flux) in of_triangles.iter().zip(k).zip(loads).zip(flux) {
        let Some(means) = on_sides(sides, u) else { break };
        *flux = on_triangle(k, &means, load);
    }
}

#[inline(always)]
fn on_sides<R: Real, I: Index>(&[a, b, c]: &[I; 3], u: &[R]) -> Option<[R; 3]> {
    Some([*u.get(a.at())?, *u.get(b.at())?, *u.get(c.at())?])
}

/// Fills the fluxes of every quad. Not inlined, so that symbols tell whether it is there.
///
/// # Errors
/// Slices of the wrong length.
#[inline(never)]
pub fn of_quads<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    loads: &[R],
    u: &[R],
    flux: &mut [[R; 4]],
) -> Result<(), Error> {
    same_length(Array::Unknowns, u.len(), edges.counts().edges())?;
    same_length(Array::Stiffness, stiffness.quads.len(), edges.of_quads().len())?;
    same_length(Array::Fluxes, flux.len(), edges.of_quads().len())?;
    same_length_or_empty(Array::CellLoads, loads.len(), edges.of_quads().len())?;
    let cells = edges.of_quads().iter().zip(stiffness.quads).zip(flux);
    for (at, ((sides, k), flux)) in cells.enumerate() {
        *flux = on_quad(k, &pick(sides, u), read(loads, at));
    }
    Ok(())
}

/// Findings of [`recover`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Recovered<R> {
    /// max over interior edges of |F from one side + F from the other|: 0 for the exact solution,
    /// the part of the flux that more sweeps would still change.
    pub mismatch: R,
    /// max |F|
    pub largest: R,
}

/// Fills `flux` with F for every edge, along the normal out of its first cell: outward on the
/// boundary; inside, the mean of both sides. `low` is what [`crate::refinement`] found below the last
/// digit of u, or empty.
///
/// # Errors
/// Slices of the wrong length.
pub fn recover<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    loads: CellLoads<R>,
    u: &[R],
    low: &[R],
    flux: &mut [R],
) -> Result<Recovered<R>, Error> {
    recover_with(edges, stiffness, loads, [u, low], flux, (|_, _| None, |_, _| None))
}

/// Fills `flux` as [`recover`] does, for a step in time whose cells store what `storage` says.
///
/// # Errors
/// Slices of the wrong length.
pub fn recover_in_step<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    (loads, storage): (CellLoads<R>, Storage<R>),
    u: &[R],
    low: &[R],
    flux: &mut [R],
) -> Result<Recovered<R>, Error> {
    let stored = (
        |at, sides: &[I; 3]| Some(storage.in_triangle(at, sides, pick(sides, u))),
        |at, sides: &[I; 4]| Some(storage.in_quad(at, sides, pick(sides, u))),
    );
    recover_with(edges, stiffness, loads, [u, low], flux, stored)
}

/// `stored` says what a triangle and a quad store by their sides.
#[inline(always)]
fn recover_with<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    loads: CellLoads<R>,
    [u, low]: [&[R]; 2],
    flux: &mut [R],
    stored: (impl Fn(usize, &[I; 3]) -> Option<[R; 3]>, impl Fn(usize, &[I; 4]) -> Option<[R; 4]>),
) -> Result<Recovered<R>, Error> {
    same_length(Array::Unknowns, u.len(), edges.counts().edges())?;
    let (triangles, quads) = (edges.of_triangles().len(), edges.of_quads().len());
    same_length(Array::Stiffness, stiffness.triangles.len(), triangles)?;
    same_length(Array::Stiffness, stiffness.quads.len(), quads)?;
    same_length_or_empty(Array::CellLoads, loads.triangles.len(), triangles)?;
    same_length_or_empty(Array::CellLoads, loads.quads.len(), quads)?;
    same_length_or_empty(Array::Scratch, low.len(), u.len())?;
    same_length(Array::Fluxes, flux.len(), edges.counts().edges())?;
    let mut gathered =
        Gathered { half_edges: edges.half_edges(), flux, found: Recovered::default() };
    let mut half = 0;
    if features::TRIANGLES {
        for (at, (sides, k)) in edges.of_triangles().iter().zip(stiffness.triangles).enumerate() {
            let mut out = on_triangle(k, &pick(sides, u), read(loads.triangles, at));
            if !low.is_empty() {
                out = sum(out, crouzeix_raviart::product(k, &pick(sides, low)));
            }
            out = stored.0(at, sides).map_or(out, |stored| sum(out, stored));
            sides.iter().zip(out).for_each(|(edge, out)| gathered.add(edge.at(), &mut half, out));
        }
    }
    if features::QUADS {
        for (at, (sides, k)) in edges.of_quads().iter().zip(stiffness.quads).enumerate() {
            let mut out = on_quad(k, &pick(sides, u), read(loads.quads, at));
            if !low.is_empty() {
                out = sum(out, rannacher_turek::product(k, &pick(sides, low)));
            }
            out = stored.1(at, sides).map_or(out, |stored| sum(out, stored));
            sides.iter().zip(out).for_each(|(edge, out)| gathered.add(edge.at(), &mut half, out));
        }
    }
    Ok(gathered.found)
}

/// The values on the sides of a cell.
fn pick<R: Real, I: Index, const N: usize>(sides: &[I; N], u: &[R]) -> [R; N] {
    sides.map(|edge| read(u, edge.at()))
}

fn sum<R: Real, const N: usize>(mut a: [R; N], b: [R; N]) -> [R; N] {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
    a
}

struct Gathered<'a, R, I> {
    half_edges: &'a [[I; 2]],
    flux: &'a mut [R],
    found: Recovered<R>,
}

impl<R: Real, I: Index> Gathered<'_, R, I> {
    /// The lower half-edge of an edge comes first, so the second visit completes the mean.
    fn add(&mut self, edge: usize, half: &mut usize, out: R) {
        let [first, second] = read(self.half_edges, edge);
        let Some(flux) = self.flux.get_mut(edge) else { return };
        let [lower, upper] = if second < first { [second, first] } else { [first, second] };
        let along = if first.at() == *half { out } else { -out };
        if lower.at() == *half {
            *flux = along;
        } else if upper.at() == *half {
            self.found.mismatch = self.found.mismatch.or_larger((*flux - along).magnitude());
            *flux = R::HALF * (*flux + along);
        }
        self.found.largest = self.found.largest.or_larger(out.magnitude());
        *half += 1;
    }
}
