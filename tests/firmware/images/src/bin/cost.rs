//! What each stage costs: instructions in the emulator, cycles on a board with the feature `dwt`.
//!
//! ```text
//!   f32 triangles | sweep | unknown | 8975 392 68      in all, units that share it, bytes of stack
//! ```
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_bound::cells::{CellBuffers, Cells, Quad, Triangle, pack};
use signorini_bound::certificate::{
    Buffers, Discretization, LoadCase, Metric, POINTS, certify, stability,
};
use signorini_bound::conforming::VertexData;
use signorini_bound::equilibrium::{Iterate, is_root};
use signorini_bound::forest::{Forest, ForestBuffers, grow};
use signorini_firmware::grid::{EDGES, Grid, SQUARES, VERTICES};
use signorini_firmware::journal::Bits;
use signorini_firmware::meter::{Meter, run};
use signorini_firmware::stages::cut;
use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::csr::Csr;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::solver::{Settings, Solver};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::system::System;
use signorini_kernel::{Error, Tensor, flux, psor};

#[entry]
fn main() -> ! {
    run(|meter| {
        stages::<f32, TRIANGLES, 5, { 2 * SQUARES }, 0, 408>(meter.kind("f32 triangles"))?;
        stages::<f32, QUADS, 7, 0, SQUARES, 280>(meter.kind("f32 quads"))?;
        stages::<f64, TRIANGLES, 5, { 2 * SQUARES }, 0, 408>(meter.kind("f64 triangles"))?;
        stages::<f64, QUADS, 7, 0, SQUARES, 280>(meter.kind("f64 quads"))?;
        certificate::<f32, { 2 * SQUARES }, 0, 408>(meter.kind("f32 triangles"))?;
        certificate::<f32, 0, SQUARES, 280>(meter.kind("f32 quads"))?;
        certificate::<f64, { 2 * SQUARES }, 0, 408>(meter.kind("f64 triangles"))?;
        certificate::<f64, 0, SQUARES, 280>(meter.kind("f64 quads"))
    })
}

/// Rows of `WIDTH` entries, CSR rows of `ENTRIES`, T triangles, Q quads and E edges.
#[inline(never)]
fn stages<
    R: Bits,
    const WIDTH: usize,
    const ENTRIES: usize,
    const T: usize,
    const Q: usize,
    const E: usize,
>(
    meter: &mut Meter,
) -> Result<(), Error> {
    let mut grid = Grid::<R, T, Q>::new();
    let (mesh, edges) = grid.number()?;
    let (cells, unknowns) = (T + Q, edges.counts().unknowns());
    let tensor = Tensor { xx: R::TWO, xy: R::QUARTER, yy: R::ONE };
    let (mut triangles, mut quads) = ([[R::ZERO; 3]; T], [[R::ZERO; 6]; Q]);
    meter.count("element matrices", "cell", cells, || {
        let coefficient = Coefficient::Uniform(black_box(tensor));
        stiffness::fill(&mesh, coefficient, 2, &mut triangles, &mut quads)
    })?;
    let stiffness = Stiffness { triangles: &triangles, quads: &quads };
    let boundary = Boundary::new(&edges, &[], &[], &[])?;
    let diagonal = DiagonalTerms::new(&boundary);
    let sources = ([-R::ONE / R::from_count(64); T], [-R::ONE / R::from_count(32); Q]);
    let loads = CellLoads { triangles: black_box(&sources.0), quads: black_box(&sources.1) };
    let mut load = [R::ZERO; E];
    let load = cut(&mut load, unknowns)?;
    meter.count("load", "cell", cells, || assembly::load(&edges, loads, &boundary, load))?;

    let mut rows = [Row::<R, u16, WIDTH>::EMPTY; E];
    let memory = cut(&mut rows, unknowns)?;
    meter.count("rows, pattern", "unknown", unknowns, || Rows::new(&edges, memory).map(drop))?;
    let mut rows = Rows::new(&edges, memory)?;
    let omega = black_box(R::ONE + R::HALF + R::QUARTER);
    meter.count("rows from cells", "unknown", unknowns, || {
        rows.gather(&edges, stiffness, diagonal, load, omega)
    })?;

    let (mut row_ptr, mut col_idx) = ([0; EDGES + 1], [[0; ENTRIES]; E]);
    let row_ptr = cut(&mut row_ptr, unknowns + 1)?;
    let col_idx = cut(col_idx.as_flattened_mut(), edges.nonzeros())?;
    let mut values = [[R::ZERO; ENTRIES]; E];
    let values = cut(values.as_flattened_mut(), col_idx.len())?;
    meter.count("CSR, pattern", "unknown", unknowns, || {
        assembly::pattern(&edges, row_ptr, col_idx)
    })?;
    meter.count("CSR, values", "unknown", unknowns, || {
        assembly::values(&edges, stiffness, diagonal, row_ptr, values)
    })?;
    let matrix = Csr::new(row_ptr, col_idx, values, edges.counts().edges())?;
    let gap = [-R::QUARTER * R::QUARTER; 16];
    let system = System::new(matrix, load, Law::above(black_box(&gap)), edges.counts())?;
    meter.count("rows from CSR", "unknown", unknowns, || rows.set(&system, omega))?;

    let mut u = [R::ZERO; E];
    let u = cut(&mut u, edges.counts().edges())?;
    meter.count("sweep", "unknown", unknowns, || {
        psor::sweep(&rows, Law::above(black_box(&gap)), u)
    })?;
    let mut records = [Record::<R, WIDTH>::EMPTY; E];
    let records = cut(&mut records, unknowns)?;
    fill(records, &system, omega);
    let free = edges.counts().free;
    meter.count("sweep, safe code", "unknown", unknowns, || {
        by_records(records, free, black_box(&gap), u, R::ONE - omega);
        Ok(())
    })?;
    meter.count("sweep over CSR", "unknown", unknowns, || {
        by_csr(&system, u, omega);
        Ok(())
    })?;
    meter.count("residual", "unknown", unknowns, || {
        black_box(system.residual(u));
        Ok(())
    })?;
    let mut by_triangles = [[R::ZERO; 3]; T];
    let mut by_quads = [[R::ZERO; 4]; Q];
    meter.count("flux by cells", "cell", cells, || {
        if Q == 0 {
            flux::of_triangles(&edges, stiffness, loads.triangles, u, &mut by_triangles)
        } else {
            flux::of_quads(&edges, stiffness, loads.quads, u, &mut by_quads)
        }
    })?;
    let mut by_edges = [R::ZERO; E];
    let by_edges = cut(&mut by_edges, u.len())?;
    meter.count("flux by edges", "cell", cells, || {
        flux::recover(&edges, stiffness, loads, u, &[], by_edges).map(drop)
    })?;
    meter.count("solve to the last digit", "unknown", unknowns, || {
        u.fill(R::ZERO);
        Solver::<R>::new(Settings::default())?.run(&system, &mut rows, u).map(drop)
    })?;
    Ok(())
}

