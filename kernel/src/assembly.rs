//! From element matrices to CSR and load: a symbolic pass, and a numeric pass that can be repeated.
//!
//! Row i is gathered, not scattered: the edge knows its one or two cells, each cell lends its other
//! sides in counterclockwise order, and both passes walk them alike. No entry is ever searched for.

use crate::element::copy_row;
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::index::{Index, read};
use crate::mesh::boundary::Boundary;
use crate::mesh::diagonal::DiagonalTerms;
use crate::mesh::edges::{Edges, Side};
use crate::stiffness::Stiffness;
use crate::{Real, features};

/// The integrals ∫_T f of all cells (borrowed); empty slices stand for f = 0.
#[derive(Debug, Clone, Copy, Default)]
pub struct CellLoads<'a, R> {
    /// One integral a triangle.
    pub triangles: &'a [R],
    /// One integral a quad.
    pub quads: &'a [R],
}

/// Symbolic pass: fills `row_ptr` (unknowns + 1 entries) and `col_idx` ([`Edges::nonzeros`]).
///
/// # Errors
/// Slices of the wrong length; more entries than `u32` can count.
pub fn pattern<I: Index>(
    edges: &Edges<I>,
    row_ptr: &mut [u32],
    col_idx: &mut [I],
) -> Result<(), Error> {
    let nonzeros = edges.nonzeros();
    same_length(Array::RowPointers, row_ptr.len(), edges.counts().unknowns() + 1)?;
    same_length(Array::ColumnIndices, col_idx.len(), nonzeros)?;
    if u32::try_from(nonzeros).is_err() {
        let limit = u32::MAX as usize;
        return Err(Error::Capacity { of: Array::MatrixValues, needed: nonzeros, limit });
    }
    let mut columns = col_idx.iter_mut();
    let mut put = |column| columns.next().map(|place| *place = column).map_or(0, |()| 1);
    let mut length = 0;
    for (i, start) in row_ptr.iter_mut().enumerate() {
        *start = length;
        if i == edges.counts().unknowns() {
            break;
        }
        length += put(I::new(i).unwrap_or(I::NONE));
        edges.neighbours(i).for_each(|column| length += put(column));
    }
    Ok(())
}

/// Numeric pass: fills `values` for the pattern of [`pattern`] from the element matrices and the terms that K has on its
/// diagonal beyond them.
///
/// # Errors
/// Slices of the wrong length.
pub fn values<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    diagonal: DiagonalTerms<R, I>,
    row_ptr: &[u32],
    values: &mut [R],
) -> Result<(), Error> {
    let unknowns = edges.counts().unknowns();
    same_length(Array::RowPointers, row_ptr.len(), unknowns + 1)?;
    same_length(Array::MatrixValues, values.len(), edges.nonzeros())?;
    same_length(Array::Stiffness, stiffness.triangles.len(), edges.of_triangles().len())?;
    same_length(Array::Stiffness, stiffness.quads.len(), edges.of_quads().len())?;
    let mut places = values.iter_mut();
    for pair in edges.half_edges().iter().take(unknowns) {
        let Some(own) = places.next() else { break };
        *own = R::ZERO;
        for half in pair.iter().filter(|&&half| half != I::NONE) {
            match edges.side(half.at()) {
                Side::Triangle(at, side) => {
                    *own += copy_row(&read(stiffness.triangles, at), 3, side, &mut places);
                }
                Side::Quad(at, side) => {
                    *own += copy_row(&read(stiffness.quads, at), 4, side, &mut places);
                }
            }
        }
    }
    for (edge, term) in diagonal.entries() {
        let place = values.get_mut(read(row_ptr, edge) as usize);
        if let Some(own) = place {
            *own += term;
        }
    }
    Ok(())
}

/// Fills the load b: (∫_T f)/m from each cell with m sides, and what the boundary adds.
///
/// # Errors
/// Slices of the wrong length.
pub fn load<R: Real, I: Index>(
    edges: &Edges<I>,
    cells: CellLoads<R>,
    boundary: &Boundary<R, I>,
    load: &mut [R],
) -> Result<(), Error> {
    load_of_triangles(edges, cells.triangles, boundary, load)?;
    same_length_or_empty(Array::CellLoads, cells.quads.len(), edges.of_quads().len())?;
    if features::QUADS {
        add_quads(edges.of_quads(), cells.quads, load);
    }
    Ok(())
}

/// Fills the load of a mesh of triangles, without any code for quads.
///
/// # Errors
/// Slices of the wrong length.
pub fn load_of_triangles<R: Real, I: Index>(
    edges: &Edges<I>,
    loads: &[R],
    boundary: &Boundary<R, I>,
    load: &mut [R],
) -> Result<(), Error> {
    let triangles = edges.of_triangles();
    same_length(Array::Load, load.len(), edges.counts().unknowns())?;
    same_length_or_empty(Array::CellLoads, loads.len(), triangles.len())?;
    load.fill(R::ZERO);
    if features::TRIANGLES {
        for (sides, &integral) in triangles.iter().zip(loads) {
            spread(sides, integral * R::THIRD, load);
        }
    }
    boundary.add_to_load(edges, load);
    Ok(())
}

/// Share of the load that the cell of a boundary edge adds there.
pub fn share_of_cell<R: Real, I: Index>(edges: &Edges<I>, cells: CellLoads<R>, edge: usize) -> R {
    let half = read(edges.half_edges(), edge)[0];
    R::ZERO
        + match edges.side(half.at()) {
            Side::Triangle(at, _) => read(cells.triangles, at) * R::THIRD,
            Side::Quad(at, _) => read(cells.quads, at) * R::QUARTER,
        }
}

// Not inlined, so that an image's symbols tell whether it holds code for quads.
#[inline(never)]
fn add_quads<R: Real, I: Index>(quads: &[[I; 4]], loads: &[R], load: &mut [R]) {
    for (sides, &integral) in quads.iter().zip(loads) {
        spread(sides, integral * R::QUARTER, load);
    }
}

fn spread<R: Real, I: Index>(sides: &[I], share: R, load: &mut [R]) {
    for edge in sides {
        if let Some(entry) = load.get_mut(edge.at()) {
            *entry += share;
        }
    }
}
