//! Assembly, sweeps and flux on memory of fixed size.

use signorini_device::model::Model;
use signorini_kernel::csr::Csr;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::system::Shifts;
use signorini_kernel::system::{Residual, System};
use signorini_kernel::{Error, Real, assembly as numeric, flux as recovery, psor};

use super::{CELLS, EDGES, ENTRIES, cut};
use crate::journal::{Bits, Journal};

/// CSR and load.
pub(super) struct Memory<R> {
    row_ptr: [u32; EDGES + 1],
    col_idx: [u16; ENTRIES],
    values: [R; ENTRIES],
    load: [R; EDGES],
}

impl<R: Real> Memory<R> {
    pub(super) const fn new() -> Self {
        Self {
            row_ptr: [0; EDGES + 1],
            col_idx: [0; ENTRIES],
            values: [R::ZERO; ENTRIES],
            load: [R::ZERO; EDGES],
        }
    }

    /// Assembles `model` here.
    pub(super) fn system<'a>(
        &'a mut self,
        model: &Model<'a, R, u16>,
        edges: &Edges<u16>,
        boundary: &Boundary<'a, R, u16>,
    ) -> Result<System<'a, R, u16>, Error> {
        let (unknowns, entries) = (model.counts.unknowns(), edges.nonzeros());
        let row_ptr = cut(&mut self.row_ptr, unknowns + 1)?;
        let col_idx = cut(&mut self.col_idx, entries)?;
        let values = cut(&mut self.values, entries)?;
        let load = cut(&mut self.load, unknowns)?;
        numeric::pattern(edges, row_ptr, col_idx)?;
        let diagonal = DiagonalTerms::new(boundary);
        numeric::values(edges, model.stiffness, diagonal, row_ptr, values)?;
        numeric::load(edges, model.loads, boundary, load)?;
        let matrix = Csr::new(row_ptr, col_idx, values, model.counts.edges())?;
        let shifts = Shifts { part: &[], parts: 1, diagonal };
        System::new(matrix, load, Law::above(model.gap), model.counts)?.with_shifts(shifts)
    }
}

/// Calls the function with rows of the width that the cells need.
macro_rules! by_width {
    ($model:expr, $function:ident, $($argument:expr),*) => {
        if $model.quads.is_empty() {
            $function::<R, TRIANGLES>($($argument),*)
        } else {
            $function::<R, QUADS>($($argument),*)
        }
    };
}

#[inline(never)]
pub(super) fn assembly<R: Bits>(model: &Model<R, u16>, journal: &mut Journal) -> Result<(), Error> {
    let (edges, boundary) = (model.edges()?, model.boundary()?);
    let mut memory = Memory::new();
    let system = memory.system(model, &edges, &boundary)?;
    journal.count("entries", system.matrix().values().len() as u32);
    journal.digest("values", system.matrix().values().iter().copied());
    journal.digest("load", system.load().iter().copied());
    by_width!(model, rows, model, &system, journal)
}

/// One sweep over rows from CSR and one over rows from the element matrices.
fn rows<R: Bits, const WIDTH: usize>(
    model: &Model<R, u16>,
    system: &System<R, u16>,
    journal: &mut Journal,
) -> Result<(), Error> {
    let (edges, omega) = (model.edges()?, R::ONE + R::HALF);
    let mut memory = [Row::EMPTY; EDGES];
    let mut rows = Rows::<R, u16, WIDTH>::new(&edges, cut(&mut memory, system.load().len())?)?;
    rows.set(system, omega)?;
    swept(model, &rows, 1, |u| journal.digest("swept by CSR", u.iter().copied()))?;
    let diagonal = DiagonalTerms::new(&model.boundary()?);
    rows.gather(&edges, model.stiffness, diagonal, system.load(), omega)?;
    swept(model, &rows, 1, |u| journal.digest("swept by cells", u.iter().copied()))
}

/// Hands on the iterate after so many sweeps from the start.
fn swept<R: Bits, const WIDTH: usize>(
    model: &Model<R, u16>,
    rows: &Rows<R, u16, WIDTH>,
    times: u32,
    work: impl FnOnce(&[R]),
) -> Result<(), Error> {
    let mut u = [R::ZERO; EDGES];
    let u = cut(&mut u, model.start.len())?;
    u.copy_from_slice(model.start);
    for _ in 0..times {
        psor::sweep(rows, Law::above(model.gap), u)?;
    }
    work(u);
    Ok(())
}

#[inline(never)]
pub(super) fn sweeps<R: Bits>(model: &Model<R, u16>, journal: &mut Journal) -> Result<(), Error> {
    let (edges, boundary) = (model.edges()?, model.boundary()?);
    let mut memory = Memory::new();
    let system = memory.system(model, &edges, &boundary)?;
    by_width!(model, sweep, model, &system, |u| {
        journal.digest("u", u.iter().copied());
        residual(&system.residual(u), journal);
    })
}

/// Sweeps of the stages that work on an unfinished iterate.
const SWEEPS: u32 = 30;

fn sweep<R: Bits, const WIDTH: usize>(
    model: &Model<R, u16>,
    system: &System<R, u16>,
    work: impl FnOnce(&[R]),
) -> Result<(), Error> {
    let mut memory = [Row::EMPTY; EDGES];
    let memory = cut(&mut memory, system.load().len())?;
    let mut rows = Rows::<R, u16, WIDTH>::new(&model.edges()?, memory)?;
    rows.set(system, R::ONE + R::HALF + R::QUARTER)?;
    swept(model, &rows, SWEEPS, work)
}

/// Every figure of a residual.
pub(super) fn residual<R: Bits>(residual: &Residual<R>, journal: &mut Journal) {
    journal.scalar("residual, largest", residual.largest);
    journal.scalar("residual, sum", residual.sum);
    journal.scalar("residual, scaled", residual.scaled());
    journal.scalar("range of u", residual.range);
    journal.scalar("load", residual.load);
    journal.scalar("rounding", residual.rounding);
    journal.count("active", residual.active);
}

#[inline(never)]
pub(super) fn flux<R: Bits>(model: &Model<R, u16>, journal: &mut Journal) -> Result<(), Error> {
    let (edges, boundary) = (model.edges()?, model.boundary()?);
    let mut memory = Memory::new();
    let system = memory.system(model, &edges, &boundary)?;
    let mut iterate = [R::ZERO; EDGES];
    let u = cut(&mut iterate, model.start.len())?;
    by_width!(model, sweep, model, &system, |swept| u.copy_from_slice(swept))?;

    let (mut triangles, mut quads) = ([[R::ZERO; 3]; CELLS], [[R::ZERO; 4]; CELLS]);
    let triangles = cut(&mut triangles, model.triangles.len())?;
    let quads = cut(&mut quads, model.quads.len())?;
    recovery::of_triangles(&edges, model.stiffness, model.loads.triangles, u, triangles)?;
    recovery::of_quads(&edges, model.stiffness, model.loads.quads, u, quads)?;
    let cells = triangles.as_flattened().iter().chain(quads.as_flattened());
    journal.digest("flux by cells", cells.copied());

    let mut fluxes = [R::ZERO; EDGES];
    let fluxes = cut(&mut fluxes, u.len())?;
    let found = recovery::recover(&edges, model.stiffness, model.loads, u, &[], fluxes)?;
    journal.digest("flux by edges", fluxes.iter().copied());
    journal.scalar("mismatch", found.mismatch);
    journal.scalar("largest flux", found.largest);
    Ok(())
}
