//! The solver that one would choose for the size of a problem, by what each took when it was timed.
//!
//! With N unknowns, rows of w entries, n contact edges and the mean √r of all cells, in nanoseconds on the machine of the record
//! (`cargo bench --bench solvers`, host/benches/solvers/record.csv):
//! ```text
//!   sweeps      10 w N^1.5 √r                 9 to 60 √N sweeps on the standard scenes; r = 1 has the fewest
//!   a factor    700 N + 9 N^1.5 + n³          order and pattern, columns of L, exchanges on the dense S
//!   direct      1700 N + 3 N^1.5              the same, in supernodes
//!   multigrid   500 N + 700 N √r + 2·10⁷      iterations that hardly depend on the mesh; small meshes stay with a factor
//! ```
//! r is the condition number of A as the cell has it: of J⁻¹AJ⁻ᵀ, J from an equilateral triangle or a square. With the sides e
//! ```text
//!   ½(√r + 1/√r) = √det A Σ e·A⁻¹e / c|T|,    c = 4√3 of triangles, 4 of quads.
//! ```
//! The estimate depends on the problem alone: it is solved in the same way on every machine. Where sweeps take 15 ms or less
//! nobody waits, and they are what a device has.

use signorini_kernel::rows;
use signorini_problem::Problem;
use signorini_problem::cell::Cell;

use super::Ran;

/// Nanoseconds of sweeps that nobody waits for.
const AT_ONCE: f64 = 15e6;

/// Nanoseconds that multigrid has to be ahead by: of a factor's answer the digits do not depend on how many iterations it took.
const SMALL: f64 = 20e6;

/// What the time of a solve depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// Unknown edges.
    pub unknowns: usize,
    /// Contact edges.
    pub contact: usize,
    /// Whether there are quads.
    pub quads: bool,
    /// The mean of √r over all cells.
    pub stretch: f64,
}

impl Size {
    /// The size of `problem`.
    pub fn of(problem: &Problem) -> Self {
        let (counts, cells) = (problem.topology.counts, problem.cells());
        let sum: f64 = (0..cells).map(|cell| stretch(problem, cell)).sum();
        Self {
            unknowns: counts.unknowns(),
            contact: counts.contact,
            quads: !problem.mesh.quads.is_empty(),
            stretch: sum / cells as f64,
        }
    }

    /// Nanoseconds of a solve by each solver, estimated.
    fn estimates(self) -> [(Ran, f64); 4] {
        let width = if self.quads { rows::QUADS } else { rows::TRIANGLES };
        let (n, contact) = (self.unknowns as f64, self.contact as f64);
        let sweeps = 10.0 * (1.0 + width as f64) * n.powf(1.5) * self.stretch;
        let factor = 700.0 * n + 9.0 * n.powf(1.5) + contact.powi(3);
        let direct = 1700.0 * n + 3.0 * n.powf(1.5);
        let multigrid = 500.0 * n + 700.0 * n * self.stretch + SMALL;
        [
            (Ran::Sweeps, if sweeps <= AT_ONCE { 0.0 } else { sweeps }),
            (Ran::Factor, factor),
            (Ran::Direct, direct),
            (Ran::Multigrid, multigrid),
        ]
    }

    /// The solver with the least estimate; the direct one only where `is_double`.
    pub fn quickest(self, is_double: bool) -> Ran {
        let may = |of: &(Ran, f64)| is_double || of.0 != Ran::Direct;
        let least = self.estimates().into_iter().filter(may).min_by(|a, b| a.1.total_cmp(&b.1));
        least.map_or(Ran::Sweeps, |of| of.0)
    }
}

/// √r of a cell.
fn stretch(problem: &Problem, at: usize) -> f64 {
    let (cell, tensor) = (Cell::of(problem, at), problem.mean_conductivity(at));
    let determinant = tensor.xx * tensor.yy - tensor.xy * tensor.xy;
    let corners = cell.corners();
    let next = corners.iter().cycle().skip(1);
    let sides = corners.iter().zip(next).map(|(a, b)| {
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        tensor.yy * x * x - 2.0 * tensor.xy * x * y + tensor.xx * y * y
    });
    let share = if corners.len() == 3 { 4.0 * 3.0_f64.sqrt() } else { 4.0 };
    let mean = sides.sum::<f64>() / (share * cell.area() * determinant.sqrt());
    mean + (mean * mean - 1.0).max(0.0).sqrt()
}

/// Sweeps that a mesh takes, between the 9 √N and 60 √N of the standard scenes.
pub(super) fn sweeps(unknowns: usize) -> f64 {
    30.0 * (unknowns as f64).sqrt()
}

/// Whether sweeps would take more than 15 ms by the estimate, and another solver less than them.
pub fn is_long_to_sweep(problem: &Problem) -> bool {
    Size::of(problem).quickest(false) != Ran::Sweeps
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{SMOOTH, changed, on_grid};
    use signorini_scene::error::Result;
    use signorini_scene::mesh::structured::{Cells, grid};

    /// On squares r is the condition number of A, whichever way it is turned.
    #[test]
    fn squares_have_the_condition_of_the_tensor() -> Result<()> {
        let plain = "conductivity = [\"2\", \"0.5\", \"1\"]";
        for (tensor, r) in [
            ("conductivity = [\"3\", \"0\", \"3\"]", 1.0_f64),
            ("conductivity = [\"100\", \"0\", \"1\"]", 100.0),
            ("conductivity = [\"50.5\", \"49.5\", \"50.5\"]", 100.0),
        ] {
            let (_, problem) =
                on_grid(&changed(SMOOTH, &[(plain, tensor)]), grid(8, Cells::Quads))?;
            let found = Size::of(&problem).stretch;
            assert!((found - r.sqrt()).abs() < 1e-6 * r, "{tensor}: {found}");
        }
        Ok(())
    }
}
