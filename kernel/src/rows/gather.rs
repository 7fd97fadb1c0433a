//! Rows straight from element matrices, with the bits that CSR would give them.

use core::iter::repeat;
use core::ops::Range;

use super::{Row, Rows, TRIANGLES};
use crate::element::{adjacent, copy_row};
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::index::{Index, read};
use crate::mesh::diagonal::DiagonalTerms;
use crate::mesh::edges::{Edges, Side};
use crate::stiffness::Stiffness;
use crate::{Real, features};

impl<R: Real, I: Index, const WIDTH: usize> Rows<'_, R, I, WIDTH> {
    /// Numeric pass without CSR: each row from the element matrices of its one or two cells, by the
    /// same `edges` that the rows were made for, and what `diagonal` has beyond the matrices. `load`
    /// holds b, one entry an unknown.
    ///
    /// # Errors
    /// Arrays of the wrong length, quads where a row has the [`TRIANGLES`] entries of triangles.
    #[inline(never)]
    pub fn gather(
        &mut self,
        edges: &Edges<I>,
        stiffness: Stiffness<R>,
        diagonal: DiagonalTerms<R, I>,
        load: &[R],
        omega: R,
    ) -> Result<(), Error> {
        same_length(Array::Rows, self.rows.len(), edges.counts().unknowns())?;
        same_length(Array::Load, load.len(), self.rows.len())?;
        same_length(Array::Stiffness, stiffness.triangles.len(), edges.of_triangles().len())?;
        same_length(Array::Stiffness, stiffness.quads.len(), edges.of_quads().len())?;
        // Where there is room for triangles only, an image shall hold no code for quads.
        if WIDTH == TRIANGLES && !edges.of_quads().is_empty() {
            let needed = edges.of_quads().len();
            return Err(Error::Capacity { of: Array::Quads, needed, limit: 0 });
        }
        let step = diagonal.of_step();
        same_length_or_empty(Array::Storage, step.len(), self.rows.len())?;
        self.omega = omega;
        if !step.is_empty() {
            fill(
                self.rows,
                edges.half_edges(),
                (edges, stiffness),
                load,
                step.iter().copied(),
                omega,
            );
        } else {
            self.gather_steady((edges, stiffness), diagonal, load);
        }
        if features::LIMITED {
            self.soften(edges, stiffness, diagonal.of_step(), omega);
        }
        Ok(())
    }

    /// All rows without terms beyond the element matrices, then those few that have one.
    #[inline(always)]
    fn gather_steady(
        &mut self,
        (edges, stiffness): (&Edges<I>, Stiffness<R>),
        diagonal: DiagonalTerms<R, I>,
        load: &[R],
    ) {
        let half_edges = edges.half_edges();
        let mut fill = |only: Range<usize>, term| {
            let row = self.rows.get_mut(only.clone());
            let half_edges = half_edges.get(only.clone());
            if let (Some(rows), Some(half_edges), Some(load)) = (row, half_edges, load.get(only)) {
                fill(rows, half_edges, (edges, stiffness), load, repeat(term), self.omega);
            }
        };
        fill(0..load.len(), R::ZERO);
        diagonal.of_laws().for_each(|(edge, term)| fill(edge..edge + 1, term));
    }

    /// ω / K_ii of the contact edges; `stored` is what K_ii has beyond the element matrices there, in a step of time.
    fn soften(&mut self, edges: &Edges<I>, stiffness: Stiffness<R>, stored: &[R], omega: R) {
        for (edge, row) in self.rows.iter_mut().enumerate().skip(self.counts.free) {
            let own = stiffness.of_boundary_edge(edges, edge);
            let own = if features::STORAGE { own + read(stored, edge) } else { own };
            row.soften(omega / own);
        }
    }
}

/// Rows of `half_edges`, one a row; `terms` are what each K_ii has beyond the element matrices.
#[inline(always)]
fn fill<R: Real, I: Index, const WIDTH: usize>(
    rows: &mut [Row<R, I, WIDTH>],
    half_edges: &[[I; 2]],
    (edges, stiffness): (&Edges<I>, Stiffness<R>),
    load: &[R],
    terms: impl Iterator<Item = R>,
    omega: R,
) {
    if WIDTH == TRIANGLES {
        gather_triangles(rows, half_edges, stiffness.triangles, load, terms, omega);
    } else {
        gather_cells(rows, half_edges, (edges, stiffness), load, terms, omega);
    }
}

/// Rows of edges of triangles: two entries from each half-edge. The second half-edge of a boundary
/// edge points to no entry. `terms` are what each K_ii has beyond the element matrices.
#[inline(never)]
pub(super) fn gather_triangles<R: Real, I: Index, const WIDTH: usize>(
    rows: &mut [Row<R, I, WIDTH>],
    half_edges: &[[I; 2]],
    k: &[[R; 3]],
    load: &[R],
    terms: impl Iterator<Item = R>,
    omega: R,
) {
    let (k, opposite) = (k.as_flattened(), -omega);
    let known = half_edges.iter().zip(load).zip(terms);
    for (row, ((&[first, second], &load), term)) in rows.iter_mut().zip(known) {
        let Some([a, b]) = adjacent(k, first.at()) else { break };
        let (mut c, mut d, mut sum) = (R::ZERO, R::ZERO, a + b);
        if let Some(others) = adjacent(k, second.at()) {
            [c, d] = others;
            sum += c + d;
        }
        row.put([a, b, c, d], load, opposite / (sum - term));
    }
}

/// Rows of edges of any cells. Not inlined, so that symbols tell whether it is there.
#[inline(never)]
pub(super) fn gather_cells<R: Real, I: Index, const WIDTH: usize>(
    rows: &mut [Row<R, I, WIDTH>],
    half_edges: &[[I; 2]],
    (edges, stiffness): (&Edges<I>, Stiffness<R>),
    load: &[R],
    terms: impl Iterator<Item = R>,
    omega: R,
) {
    let known = half_edges.iter().zip(load).zip(terms);
    for (row, ((pair, &load), term)) in rows.iter_mut().zip(known) {
        let (mut entries, mut own) = ([R::ZERO; WIDTH], R::ZERO);
        let mut places = entries.iter_mut();
        for half in pair.iter().filter(|&&half| half != I::NONE) {
            own += match edges.side(half.at()) {
                Side::Triangle(at, side) => {
                    copy_row(&read(stiffness.triangles, at), 3, side, &mut places)
                }
                Side::Quad(at, side) => copy_row(&read(stiffness.quads, at), 4, side, &mut places),
            };
        }
        row.put(entries, load, omega / (own + term));
    }
}
