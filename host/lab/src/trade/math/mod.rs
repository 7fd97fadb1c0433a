//! The change of the solution where a function of micromath replaces libm's.
//!
//! A function is used in two places: in the load data that a controller evaluates itself (`loads`), and,
//! the square root alone, by the kernel (`roots`): in the search for ω and in the lengths of edges. Each
//! is replaced by itself, everything else stays, and how far the answer moves is said.

mod loads;
mod roots;
#[cfg(test)]
mod tests;

use super::record::FunctionCost;
use signorini_kernel::{Error as KernelError, flux};
use signorini_problem::{Assembled, Problem};
use signorini_scene::Error;
use signorini_solve::Solution;

/// A row for every function that the loads of `problem` call, one for f32 alone where they call any, and
/// those of the kernel's square root; at its time.
pub fn of_scene(problem: &Problem) -> Result<Vec<FunctionCost>, Error> {
    let mut rows = loads::rows(problem)?;
    rows.extend(roots::rows(problem)?);
    Ok(rows)
}

impl FunctionCost {
    /// How far u, force and length of `after` are from those of `before`, relative to these, in the element matrices of
    /// `assembled`; nothing where `before` has nothing to relate it to.
    fn changed(
        self,
        assembled: &Assembled<f64>,
        before: &Solution,
        after: &Solution,
    ) -> Result<Self, KernelError> {
        let moved: Vec<f64> = before.u.iter().zip(&after.u).map(|(a, b)| a - b).collect();
        Ok(Self {
            energy: relative(energy(assembled, &moved)?, energy(assembled, &before.u)?),
            force: relative(after.contact_force - before.contact_force, before.contact_force),
            length: relative(after.contact_length - before.contact_length, before.contact_length),
            ..self
        })
    }
}

fn relative(change: f64, of: f64) -> Option<f64> {
    let ratio = (change / of).abs();
    ratio.is_finite().then_some(ratio)
}

/// ‖A^½∇_h u‖: its square is Σ_E u_E ∫_E σ·n over the sides of all cells, for the σ that u has without
/// a load.
fn energy(assembled: &Assembled<f64>, u: &[f64]) -> Result<f64, KernelError> {
    let (edges, stiffness) = (assembled.edges(), assembled.stiffness());
    let mut triangles = vec![[0.0; 3]; edges.of_triangles().len()];
    let mut quads = vec![[0.0; 4]; edges.of_quads().len()];
    flux::of_triangles(edges, stiffness, &[], u, &mut triangles)?;
    flux::of_quads(edges, stiffness, &[], u, &mut quads)?;
    let sides = edges.of_triangles().as_flattened().iter().zip(triangles.as_flattened());
    let sides = sides.chain(edges.of_quads().as_flattened().iter().zip(quads.as_flattened()));
    let square: f64 = sides.map(|(&edge, flow)| u[edge as usize] * flow).sum();
    Ok(square.max(0.0).sqrt())
}
