//! One sweep, what it costs to know how far one is, and fluxes from edge means.

use criterion::Bencher;
use signorini_kernel::law::Law;
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::{flux, psor};
use signorini_problem::scalar::Scalar;

use crate::strip::Strip;

/// One sweep; its cost does not depend on ω.
pub fn sweep<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    with_rows::<R, WIDTH>(strip, |rows, law, mut u| {
        bencher.iter(|| psor::sweep(rows, law, &mut u));
    });
}

/// The residual of packed rows.
pub fn defect<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    with_rows::<R, WIDTH>(strip, |rows, law, u| bencher.iter(|| psor::defect(rows, law, &u)));
}

fn with_rows<R: Scalar, const WIDTH: usize>(
    strip: &Strip,
    time: impl FnOnce(&Rows<R, u32, WIDTH>, Law<R>, Vec<R>),
) {
    let assembled = strip.assembled::<R>();
    let system = assembled.system().expect("the numbers are finite");
    let mut memory = vec![Row::EMPTY; system.counts().unknowns()];
    let mut rows = Rows::new(assembled.edges(), &mut memory).expect("u32 holds the edges");
    rows.set(&system, R::narrow(1.9)).expect("one numbering");
    time(&rows, system.law(), assembled.start());
}

/// The residual of the matrix, with its scale and what rounding makes of it.
pub fn residual<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let system = assembled.system().expect("the numbers are finite");
    let u = assembled.start();
    bencher.iter(|| system.residual(&u));
}

/// One flux an edge, the mean of both sides, with their disagreement.
pub fn flux_of_edges<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let u = assembled.start();
    let mut fluxes = vec![R::ZERO; u.len()];
    let (edges, stiffness, cells) = (assembled.edges(), assembled.stiffness(), assembled.cells());
    bencher.iter(|| flux::recover(edges, stiffness, cells, &u, &[], &mut fluxes));
}

/// One flux a side of each cell.
pub fn flux_of_cells<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let u = assembled.start();
    let (edges, stiffness, cells) = (assembled.edges(), assembled.stiffness(), assembled.cells());
    let mut triangles = vec![[R::ZERO; 3]; edges.of_triangles().len()];
    let mut quads = vec![[R::ZERO; 4]; edges.of_quads().len()];
    bencher.iter(|| {
        flux::of_triangles(edges, stiffness, cells.triangles, &u, &mut triangles)?;
        flux::of_quads(edges, stiffness, cells.quads, &u, &mut quads)
    });
}