/// The forest and the packed cells, found once, and the certificate of an iterate.
#[inline(never)]
fn certificate<R: Bits, const T: usize, const Q: usize, const E: usize>(
    meter: &mut Meter,
) -> Result<(), Error> {
    let mut grid = Grid::<R, T, Q>::new();
    let (mesh, edges) = grid.number()?;
    let tensor = Tensor { xx: R::TWO, xy: R::QUARTER, yy: R::ONE };
    let (mut triangles, mut quads) = ([[R::ZERO; 3]; T], [[R::ZERO; 6]; Q]);
    stiffness::fill(&mesh, Coefficient::Uniform(tensor), 2, &mut triangles, &mut quads)?;
    let stiffness = Stiffness { triangles: &triangles, quads: &quads };
    let boundary = Boundary::new(&edges, &[], &[], &[])?;
    let sources = ([-R::ONE / R::from_count(64); T], [-R::ONE / R::from_count(32); Q]);
    let loads = CellLoads { triangles: black_box(&sources.0), quads: black_box(&sources.1) };
    let mut u = [R::ZERO; E];
    let u = cut(&mut u, edges.counts().edges())?;
    u.iter_mut().enumerate().for_each(|(at, u)| *u = R::ONE / R::from_count(at as u32 + 2));
    let u: &[R] = u;
    let cells = edges.cells();
    let mut ways = [[0_u16; 2 * SQUARES]; 3];
    let [order, parent, place] = &mut ways;
    let (order, parent, place) = (cut(order, cells)?, cut(parent, cells)?, cut(place, cells)?);
    let mut way = [R::ZERO; 2 * SQUARES];
    let way = cut(&mut way, cells)?;
    meter.count("forest", "cell", cells, || {
        let buffers = ForestBuffers {
            order: &mut *order,
            parent: &mut *parent,
            place: &mut *place,
            distance: &mut *way,
        };
        grow(&edges, |_| R::ONE, |edge| is_root(&edges, &boundary, edge), buffers).map(drop)
    })?;
    let forest = Forest::new(&edges, order, parent, place)?;
    let compliance = [R::QUARTER / (R::TWO - R::QUARTER * R::QUARTER); T];
    let (mut triangles, mut quads) = ([Triangle::EMPTY; T], [Quad::EMPTY; Q]);
    let (mut of_vertices, mut of_edges) = ([R::ZERO; VERTICES], [R::ZERO; E]);
    let of_edges = cut(&mut of_edges, u.len())?;
    meter.count("packed cells", "cell", cells, || {
        let buffers = CellBuffers {
            triangles: &mut triangles,
            quads: &mut quads,
            of_vertices: &mut of_vertices,
            of_edges: &mut *of_edges,
        };
        pack(&mesh, &edges, stiffness, &[], &compliance, &forest, buffers).map(drop)
    })?;
    let packed = Cells::new(&triangles, &quads, &of_vertices, of_edges, &forest)?;
    let metric = Metric::default();
    let stability = stability(&edges, &packed, metric, &boundary, &forest, way)?;
    let discretization =
        Discretization { mesh, edges, stiffness, cells: packed, metric, stability };
    let gap = -R::QUARTER * R::QUARTER;
    let (at_gap, given, lower) = ([[gap; 2]; 16], [[R::ZERO; 2]; 16], [gap; 16]);
    let given = LoadCase {
        loads,
        boundary,
        ends: VertexData { gap: black_box(&at_gap), given: black_box(&given) },
        curved: &[],
        transfer: &[],
        forms: &[],
        oscillation: R::ZERO,
    };
    let (mut vertices, mut bubbles, mut tau) = ([R::ZERO; VERTICES], [R::ZERO; E], [R::ZERO; E]);
    let bubbles = cut(&mut bubbles, if Q > 0 { u.len() } else { 0 })?;
    let tau = cut(&mut tau, u.len())?;
    meter.count("certificate", "cell", cells, || {
        let buffers = Buffers {
            vertices: &mut vertices,
            bubbles: &mut *bubbles,
            tau: &mut *tau,
            indicators: &mut [],
        };
        let iterate = Iterate { u, law: Law::above(black_box(&lower)) };
        black_box(certify(&discretization, &given, iterate, buffers)?);
        Ok(())
    })?;
    // All cells at the same 64 points.
    let (at_points, place) = ([[tensor; POINTS * POINTS]], [0_u32; 2 * SQUARES]);
    let place = place.get(..cells).unwrap_or(&[]);
    let metric = Metric { at_points: black_box(&at_points), place, ..Metric::default() };
    let varying = Discretization { metric, ..discretization };
    meter.count("certificate, A varies", "cell", cells, || {
        let buffers = Buffers {
            vertices: &mut vertices,
            bubbles: &mut *bubbles,
            tau: &mut *tau,
            indicators: &mut [],
        };
        let iterate = Iterate { u, law: Law::above(black_box(&lower)) };
        black_box(certify(&varying, &given, iterate, buffers)?);
        Ok(())
    })
}

