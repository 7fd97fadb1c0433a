//! Fluxes from edge means.

use criterion::Bencher;
use signorini_kernel::flux;
use signorini_problem::scalar::Scalar;

use crate::strip::Strip;

/// One flux an edge, the mean of both sides, with their disagreement.
pub fn of_edges<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let u = assembled.start();
    let mut fluxes = vec![R::ZERO; u.len()];
    let (edges, stiffness, cells) = (assembled.edges(), assembled.stiffness(), assembled.cells());
    bencher.iter(|| flux::recover(edges, stiffness, cells, &u, &[], &mut fluxes));
}

/// One flux a side of each cell.
pub fn of_cells<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
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
