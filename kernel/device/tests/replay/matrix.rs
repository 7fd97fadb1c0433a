//! From the mesh to the matrix, one sweep, the flux of an unfinished iterate.

use signorini_bound::forest::{ForestBuffers, grow};
use signorini_kernel::flux_range::Spans;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::components::{Part, examine};
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::stiffness::{self, Coefficient};
use signorini_kernel::{Error, Libm, assembly, contact, flux, psor};

use super::arrays::Arrays;
use super::journal::Journal;
use super::scene::Scalar;

pub fn run<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    let (mesh, edges, boundary) = (arrays.mesh()?, arrays.edges()?, arrays.boundary()?);
    journal.line("counts", edges.counts());
    journal.digest("half-edges", edges.half_edges());
    let all = 0..edges.counts().edges();
    journal.digest("ends", all.clone().map(|at| edges.endpoints(&mesh, at)).collect::<Vec<_>>());
    let lengths = all.map(|at| edges.length::<R, Libm>(&mesh, at)).collect::<Vec<_>>();
    journal.digest("lengths", lengths);
    let (triangles, quads) = (arrays.triangles.len(), arrays.quads.len());
    for points in 1..=4 {
        let mut k = (vec![[R::ZERO; 3]; triangles], vec![[R::ZERO; 6]; quads]);
        // Neighbours' tensors in turn.
        let (own, others) = arrays.tensors.split_at(triangles);
        let others = others.iter().cycle().take(quads * points * points);
        let tensors: Vec<_> = own.iter().chain(others).copied().collect();
        stiffness::fill(&mesh, Coefficient::PerPoint(&tensors), points, &mut k.0, &mut k.1)?;
        journal.digest("element matrices from points", &k);
        stiffness::fill(&mesh, Coefficient::Uniform(tensors[0]), points, &mut k.0, &mut k.1)?;
        journal.digest("of one tensor", &k);
    }
    journal.digest("element matrices", &arrays.k);
    journal.digest("matrix", arrays.matrix()?);
    journal.digest("load", &arrays.load);
    if quads == 0 {
        let mut load = vec![R::ZERO; arrays.load.len()];
        assembly::load_of_triangles(&edges, &arrays.loads.0, &boundary, &mut load)?;
        journal.digest("load of triangles", &load);
    }
    let mut parts = vec![Part::default(); edges.cells()];
    let load = (&arrays.load[..], Spans::UNLIMITED);
    let found = examine(&edges, arrays.diagonal()?, load, R::of(1e-4), &mut parts);
    journal.line("parts", found);
    journal.digest("parts", &parts);
    ways(arrays, journal)
}

/// Forests with many ways of equal length: every cell costs the same, or one of three prices.
fn ways<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    let edges = arrays.edges()?;
    for prices in [1, 3] {
        let mut scratch = [(); 3].map(|()| vec![u16::MAX; edges.cells()]);
        let [order, parent, place] = &mut scratch;
        let mut distance = vec![R::ZERO; edges.cells()];
        let buffers = ForestBuffers { order, parent, place, distance: &mut distance };
        let cost = |cell: usize| R::of((1 + cell % prices) as f64);
        grow(&edges, cost, |edge| edge % 4 == 1, buffers)?;
        journal.digest("forest", (&scratch, &distance));
    }
    Ok(())
}

pub fn sweeps<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    journal.line("residual at the start", arrays.system(false)?.residual(&arrays.start));
    journal.line("scaled", arrays.system(false)?.residual(&arrays.start).scaled());
    if arrays.quads.is_empty() {
        of_width::<R, TRIANGLES>(arrays, journal)?;
    }
    of_width::<R, QUADS>(arrays, journal)
}

fn of_width<R: Scalar, const WIDTH: usize>(
    arrays: &Arrays<R>,
    journal: &mut Journal,
) -> Result<(), Error> {
    let (edges, diagonal, system) = (arrays.edges()?, arrays.diagonal()?, arrays.system(false)?);
    let mut memory = vec![Row::<R, u16, WIDTH>::EMPTY; arrays.counts.unknowns()];
    let mut rows = Rows::new(&edges, &mut memory)?;
    for omega in [0.75, 1.0, 1.625] {
        let omega = R::of(omega);
        rows.set(&system, omega)?;
        let (law, mut of_matrix) = (Law::above(&arrays.lower), arrays.start.clone());
        psor::sweep(&rows, law, &mut of_matrix)?;
        // Nothing is left of the rows from CSR.
        let mut memory = vec![Row::<R, u16, WIDTH>::EMPTY; arrays.counts.unknowns()];
        let mut rows = Rows::new(&edges, &mut memory)?;
        rows.gather(&edges, arrays.stiffness(), diagonal, &arrays.load, omega)?;
        let mut u = arrays.start.clone();
        journal.line("defect", psor::defect(&rows, law, &u)?);
        psor::sweep(&rows, law, &mut u)?;
        journal.digest("swept", [&of_matrix, &u]);
        journal.line("defect", psor::defect(&rows, law, &u)?);
        journal.digest("residual", system.residual(&u));
        let mut free = arrays.start.clone();
        psor::sweep_free(&rows, &mut free)?;
        journal.digest("free edges swept", &free);
        fluxes(arrays, &u, journal)?;
    }
    Ok(())
}

fn fluxes<R: Scalar>(arrays: &Arrays<R>, u: &[R], journal: &mut Journal) -> Result<(), Error> {
    let (mesh, edges, boundary) = (arrays.mesh()?, arrays.edges()?, arrays.boundary()?);
    let (k, loads, law) = (arrays.stiffness(), arrays.cell_loads(), Law::above(&arrays.lower));
    let mut triangles = vec![[R::ZERO; 3]; arrays.triangles.len()];
    let mut quads = vec![[R::ZERO; 4]; arrays.quads.len()];
    flux::of_triangles(&edges, k, loads.triangles, u, &mut triangles)?;
    flux::of_quads(&edges, k, loads.quads, u, &mut quads)?;
    journal.digest("flux of cells", (&triangles, &quads));
    let mut of_edges = vec![R::ZERO; u.len()];
    journal.line("recovered", flux::recover(&edges, k, loads, u, &[], &mut of_edges)?);
    journal.digest("flux", &of_edges);
    journal.line("force", contact::force(arrays.counts, &boundary, law, u, &of_edges));
    let low: Vec<_> = u.iter().map(|&u| u * R::EPSILON).collect();
    journal.line("recovered", flux::recover(&edges, k, loads, u, &low, &mut of_edges)?);
    journal.digest("flux with the low part", &of_edges);
    let of_cells = contact::force_of_cells(&edges, &boundary, law, u, &triangles, &quads);
    journal.line("force of cells", of_cells);
    journal.line("length", contact::length::<R, u16, Libm>(&mesh, &edges, law, u));
    Ok(())
}
