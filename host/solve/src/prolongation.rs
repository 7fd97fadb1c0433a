//! From a coarse mesh to a fine one: where the first tick on the fine mesh starts.
//!
//! Sweeps remove what is rough at once and what is smooth hardly at all; a coarser mesh has found the
//! smooth part with a fraction of the sweeps. The mean of the coarse u_h over a fine edge is its value
//! in the middle, a combination of the means over the sides of the coarse cell there:
//! ```text
//!   u_E = Σ_k φ_k(middle of E) u_k,        k over the 3 or 4 sides of the coarse cell
//! ```

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, read};

/// Where one fine edge takes its value from.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Origin<R, I> {
    /// Sides of the coarse cell; of a triangle the last counts for nothing.
    pub edges: [I; 4],
    /// φ_k in the middle of the fine edge; 0 in the last place for a triangle.
    pub weights: [R; 4],
}

/// Fills `fine` from the means `coarse`. Gaps and Dirichlet values are imposed by whoever starts there.
///
/// # Errors
/// An origin that names no coarse edge, a wrong number of origins: `fine` is not changed then.
pub fn prolong<R: Real, I: Index>(
    origins: &[Origin<R, I>],
    coarse: &[R],
    fine: &mut [R],
) -> Result<(), Error> {
    same_length(Array::Unknowns, fine.len(), origins.len())?;
    let stray = |origin: &Origin<R, I>| origin.edges.iter().any(|edge| edge.at() >= coarse.len());
    if let Some(at) = origins.iter().position(stray) {
        return Err(Error::OutOfRange { of: Array::Edges, at });
    }
    for (value, origin) in fine.iter_mut().zip(origins) {
        let terms = origin.edges.iter().zip(origin.weights);
        *value = terms.fold(R::ZERO, |sum, (edge, weight)| sum + weight * read(coarse, edge.at()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_combined_and_strays_refused() {
        let origin = Origin { edges: [0_u16, 1, 2, 0], weights: [0.5, 0.75, -0.25, 0.0] };
        let mut fine = [f64::NAN];
        assert_eq!(prolong(&[origin], &[2.0, 4.0, 8.0], &mut fine), Ok(()));
        assert_eq!(fine, [2.0]);
        let stray = Err(Error::OutOfRange { of: Array::Edges, at: 0 });
        assert_eq!(prolong(&[origin], &[2.0, 4.0], &mut fine), stray);
        let many = Err(Error::Length { of: Array::Unknowns, found: 1, expected: 2 });
        assert_eq!(prolong(&[origin; 2], &[2.0, 4.0, 8.0], &mut fine), many);
        assert_eq!(fine, [2.0]);
    }
}
