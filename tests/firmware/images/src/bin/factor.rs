//! What a factor costs on the mesh of `cost`, as that prints it: a defect by its cells, a substitution by columns and
//! entries of L.
//!
//! Unknowns are eliminated from left to right, which leaves about 25 entries a column. An order of least degree
//! has fewer: columns without entries are counted apart.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_contact::dense::blocks::{SIDE, count};
use signorini_device::sparse::elimination::PatternBuffers;
use signorini_device::sparse::factor::FactorBuffers;
use signorini_device::sparse::{Balance, Factor, Pattern};
use signorini_firmware::grid::{COLUMNS, EDGES, Grid, SQUARES, column};
use signorini_firmware::journal::Bits;
use signorini_firmware::meter::{Meter, run};
use signorini_firmware::stages::cut;
use signorini_kernel::assembly;
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::rows::{QUADS, TRIANGLES};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Error, Tensor};

/// More entries than L has.
const ENTRIES: usize = 16_384;

#[entry]
fn main() -> ! {
    run(|meter| {
        stages::<f32, { TRIANGLES + 1 }, { 2 * SQUARES }, 0>(meter.kind("f32 triangles"))?;
        stages::<f32, { QUADS + 1 }, 0, SQUARES>(meter.kind("f32 quads"))?;
        stages::<f64, { TRIANGLES + 1 }, { 2 * SQUARES }, 0>(meter.kind("f64 triangles"))?;
        stages::<f64, { QUADS + 1 }, 0, SQUARES>(meter.kind("f64 quads"))
    })
}

/// T triangles or Q quads, whose rows have so many entries.
#[inline(never)]
fn stages<R: Bits, const ROW: usize, const T: usize, const Q: usize>(
    meter: &mut Meter,
) -> Result<(), Error> {
    let mut grid = Grid::<R, T, Q>::new();
    let (mesh, edges) = grid.number()?;
    let (counts, cells) = (edges.counts(), T + Q);
    let tensor = Tensor { xx: R::TWO, xy: R::QUARTER, yy: R::ONE };
    let (mut triangles, mut quads) = ([[R::ZERO; 3]; T], [[R::ZERO; 6]; Q]);
    stiffness::fill(&mesh, Coefficient::Uniform(tensor), 2, &mut triangles, &mut quads)?;
    let stiffness = Stiffness { triangles: &triangles, quads: &quads };
    let boundary = Boundary::new(&edges, &[], &[], &[])?;
    let diagonal = DiagonalTerms::new(&boundary);
    let (mut row_ptr, mut col_idx) = ([0; EDGES + 1], [[0; ROW]; EDGES]);
    let row_ptr = cut(&mut row_ptr, counts.unknowns() + 1)?;
    let col_idx = cut(col_idx.as_flattened_mut(), edges.nonzeros())?;
    let mut values = [[R::ZERO; ROW]; EDGES];
    let values = cut(values.as_flattened_mut(), col_idx.len())?;
    assembly::pattern(&edges, row_ptr, col_idx)?;
    assembly::values(&edges, stiffness, diagonal, row_ptr, values)?;
    let matrix = Csr::new(row_ptr, col_idx, values, counts.edges())?;

    let mut of_unknowns = [[0_u16; EDGES]; 5];
    let [order, place, parent, visited, path] = &mut of_unknowns;
    let order = cut(order, counts.free)?;
    let from_left = (0..=2 * COLUMNS).flat_map(|far| (0..counts.free).map(move |edge| (far, edge)));
    let along = from_left.filter(|&(far, edge)| {
        edges.endpoints(&mesh, edge).map(column).iter().sum::<usize>() == far
    });
    order.iter_mut().zip(along).for_each(|(place, (_, edge))| *place = edge as u16);
    let (mut pointers, mut ends) = ([0; EDGES + 1], [0; EDGES]);
    let visited = cut(visited, counts.free)?;
    let buffers = PatternBuffers {
        place: cut(place, counts.free)?,
        parent: cut(parent, counts.free)?,
        visited: &mut *visited,
        pointers: cut(&mut pointers, counts.free + 1)?,
    };
    let pattern = Pattern::new(&matrix, counts, order, buffers)?;
    let (mut rows, mut entries) = ([0_u16; ENTRIES], [R::ZERO; ENTRIES]);
    let (mut inverse, mut row) = ([R::ZERO; EDGES], [R::ZERO; EDGES]);
    let mut schur = [[[R::ZERO; SIDE]; SIDE]; count(16)];
    let mut again = [0_u16; EDGES];
    let number = pattern.entries();
    let buffers = FactorBuffers {
        rows: cut(&mut rows, number)?,
        values: cut(&mut entries, number)?,
        inverse: cut(&mut inverse, counts.free)?,
        ends: cut(&mut ends, counts.free)?,
        path: cut(path, counts.free)?,
        visited: cut(&mut again, counts.free)?,
        row: cut(&mut row, counts.unknowns())?,
    };
    let singular = Error::NotUnique { cell: 0 };
    let factor = Factor::new(&matrix, pattern, buffers, &mut schur)?.ok_or(singular)?;

    let mut u = [R::ZERO; EDGES];
    let u = cut(&mut u, counts.edges())?;
    u.iter_mut().enumerate().for_each(|(at, u)| *u = R::ONE / R::from_count(at as u32 + 2));
    let (load, mut y) = ([R::ONE; EDGES], [R::ZERO; EDGES]);
    let y = cut(&mut y, counts.unknowns())?;
    let load = load.get(..counts.unknowns()).unwrap_or_default();
    let balance = Balance { edges: &edges, stiffness, diagonal, load };
    meter.count("defect", "cell", cells, || {
        balance.defects(&factor, black_box(&*u), y);
        Ok(())
    })?;
    let (none, ones) = ([0; EDGES + 1], [R::ONE; EDGES]);
    let columns = Factor::baked(&[], &none, &[], &[], black_box(&ones), counts);
    let mut round = |factor: &Factor<R, u16>| {
        factor.eliminate(y);
        factor.substitute(y);
        black_box(&*y);
        Ok(())
    };
    meter.count("substitution, columns", "unknown", counts.unknowns(), || round(&columns))?;
    meter.count("substitution, entries", "entry", number, || round(&factor))
}
