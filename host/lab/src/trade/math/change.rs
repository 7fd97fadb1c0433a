//! How far two answers on one mesh are apart, relative to the first.

use signorini_kernel::{Error, flux};

use signorini_problem::Assembled;

/// The part of an answer that is compared.
pub(super) struct State {
    /// Mean of u_h over each edge.
    pub u: Vec<f64>,
    /// ∫_C (σ·n − q)
    pub force: f64,
    /// Σ|E| over the active edges.
    pub length: f64,
}

/// Relative changes; none where the first answer has nothing to relate them to.
pub(super) struct Change {
    pub energy: Option<f64>,
    pub force: Option<f64>,
    pub length: Option<f64>,
}

impl Change {
    /// From `before` to `after`, in the element matrices of `assembled`.
    pub fn between(
        assembled: &Assembled<f64>,
        before: &State,
        after: &State,
    ) -> Result<Self, Error> {
        let moved: Vec<f64> = before.u.iter().zip(&after.u).map(|(a, b)| a - b).collect();
        Ok(Self {
            energy: relative(energy(assembled, &moved)?, energy(assembled, &before.u)?),
            force: relative(after.force - before.force, before.force),
            length: relative(after.length - before.length, before.length),
        })
    }
}

fn relative(change: f64, of: f64) -> Option<f64> {
    let ratio = (change / of).abs();
    ratio.is_finite().then_some(ratio)
}

/// ‖A^½∇_h u‖: its square is Σ_E u_E ∫_E σ·n over the sides of all cells, for the σ that u has without
/// a load.
fn energy(assembled: &Assembled<f64>, u: &[f64]) -> Result<f64, Error> {
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
