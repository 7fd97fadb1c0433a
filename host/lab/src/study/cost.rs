//! Cycles per unknown: the sweep, the whole solve, and how near the sweep is to what memory allows.

use serde::Serialize;
use signorini_kernel::psor;
use signorini_kernel::rows::{self, Row, Rows};

use crate::cycles::smallest;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Problem};

/// Work measured in one scalar.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct Cost {
    /// Cycles per unknown and sweep.
    pub sweep: f64,
    /// Cycles per unknown for reading once, in order, as many bytes as the rows have.
    pub stream: f64,
    /// Bytes of rows and u that a sweep touches, per unknown.
    pub bytes: f64,
    /// Multiply–adds of a sweep, per unknown.
    pub multiply_adds: f64,
}

/// Sweeps timed together, so that the counter's own cost vanishes.
const TOGETHER: u32 = 20;

/// Sums kept apart, so that reading and not adding is measured.
const LANES: usize = 16;

fn add<R: Scalar>(mut sums: [R; LANES], values: &[R; LANES]) -> [R; LANES] {
    sums.iter_mut().zip(values).for_each(|(sum, &value)| *sum += value);
    sums
}

/// Measures sweeps on `problem`; `None` where it has no unknowns or does not fit the scalar.
pub fn measure<R: Scalar>(problem: &Problem) -> Option<Cost> {
    if problem.mesh.quads.is_empty() {
        with_rows::<R, { rows::TRIANGLES }>(problem)
    } else {
        with_rows::<R, { rows::QUADS }>(problem)
    }
}

fn with_rows<R: Scalar, const WIDTH: usize>(problem: &Problem) -> Option<Cost> {
    let assembled = Assembled::<R>::new(problem).ok()?;
    let system = assembled.system().ok()?;
    let unknowns = system.counts().unknowns();
    let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; unknowns];
    let mut rows = Rows::new(assembled.edges(), &mut memory).ok()?;
    rows.set(&system, R::ONE + R::HALF).ok()?;
    let mut u = assembled.start();
    let mut sweep = |_| psor::sweep(&rows, system.law(), &mut u);
    let sweeps = smallest(|| (0..TOGETHER).try_for_each(&mut sweep).unwrap_or_default());
    let bytes = size_of::<Row<R, u32, WIDTH>>() as f64;
    let numbers = vec![R::ONE; unknowns * size_of::<Row<R, u32, WIDTH>>() / size_of::<R>()];
    let stream = smallest(|| {
        for _ in 0..TOGETHER {
            let (values, _) = std::hint::black_box(&numbers).as_chunks::<LANES>();
            std::hint::black_box(values.iter().fold([R::ZERO; LANES], add));
        }
    });
    let each = f64::from(TOGETHER) * unknowns as f64;
    (unknowns > 0).then_some(Cost {
        sweep: sweeps / each,
        stream: stream / each,
        // The row, and u read and written once.
        bytes: bytes + 2.0 * size_of::<R>() as f64,
        multiply_adds: WIDTH as f64 + 1.0,
    })
}
