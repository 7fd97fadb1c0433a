//! One sweep, and what it costs to know how far one is.

use criterion::Bencher;
use signorini_kernel::law::Law;
use signorini_kernel::psor;
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_problem::scalar::Scalar;

use crate::strip::Strip;

/// One sweep; its cost does not depend on ω.
pub fn sweep<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    strip.widen(bencher, sweep_wide::<R, TRIANGLES>, sweep_wide::<R, QUADS>);
}

fn sweep_wide<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    with_rows::<R, WIDTH>(strip, |rows, law, mut u| {
        bencher.iter(|| psor::sweep(rows, law, &mut u));
    });
}

/// The residual of packed rows.
pub fn defect<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    strip.widen(bencher, defect_wide::<R, TRIANGLES>, defect_wide::<R, QUADS>);
}

fn defect_wide<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
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
