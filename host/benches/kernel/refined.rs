//! Accuracy beyond what sweeps in f32 alone reach.

use criterion::{BatchSize, Bencher};
use signorini_kernel::Libm;
use signorini_kernel::refinement;
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::solver::{Settings, Solver};
use signorini_problem::scalar::Scalar;
use signorini_solve::Mixed;

use crate::strip::Strip;

/// To the last digit of the scalar, with corrections of the defect.
pub fn refined<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let system = assembled.system().expect("the numbers are finite");
    let diagonal = assembled.diagonal().expect("the records are admissible");
    let (edges, counts) = (assembled.edges(), system.counts());
    let zeros = |length| vec![R::ZERO; length];
    let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; counts.unknowns()];
    let (mut low, mut scratch) = (zeros(counts.edges()), zeros(refinement::scratch(counts)));
    let run = |u: &mut Vec<R>| {
        let rows = Rows::new(edges, &mut memory)?;
        let settings = Settings { accuracy: R::EPSILON, ..Settings::default() };
        let u = [&mut u[..], &mut low];
        refinement::run::<R, u32, Libm, WIDTH>(
            &system,
            diagonal,
            settings,
            6,
            u,
            rows,
            &mut scratch,
        )
    };
    bencher.iter_batched_ref(|| assembled.start(), run, BatchSize::LargeInput);
}

const DEEP: f64 = 1e-12;

/// Sweeps in f64.
pub fn pure<const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<f64>();
    let system = assembled.system().expect("the numbers are finite");
    let mut memory = vec![Row::<f64, u32, WIDTH>::EMPTY; system.counts().unknowns()];
    let run = |u: &mut Vec<f64>| {
        let mut rows = Rows::new(assembled.edges(), &mut memory)?;
        let settings = Settings { tolerance: DEEP, ..Settings::default() };
        Solver::<f64>::new(settings)?.run(&system, &mut rows, u)
    };
    bencher.iter_batched_ref(|| assembled.start(), run, BatchSize::LargeInput);
}

/// Sweeps in f32 on residuals in f64.
pub fn mixed(bencher: &mut Bencher, strip: &Strip) {
    let mut mixed = Mixed::new(strip.problem(), &strip.parts()).expect("f32 holds the problem");
    let start = mixed.assembled().start();
    let settings = Settings { tolerance: DEEP, ..Settings::default() };
    let run = |u: &mut Vec<f64>| mixed.run(settings, u);
    bencher.iter_batched_ref(|| start.clone(), run, BatchSize::LargeInput);
}
