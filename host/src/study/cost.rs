//! Cycles per unknown: the sweep, the whole solve, and how near the sweep is to what memory allows.

use serde::Serialize;
use signorini_kernel::psor;

use crate::cycles::smallest;
use crate::problem::{Assembled, Problem};
use crate::scalar::Scalar;

/// Work measured in one scalar.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct Cost {
    /// Cycles per unknown and sweep.
    pub sweep: f64,
    /// Cycles per unknown for reading once, in order, all that a sweep reads.
    pub stream: f64,
    /// Bytes of matrix, load and u that a sweep touches, per unknown.
    pub bytes: f64,
    /// Multiply–adds of a sweep, per unknown.
    pub multiply_adds: f64,
}

/// Sweeps timed together, so that the counter's own cost vanishes.
const TOGETHER: u32 = 20;

/// Sums kept apart, so that reading and not adding is measured.
const LANES: usize = 16;

fn add<R: Scalar>(mut sums: [R; LANES], values: &[R]) -> [R; LANES] {
    sums.iter_mut().zip(values).for_each(|(sum, &value)| *sum += value);
    sums
}

/// Measures sweeps on `problem`; `None` where it has no unknowns or does not fit the scalar.
pub fn measure<R: Scalar>(problem: &Problem) -> Option<Cost> {
    let assembled = Assembled::<R>::new(problem).ok()?;
    let system = assembled.system().ok()?;
    let mut u = assembled.start();
    let omega = R::ONE + R::HALF;
    let sweeps = smallest(|| (0..TOGETHER).for_each(|_| psor::sweep(&system, &mut u, omega)));
    let matrix = system.matrix();
    let stream = smallest(|| {
        for _ in 0..TOGETHER {
            let values = matrix.values().chunks(LANES).fold([R::ZERO; LANES], add);
            let columns = matrix.col_idx().iter().fold(0_u32, |sum, &c| sum.wrapping_add(c));
            std::hint::black_box((values, columns));
        }
    });
    let unknowns = matrix.rows() as f64;
    let entries = matrix.values().len() as f64 / unknowns;
    let scalar = size_of::<R>() as f64;
    let each = f64::from(TOGETHER) * unknowns;
    (unknowns > 0.0).then_some(Cost {
        sweep: sweeps / each,
        stream: stream / each,
        // Values and columns of the row, its pointer, b, and u read and written once.
        bytes: entries * (scalar + 4.0) + 4.0 + 3.0 * scalar,
        multiply_adds: entries + 1.0,
    })
}
