//! The coefficient A in reference coordinates: all that the bound needs of geometry.
//!
//! With F the map from the reference cell (the triangle (0,0), (1,0), (0,1) or the square \[0, 1\]²) and
//! C the cofactor matrix of DF, gradients and Raviart–Thomas fluxes pull back so that
//! ```text
//!   ∫_T |A^½∇s − A^{−½}τ|² = ∫ (B∇̂ŝ − τ̂)·B^{−1}(B∇̂ŝ − τ̂) dx̂ dŷ,      B = CᵀAC / det DF.
//! ```
//! Where A is constant and F affine, so is B, and the element matrix tells it. Elsewhere B is stored at
//! the points of an 8×8 Gauss rule, which triangles take through the collapsed square, or in a factor (`factor`).

use super::factor::{Above, Factor};
use signorini_kernel::element::rannacher_turek::MappedPoint;
use signorini_kernel::mesh::geometry::doubled_area;
use signorini_kernel::{Real, Tensor, features};

/// Gauss points a direction where B varies.
pub const POINTS: usize = 8;

/// B where it varies, and what tells u_h at the vertices (borrowed).
#[derive(Debug, Clone, Copy, Default)]
pub struct Metric<'a, R> {
    /// B at the 64 points of every cell where it varies, one such cell after the other.
    pub at_points: &'a [[Tensor<R>; POINTS * POINTS]],
    /// Factors of the cells whose 64 points do not resolve A.
    pub factors: &'a [Factor<R>],
    /// What A has above its points or its factor in these cells; may be empty where that is nothing.
    pub above: &'a [Above<R>],
    /// Part of the root of an integral that points and factors may miss.
    pub missed: R,
    /// Where a cell stands in `at_points` with `factors` behind it, triangles first; beyond both where B is constant. May be
    /// empty: B is constant everywhere then.
    pub place: &'a [u32],
    /// The distortion of every quad ([`signorini_kernel::element::nonparametric::Axes::distortion`]), where u_h is nonparametric on them; empty where it is
    /// parametric, or where no quad is distorted: then they say the same at vertices.
    pub distortions: &'a [[R; 2]],
}

/// B in a cell in which it varies.
#[derive(Debug, Clone, Copy)]
pub(super) enum Varying<'a, R> {
    /// At its 64 points.
    Points(&'a [Tensor<R>; POINTS * POINTS]),
    /// In all integrals.
    Factor(&'a Factor<R>),
}

impl<'a, R: Real> Metric<'a, R> {
    /// How B varies, or `None` where it is constant.
    #[inline(always)]
    pub(super) fn varying(&self, cell: usize) -> Option<Varying<'a, R>> {
        if !features::VARYING {
            return None;
        }
        let at = *self.place.get(cell)? as usize;
        let factor = || match features::PIECES {
            true => self.factors.get(at.checked_sub(self.at_points.len())?),
            false => None,
        };
        self.at_points.get(at).map(Varying::Points).or_else(|| factor().map(Varying::Factor))
    }

    /// What A has above what it is taken for in a cell.
    pub(super) fn above(&self, cell: usize) -> Above<R> {
        let at = self.place.get(cell).copied().unwrap_or(u32::MAX);
        self.above.get(at as usize).copied().unwrap_or_default()
    }

    /// The distortion of a quad, counted among the quads; 0 where u_h is parametric on it.
    pub(super) fn distortion(&self, quad: usize) -> [R; 2] {
        if features::DISTORTED {
            self.distortions.get(quad).copied().unwrap_or_default()
        } else {
            [R::ZERO; 2]
        }
    }
}

/// B of a parallelogram with constant A, from its element matrix:
/// K₀₂ = ¾B₁₁ − ¼B₂₂, K₁₃ = ¾B₂₂ − ¼B₁₁, K₁₂ − K₀₁ = 2B₁₂.
pub(super) fn of_parallelogram<R: Real>(&[k01, k02, _, k12, k13, _]: &[R; 6]) -> Tensor<R> {
    let half = |x: R| R::HALF * x;
    Tensor { xx: half(R::THREE * k02 + k13), xy: half(k12 - k01), yy: half(k02 + R::THREE * k13) }
}

/// B of a triangle at a point where its coefficient is `a`.
pub fn of_triangle<R: Real>([p, q, r]: [[R; 2]; 3], a: Tensor<R>) -> Tensor<R> {
    let (along, across) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
    pulled_back(along, across, doubled_area(p, q, r), a)
}

/// B of a quad at a point where its coefficient is `a`.
pub fn of_quad<R: Real>(place: &MappedPoint<R>, a: Tensor<R>) -> Tensor<R> {
    let [along, across] = place.directions();
    pulled_back(along, across, place.determinant, a)
}

/// CᵀAC / det with the columns of DF: C's columns are those turned by ∓90°.
fn pulled_back<R: Real>(along: [R; 2], across: [R; 2], det: R, a: Tensor<R>) -> Tensor<R> {
    let (c1, c2) = ([across[1], -across[0]], [-along[1], along[0]]);
    let form = |v: [R; 2], w: [R; 2]| {
        let image = [a.xx * w[0] + a.xy * w[1], a.xy * w[0] + a.yy * w[1]];
        (v[0] * image[0] + v[1] * image[1]) / det
    };
    Tensor { xx: form(c1, c1), xy: form(c1, c2), yy: form(c2, c2) }
}

/// r·B^{−1}r
pub(super) fn inverse_form<R: Real>(b: Tensor<R>, [x, y]: [R; 2]) -> R {
    let det = b.xx * b.yy - b.xy * b.xy;
    (b.yy * x * x - R::TWO * b.xy * x * y + b.xx * y * y) / det
}
