//! Sweeps in f32 on residuals in f64: the accuracy of the long format, mostly for the work of the short one.
//!
//! ```text
//!   r = b − Ku                                                             in f64
//!   v ≈ the solution of the same problem with load r/s, v ≥ (ψ − u)/s      sweeps in f32, from v = 0
//!   u ← u + s v, and u = ψ exactly where v is on its bound                 in f64, then again
//! ```
//! Sweeps on v are those on u, but for rounding: wherever a round ends, the next one goes on as if there
//! had been none. So a single search for ω sees them all, and a round only has to end before rounding in f32
//! stops it. An ω near the best takes e^−(2 − ω) off the error in a sweep, 8/(2 − ω) of them about three of
//! the seven digits. s is a power of two near the size of u; it stays, for the search must see no jump.
//!
//! Where the error is more than 10⁷ times the residual, the matrix rounded to f32 is another one: rounds
//! then gain nothing, and the solve says that it has stalled.

mod correction;
mod rounds;

use signorini_kernel::Error as KernelError;
use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::solver::{Outcome, Settings};

use correction::Correction;
use rounds::Rounds;
use signorini_problem::{Assembled, Parts, Problem};

type Refused<T> = Result<T, KernelError>;

/// A problem assembled in both scalars, for many solves.
#[derive(Debug)]
pub struct Mixed<'p> {
    /// The problem in f64, whose loads may become those of another time.
    pub wide: Assembled<'p, f64>,
    narrow: Assembled<'p, f32>,
    rows: Packed,
    correction: Correction,
}

/// Memory of rows as long as the cells ask for.
#[derive(Debug)]
enum Packed {
    Triangles(Vec<Row<f32, u32, { rows::TRIANGLES }>>),
    Quads(Vec<Row<f32, u32, { rows::QUADS }>>),
}

/// Outcome of a solve with corrections.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corrected {
    /// Outcome of the kernel; sweeps are those in f32, the residual is that in f64.
    pub outcome: Outcome<f64>,
    /// Times that u was corrected.
    pub corrections: u32,
}

impl<'p> Mixed<'p> {
    /// Assembles `problem` twice.
    ///
    /// # Errors
    /// Numbers that f32 cannot hold.
    pub fn new(problem: &'p Problem, parts: &Parts) -> Refused<Self> {
        let wide = Assembled::new(problem)?;
        let mut narrow = Assembled::new(problem)?;
        narrow.set_parts(parts);
        let counts = problem.topology.counts;
        let rows = if problem.mesh.quads.is_empty() {
            Packed::Triangles(vec![Row::EMPTY; counts.unknowns()])
        } else {
            Packed::Quads(vec![Row::EMPTY; counts.unknowns()])
        };
        Ok(Self { wide, narrow, rows, correction: Correction::new(counts) })
    }

    /// Sweeps until `settings` are met, in f64. `u` (one entry an edge, u_D included) is start and answer.
    ///
    /// # Errors
    /// A `u` of another length, a relaxation factor outside (0, 2), a residual that f32 cannot hold.
    pub fn run(&mut self, settings: Settings<f64>, u: &mut [f64]) -> Refused<Corrected> {
        let Self { wide, narrow, rows, correction } = self;
        let (edges, wide, narrow) = (wide.edges(), wide.system()?, narrow.system()?);
        match rows {
            Packed::Triangles(rows) => {
                Rounds { wide, narrow, settings, correction }.run(Rows::new(edges, rows)?, u)
            }
            Packed::Quads(rows) => {
                Rounds { wide, narrow, settings, correction }.run(Rows::new(edges, rows)?, u)
            }
        }
    }
}