/// A packed row with columns instead of offsets, for the record of what `unsafe` is worth.
#[derive(Clone, Copy)]
struct Record<R, const WIDTH: usize> {
    load: R,
    entries: [R; WIDTH],
    columns: [u16; WIDTH],
}

impl<R: Bits, const WIDTH: usize> Record<R, WIDTH> {
    const EMPTY: Self = Self { load: R::ZERO, entries: [R::ZERO; WIDTH], columns: [0; WIDTH] };
}

fn fill<R: Bits, const WIDTH: usize>(
    records: &mut [Record<R, WIDTH>],
    system: &System<R, u16>,
    omega: R,
) {
    for ((record, row), &load) in records.iter_mut().zip(system.matrix().iter()).zip(system.load())
    {
        let scale = omega / row.diagonal();
        record.load = load * scale;
        let places = record.entries.iter_mut().zip(&mut record.columns);
        for ((entry, column), (at, value)) in places.zip(row.entries().skip(1)) {
            (*entry, *column) = (value * scale, at as u16);
        }
    }
}

/// The sweep of the kernel with a test of every position.
#[inline(never)]
fn by_records<R: Bits, const WIDTH: usize>(
    records: &[Record<R, WIDTH>],
    free: usize,
    gap: &[R],
    u: &mut [R],
    keep: R,
) {
    let relaxed = |record: &Record<R, WIDTH>, u: &[R], own: R| {
        let entries = record.entries.iter().zip(&record.columns);
        entries.fold(record.load + keep * own, |sum, (&entry, &column)| {
            u.get(usize::from(column)).map_or(sum, |&other| sum - entry * other)
        })
    };
    let (free, contact) = records.split_at_checked(free).unwrap_or((records, &[]));
    for (i, record) in free.iter().enumerate() {
        let value = relaxed(record, u, u.get(i).copied().unwrap_or_default());
        if let Some(own) = u.get_mut(i) {
            *own = value;
        }
    }
    for ((i, record), &gap) in (free.len()..).zip(contact).zip(gap) {
        let value = relaxed(record, u, u.get(i).copied().unwrap_or_default());
        if let Some(own) = u.get_mut(i) {
            *own = if value > gap { value } else { gap };
        }
    }
}

/// The same sweep in plain safe code over CSR, for the record of what rows are worth.
fn by_csr<R: Bits>(system: &System<R, u16>, u: &mut [R], omega: R) {
    let rows = system.matrix().iter().zip(system.load()).enumerate();
    for (i, (row, &load)) in rows {
        let step = omega * (load - row.dot(u)) / row.diagonal();
        let gap = i.checked_sub(system.counts().free).and_then(|at| system.law().lower().get(at));
        if let Some(u) = u.get_mut(i) {
            *u += step;
            if let Some(&gap) = gap.filter(|&&gap| *u < gap) {
                *u = gap;
            }
        }
    }
}
