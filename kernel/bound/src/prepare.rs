//! Preparation of a mesh for the bound: where A in reference coordinates is constant, and cells packed along their ways out.

use crate::cells::{CellBuffers, pack};
use crate::certificate::{Metric, Stability, stability};
use crate::forest::{Forest, ForestBuffers, grow};
use signorini_kernel::index::{Index, read};
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Error, Mesh, Real, Tensor};

/// Whether opposite sides of a quad agree to 4·10⁻¹² of the cell's height, below which B hardly varies, or to the last
/// digits of a short scalar.
pub fn is_parallelogram<R: Real>([a, b, c, d]: [[R; 2]; 4]) -> bool {
    let side = |from: [R; 2], to: [R; 2]| [to[0] - from[0], to[1] - from[1]];
    let (bottom, top, left) = (side(a, b), side(d, c), side(a, d));
    let size = |v: [R; 2]| v[0].magnitude().or_larger(v[1].magnitude());
    let longer = size(bottom).or_larger(size(left));
    let height = (bottom[0] * left[1] - bottom[1] * left[0]).magnitude() / longer;
    let millionth = R::ONE / R::from_count(1_000_000);
    let slack = (R::TWO * R::EPSILON).or_larger(R::from_count(4) * millionth * millionth);
    let differ = |(x, y): (&R, &R)| (*x - *y).magnitude() > slack * height;
    !bottom.iter().zip(&top).any(differ)
}

/// Whether an element matrix with this rounding tells B: it holds sums of B's entries, in which the small one of a thin
/// cell, or of an oblique A, is lost.
pub fn is_told<R: Real>(b: Tensor<R>, epsilon: R) -> bool {
    let spread = b.xx + b.yy;
    let condition = spread * (spread / (b.xx * b.yy - b.xy * b.xy));
    R::from_count(1000) * epsilon * condition <= R::ONE
}

/// A as the preparation takes it (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Conductivities<'a, R> {
    /// ½ tr A of each cell, triangles first.
    pub alpha: &'a [R],
    /// 1/(4 det A) of each triangle.
    pub compliance: &'a [R],
    /// A in reference coordinates where it varies.
    pub metric: Metric<'a, R>,
}

/// Grows the forest from the edges that are roots, cells of a large A first, packs the cells along it, and says what the
/// balance of a cell costs. The scratch of the forest has an entry per cell and is used again.
///
/// # Errors
/// [`Error::NoWayOut`] for a part without a root, after which nothing is packed; arrays of the wrong length.
pub fn prepare<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    (edges, stiffness): (&Edges<I>, Stiffness<R>),
    boundary: &Boundary<R, I>,
    a: Conductivities<R>,
    is_root: impl Fn(usize) -> bool,
    forest: ForestBuffers<R, I>,
    cells: CellBuffers<R, I>,
) -> Result<Stability<R>, Error> {
    let ForestBuffers { order, parent, place, distance } = forest;
    let cost = |cell: usize| R::ONE / read(a.alpha, cell);
    let buffers = ForestBuffers { order, parent, place, distance: &mut *distance };
    grow(edges, cost, is_root, buffers)?;
    let forest = Forest::new(edges, order, parent, place)?;
    let cells = pack(mesh, edges, stiffness, a.alpha, a.compliance, &forest, cells)?;
    stability(edges, &cells, a.metric, boundary, &forest, distance)
}
