//! A of a cell as the scene states it: at any point, not only where the solver integrates.

use signorini_kernel::Tensor;

use signorini_problem::Problem;
use signorini_scene::expression::Expression;
use signorini_scene::scene::Located;

/// The tensor A on one cell.
pub struct Conductivity<'s> {
    entries: &'s [Located<Expression>; 3],
    constant: Option<Tensor<f64>>,
}

impl<'s> Conductivity<'s> {
    /// The tensor of cell `cell`, triangles first.
    pub fn of(problem: &'s Problem, cell: usize) -> Self {
        let entries =
            &problem.scene.materials[problem.binding.materials[cell] as usize].conductivity;
        let [xx, xy, yy] = entries.each_ref().map(|entry| entry.value.is_constant());
        let constant = match (xx, xy, yy) {
            (Some(xx), Some(xy), Some(yy)) => Some(Tensor { xx, xy, yy }),
            _ => None,
        };
        Self { entries, constant }
    }

    /// Whether A is the same all over the cell.
    pub fn is_constant(&self) -> bool {
        self.constant.is_some()
    }

    /// A at a point.
    pub fn at(&self, [x, y]: [f64; 2]) -> Tensor<f64> {
        self.constant.unwrap_or_else(|| {
            let [xx, xy, yy] = self.entries.each_ref().map(|entry| entry.value.eval(x, y, 0.0));
            Tensor { xx, xy, yy }
        })
    }
}

/// v·Aw
pub fn product(a: &Tensor<f64>, v: [f64; 2], w: [f64; 2]) -> f64 {
    dot(v, apply(a, w))
}

/// Aw
pub fn apply(a: &Tensor<f64>, w: [f64; 2]) -> [f64; 2] {
    [a.xx * w[0] + a.xy * w[1], a.xy * w[0] + a.yy * w[1]]
}

/// v·w
pub fn dot(v: [f64; 2], w: [f64; 2]) -> f64 {
    v[0] * w[0] + v[1] * w[1]
}

/// A⁻¹
pub fn inverse(a: &Tensor<f64>) -> Tensor<f64> {
    let determinant = a.xx * a.yy - a.xy * a.xy;
    Tensor { xx: a.yy / determinant, xy: -a.xy / determinant, yy: a.xx / determinant }
}

/// The smaller eigenvalue.
pub fn smallest_eigenvalue(a: &Tensor<f64>) -> f64 {
    eigenvalues(a)[0]
}

/// Both eigenvalues, the smaller first: det A over the larger one, which unlike their difference never
/// cancels.
pub fn eigenvalues(a: &Tensor<f64>) -> [f64; 2] {
    let half = 0.5 * (a.xx + a.yy);
    let largest = half + (0.5 * (a.xx - a.yy)).hypot(a.xy);
    [(a.xx / largest) * a.yy - (a.xy / largest) * a.xy, largest]
}
