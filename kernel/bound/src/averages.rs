//! Means over the cells around a vertex of their u, and over the cells of an edge of their flux.
//!
//! ```text
//!   s(v) = Σ α u_h|_T(v) / Σ α      τ_E = Σ ±F/α / Σ 1/α        over the cells around; F by formula (15)
//! ```
//! Both are raw: boundary conditions are imposed later ([`crate::conforming`], [`crate::equilibrium`]).
//! One pass over the packed cells reads u once for both.

use crate::cells::{Cells, Quad, Triangle, pick};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::element::{crouzeix_raviart, nonparametric, rannacher_turek};
use signorini_kernel::error::{Array, Error, same_length, same_length_or_empty};
use signorini_kernel::flux::{on_quad, on_triangle};
use signorini_kernel::index::{Index, read};
use signorini_kernel::storage::Storage;
use signorini_kernel::{Real, features};

/// Fills `vertices` with s and `tau` with one value an edge, along its direction, from the means `u` over
/// the edges; in a step with what cells store. `distortions` is that of [`crate::certificate::Metric`].
///
/// # Errors
/// Arrays of the wrong length.
#[inline(always)]
pub fn fill<R: Real, I: Index>(
    cells: &Cells<R, I>,
    (loads, stored): (CellLoads<R>, Option<Storage<R>>),
    distortions: &[[R; 2]],
    u: &[R],
    vertices: &mut [R],
    tau: &mut [R],
) -> Result<(), Error> {
    same_length(Array::Vertices, vertices.len(), cells.of_vertices.len())?;
    same_length(Array::Fluxes, tau.len(), cells.of_edges.len())?;
    same_length(Array::Unknowns, u.len(), tau.len())?;
    same_length_or_empty(Array::CellLoads, loads.triangles.len(), cells.triangles.len())?;
    same_length_or_empty(Array::CellLoads, loads.quads.len(), cells.quads.len())?;
    same_length_or_empty(Array::Coefficients, distortions.len(), cells.quads.len())?;
    vertices.fill(R::ZERO);
    tau.fill(R::ZERO);
    if features::TRIANGLES {
        match stored {
            None => of_triangles(cells, loads.triangles, u, vertices, tau, |_, _, flux| flux),
            Some(of) => of_triangles(cells, loads.triangles, u, vertices, tau, |cell, u, flux| {
                plus(flux, of.in_triangle(cell.number.at(), &cell.edges, u))
            }),
        }
    }
    if features::QUADS {
        let quad = |cell: &Quad<R, I>| cell.number.at().wrapping_sub(cells.triangles.len());
        of_quads(cells, loads.quads, distortions, u, vertices, tau, |cell, u, flux| match stored {
            None => flux,
            Some(of) => plus(flux, of.in_quad(quad(cell), &cell.edges, u)),
        });
    }
    let scaled = vertices.iter_mut().zip(cells.of_vertices);
    scaled.for_each(|(sum, &weight)| *sum *= weight);
    tau.iter_mut().zip(cells.of_edges).for_each(|(sum, &weight)| *sum *= weight);
    Ok(())
}

#[inline(never)]
fn of_triangles<R: Real, I: Index>(
    cells: &Cells<R, I>,
    loads: &[R],
    u: &[R],
    vertices: &mut [R],
    tau: &mut [R],
    with_stored: impl Fn(&Triangle<R, I>, [R; 3], [R; 3]) -> [R; 3],
) {
    for cell in cells.triangles {
        let Some(means) = pick(&cell.edges, u) else { break };
        let flux = on_triangle(&cell.k, &means, read(loads, cell.number.at()));
        let out = with_stored(cell, means, flux);
        let flux = cell.turned(out.map(|flux| flux * cell.softness));
        add(&cell.edges, flux, tau);
        let at_vertices = crouzeix_raviart::at_vertices(&means);
        add(&cell.vertices, at_vertices.map(|value| value * cell.alpha), vertices);
    }
}

#[inline(never)]
fn of_quads<R: Real, I: Index>(
    cells: &Cells<R, I>,
    loads: &[R],
    distortions: &[[R; 2]],
    u: &[R],
    vertices: &mut [R],
    tau: &mut [R],
    with_stored: impl Fn(&Quad<R, I>, [R; 4], [R; 4]) -> [R; 4],
) {
    let triangles = cells.triangles.len();
    for cell in cells.quads {
        let Some(means) = pick(&cell.edges, u) else { break };
        let quad = cell.number.at().wrapping_sub(triangles);
        let load = read(loads, quad);
        let out = with_stored(cell, means, on_quad(&cell.k, &means, load));
        let flux = cell.turned(out.map(|flux| flux * cell.softness));
        add(&cell.edges, flux, tau);
        let at_vertices = match distortions.get(quad) {
            Some(&distortion) if features::DISTORTED => {
                let means = cell.sides_in_mesh(means);
                cell.packed(nonparametric::at_vertices(distortion, &means))
            }
            _ => rannacher_turek::at_vertices(&means),
        };
        add(&cell.vertices, at_vertices.map(|value| value * cell.alpha), vertices);
    }
}

fn plus<R: Real, const N: usize>(mut a: [R; N], b: [R; N]) -> [R; N] {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
    a
}

#[inline(always)]
fn add<R: Real, I: Index, const N: usize>(places: &[I; N], terms: [R; N], sums: &mut [R]) {
    for (place, term) in places.iter().zip(terms) {
        if let Some(sum) = sums.get_mut(place.at()) {
            *sum += term;
        }
    }
}
