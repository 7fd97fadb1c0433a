//! Largest effect of rounding on a bound, for a mesh and its A: how much energy it takes to bring a surplus from a cell to
//! its root, and how much of itself a rounded element matrix can hide.
//!
//! What leaves through a transfer edge counts there too: 1 through an edge with ∫h = H adds ∫(1/|E|)²/h, 1/H where h is
//! constant.

use super::{Metric, Stability, quad, triangle};
use crate::cells::{Cells, Either};
use crate::forest::Forest;
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::edges::Edges;

/// The [`Stability`] of a mesh with this forest; `way` is scratch with one entry a cell.
///
/// # Errors
/// A scratch of the wrong length.
pub fn stability<R: Real, I: Index>(
    edges: &Edges<I>,
    cells: &Cells<R, I>,
    metric: Metric<R>,
    boundary: &Boundary<R, I>,
    forest: &Forest<I>,
    way: &mut [R],
) -> Result<Stability<R>, Error> {
    same_length(Array::Scratch, way.len(), edges.cells())?;
    passing(edges, cells, metric, forest, way);
    for law in boundary.robin() {
        let half = read(edges.half_edges(), law.edge.at())[0];
        let root = edges.cell_of(half.at()).filter(|&cell| forest.parent(cell) == half.at());
        root.into_iter().for_each(|cell| write(way, cell, R::ONE / law.coefficient));
    }
    // From the roots these costs add up.
    for (number, parent) in forest.from_roots() {
        if let Some((_, next)) = edges.beyond(parent) {
            let sum = read(way, number) + read(way, next);
            write(way, number, sum);
        }
    }
    let [mut largest, mut weighed, mut oblique] = [R::ZERO; 3];
    for cell in cells.from_leaves() {
        let (number, last, softness, kappa) = match cell {
            Either::Triangle(cell) => {
                let points = metric.varying(cell.number.at());
                (cell.number, 2, triangle::softness(cell, points), triangle::obliqueness(&cell.k))
            }
            Either::Quad(cell) => {
                let points = metric.varying(cell.number.at());
                (cell.number, 3, quad::softness(cell, points), quad::obliqueness(cell, points))
            }
        };
        oblique = oblique.or_larger(if kappa >= R::ONE { kappa } else { R::ONE / R::ZERO });
        let out = |k: usize| if k == last { R::ONE } else { R::ZERO };
        let whole = read(way, number.at()) + energy(metric, cell, out);
        // Numbers out of range tell nothing.
        let known = whole > R::ZERO && softness > R::ZERO;
        largest = largest.or_larger(if known { whole } else { R::ONE / R::ZERO });
        let quotient = whole / softness;
        weighed = weighed.or_larger(if quotient.finite() { quotient } else { R::ONE / R::ZERO });
    }
    let oblique = R::from_count(64) * R::EPSILON * oblique;
    Ok(Stability { largest: largest.rounded_sqrt(), weighed: weighed.rounded_sqrt(), oblique })
}

/// Fills in for every cell what it costs to pass the next one on its way: 1 comes in through the side
/// between them and leaves through the last.
fn passing<R: Real, I: Index>(
    edges: &Edges<I>,
    cells: &Cells<R, I>,
    metric: Metric<R>,
    forest: &Forest<I>,
    way: &mut [R],
) {
    way.fill(R::ZERO);
    for cell in cells.from_leaves() {
        let (number, of_cell) = match cell {
            Either::Triangle(cell) => (cell.number.at(), cell.edges.as_slice()),
            Either::Quad(cell) => (cell.number.at(), cell.edges.as_slice()),
        };
        let last = of_cell.len() - 1;
        for half in edges.sides_of(number) {
            let Some((entry, behind)) = edges.beyond(half) else { continue };
            let edge = edges.edge_of(half);
            let packed = of_cell.iter().position(|other| other.at() == edge);
            if forest.parent(behind) != entry.at() || packed == Some(last) {
                continue;
            }
            let through = |k: usize| match k {
                _ if Some(k) == packed => -R::ONE,
                _ if k == last => R::ONE,
                _ => R::ZERO,
            };
            write(way, behind, energy(metric, cell, through));
        }
    }
}

/// ‖A^{−½}·‖² of the field with these outward fluxes through the packed sides of a cell.
fn energy<R: Real, I: Index>(metric: Metric<R>, cell: Either<R, I>, out: impl Fn(usize) -> R) -> R {
    match cell {
        Either::Triangle(cell) => {
            let points = metric.varying(cell.number.at());
            triangle::energy(cell, points, [0, 1, 2].map(out))
        }
        Either::Quad(cell) => {
            let points = metric.varying(cell.number.at());
            quad::energy(cell, points, [0, 1, 2, 3].map(out))
        }
    }
}
