//! Matrix and load from element matrices, and packed rows from either.

use criterion::Bencher;
use signorini_kernel::assembly;
use signorini_kernel::rows::{Row, Rows};
use signorini_problem::scalar::Scalar;

use crate::strip::Strip;

/// The pattern of the matrix.
pub fn pattern<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let edges = assembled.edges();
    let mut row_ptr = vec![0; edges.counts().unknowns() + 1];
    let mut col_idx = vec![0; edges.nonzeros()];
    bencher.iter(|| assembly::pattern(edges, &mut row_ptr, &mut col_idx));
}

/// The values of the matrix.
pub fn values<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let diagonal = assembled.diagonal().expect("the records are admissible");
    let system = assembled.system().expect("the numbers are finite");
    let (edges, row_ptr) = (assembled.edges(), system.matrix().row_ptr());
    let mut values = vec![R::ZERO; edges.nonzeros()];
    let stiffness = assembled.stiffness();
    bencher.iter(|| assembly::values(edges, stiffness, diagonal, row_ptr, &mut values));
}

/// The right-hand side.
pub fn load<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let boundary = assembled.boundary().expect("the records are admissible");
    let edges = assembled.edges();
    let mut load = vec![R::ZERO; edges.counts().unknowns()];
    bencher.iter(|| assembly::load(edges, assembled.cells(), &boundary, &mut load));
}

/// Rows from CSR: what a new ω costs.
pub fn set<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let system = assembled.system().expect("the numbers are finite");
    let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; system.counts().unknowns()];
    let mut rows = Rows::new(assembled.edges(), &mut memory).expect("u32 holds the edges");
    bencher.iter(|| rows.set(&system, R::narrow(1.9)));
}

/// Rows without a matrix.
pub fn gather<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let diagonal = assembled.diagonal().expect("the records are admissible");
    let system = assembled.system().expect("the numbers are finite");
    let (edges, stiffness, load) = (assembled.edges(), assembled.stiffness(), system.load());
    let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; load.len()];
    let mut rows = Rows::new(edges, &mut memory).expect("u32 holds the edges");
    bencher.iter(|| rows.gather(edges, stiffness, diagonal, load, R::narrow(1.9)));
}
