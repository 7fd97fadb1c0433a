//! The exact solver, in several orders of elimination.

use signorini_kernel::Error;
use signorini_kernel::solver::Settings;

use super::arrays::Arrays;
use super::journal::Journal;
use super::scene::Scalar;
use crate::factored;

pub fn run<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    let (system, diagonal) = (arrays.system(false)?, arrays.diagonal()?);
    let free = arrays.counts.free as u16;
    let forward: Vec<u16> = (0..free).collect();
    let backward: Vec<u16> = (0..free).rev().collect();
    // Every other one first, then the rest.
    let colours: Vec<u16> = (0..free).step_by(2).chain((1..free).step_by(2)).collect();
    for (order, tolerance) in [(forward, 0.0), (backward, 1e-3), (colours, 1e-30)] {
        let settings = Settings {
            tolerance: R::of(tolerance),
            accuracy: R::of(8.0 * tolerance),
            ..Settings::default()
        };
        let (mut u, mut low) = (arrays.start.clone(), vec![R::ONE; arrays.counts.edges()]);
        let matrix = system.matrix();
        let found =
            factored::solve(matrix, &system, diagonal, &settings, &order, &mut u, &mut low)?;
        for progress in found.iter().flatten() {
            journal.line("factored", (progress.status, progress.pivots, progress.rounds));
            journal.digest("residual", progress.residual);
        }
        if found.is_some() {
            let least = arrays.lower.iter().zip(&u[arrays.counts.free..]).all(|(psi, u)| u >= psi);
            assert!(least, "below the gap");
            journal.digest("u", (&u, &low));
        } else {
            journal.line("factored", "no answer");
        }
    }
    Ok(())
}
