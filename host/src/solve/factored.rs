//! The kernel's exact solver in memory of the right size: where projected SOR does not get there.

use serde::Serialize;
use signorini_kernel::Error as KernelError;
use signorini_kernel::boundary::Boundary;
use signorini_kernel::condensed::Iterate;
use signorini_kernel::condensed::blocks::{Block, SIDE, count, padded};
use signorini_kernel::edges::EdgeCounts;
use signorini_kernel::signorini::System;
use signorini_kernel::solver::{Outcome, Settings};
use signorini_kernel::sparse::elimination::PatternBuffers;
use signorini_kernel::sparse::factor::FactorBuffers;
use signorini_kernel::sparse::{Direct, DirectMemory, Factor, Memory, Pattern, Progress};

use crate::reference::minimum_degree;
use crate::scalar::Scalar;

/// What the factor did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Factored {
    /// Entries of L.
    pub entries: usize,
    /// Contact edges that changed sides.
    pub exchanges: u32,
    /// Substitutions, corrections among them.
    pub rounds: u32,
}

/// Factors of more entries are left to sweeps: two gigabytes.
const MOST_ENTRIES: usize = 150_000_000;

/// Contact edges beyond these too: S is dense.
const MOST_CONTACT: usize = 10_000;

/// Solves `system` by the kernel's factor; `u` is start and answer, `low` becomes its low part. Nothing where
/// the matrix is singular in this scalar, has no solution, or would take too much memory: `u` is what it was.
///
/// # Errors
/// Slices of the wrong length.
pub(super) fn solve<R: Scalar>(
    system: &System<R, u32>,
    boundary: &Boundary<R, u32>,
    settings: &Settings<R>,
    u: &mut [R],
    low: &mut [R],
) -> Result<Option<(Outcome<R>, Factored)>, KernelError> {
    let (counts, matrix) = (system.counts(), system.matrix());
    let Some(order) = order(system) else { return Ok(None) };
    let mut symbolic = Symbolic::new(counts);
    let pattern = Pattern::new(matrix, counts, &order, symbolic.buffers())?;
    let entries = pattern.entries();
    if entries > MOST_ENTRIES || counts.contact > MOST_CONTACT {
        return Ok(None);
    }
    let (mut columns, mut contact) = (Columns::new(counts, entries), Contact::new(counts));
    let factor = Factor::new(matrix, pattern, columns.buffers(), &mut contact.schur)?;
    let Some(factor) = factor else { return Ok(None) };
    let Some(mut direct) = Direct::new(factor, contact.memory())? else { return Ok(None) };
    let before = u.to_vec();
    let Some(progress) = direct.solve(system, boundary, settings, u, low)? else {
        u.copy_from_slice(&before);
        low.fill(R::ZERO);
        return Ok(None);
    };
    let Progress { status, residual, pivots: exchanges, rounds } = progress;
    let outcome = Outcome { status, sweeps: 0, conjugate: 0, residual, omega: R::ONE };
    Ok(Some((outcome, Factored { entries, exchanges, rounds })))
}

/// The free unknowns in the order of their elimination, or nothing where memory is short.
fn order<R: Scalar>(system: &System<R, u32>) -> Option<Vec<u32>> {
    let free = system.counts().free;
    let (mut col_ptr, mut row_idx) = (vec![0], Vec::new());
    for row in system.matrix().iter().take(free) {
        let columns = row.entries().map(|(column, _)| column).filter(|&column| column < free);
        row_idx.extend(columns.map(|column| column as u32));
        col_ptr.push(u32::try_from(row_idx.len()).ok()?);
    }
    let mut order = vec![0; free];
    minimum_degree(&col_ptr, &row_idx, [&mut order, &mut vec![0; free]]).ok()?;
    Some(order)
}

struct Symbolic {
    by_unknown: [Vec<u32>; 3],
    pointers: Vec<u32>,
}

impl Symbolic {
    fn new(counts: EdgeCounts) -> Self {
        let by_unknown = [(); 3].map(|()| vec![0; counts.free]);
        Self { by_unknown, pointers: vec![0; counts.free + 1] }
    }

    fn buffers(&mut self) -> PatternBuffers<'_, u32> {
        let [place, parent, visited] = &mut self.by_unknown;
        PatternBuffers { place, parent, visited, pointers: &mut self.pointers }
    }
}

struct Columns<R> {
    rows: Vec<u32>,
    values: Vec<R>,
    inverse: Vec<R>,
    ends: Vec<u32>,
    by_place: [Vec<u32>; 2],
    row: Vec<R>,
}

impl<R: Scalar> Columns<R> {
    fn new(counts: EdgeCounts, entries: usize) -> Self {
        Self {
            rows: vec![0; entries],
            values: vec![R::ZERO; entries],
            inverse: vec![R::ZERO; counts.free],
            ends: vec![0; counts.free],
            by_place: [(); 2].map(|()| vec![0; counts.free]),
            row: vec![R::ZERO; counts.unknowns()],
        }
    }

    fn buffers(&mut self) -> FactorBuffers<'_, R, u32> {
        let Self { rows, values, inverse, ends, by_place: [path, visited], row } = self;
        FactorBuffers { rows, values, inverse, ends, path, visited, row }
    }
}

struct Contact<R> {
    schur: Vec<Block<R>>,
    tableau: Vec<Block<R>>,
    flags: [Vec<bool>; 3],
    numbers: [Vec<R>; 7],
    places: Vec<R>,
}

impl<R: Scalar> Contact<R> {
    fn new(counts: EdgeCounts) -> Self {
        let blocks = vec![[[R::ZERO; SIDE]; SIDE]; count(counts.contact)];
        let length = padded(counts.contact);
        Self {
            schur: blocks.clone(),
            tableau: blocks,
            flags: [(); 3].map(|()| vec![false; length]),
            numbers: [(); 7].map(|()| vec![R::ZERO; length]),
            places: vec![R::ZERO; counts.unknowns()],
        }
    }

    fn memory(&mut self) -> DirectMemory<'_, R> {
        let Self { schur, tableau, flags: [exchanged, none, open], numbers, places } = self;
        let [column, next, scale, load, x, residual, scratch] = numbers;
        let iterate = Iterate { x, residual, scratch, open };
        let contact = Memory { tableau, exchanged, columns: [column, next], load, iterate };
        DirectMemory { schur, scale, none, contact, places }
    }
}
