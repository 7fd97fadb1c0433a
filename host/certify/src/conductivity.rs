//! A of a cell as the scene states it: at any point, not only where the solver integrates.

use signorini_kernel::Tensor;

use signorini_problem::Problem;
use signorini_problem::cell::Cell;
use signorini_problem::pieces::{PiecePoint, Pieces};
use signorini_problem::quadrature::{DATA_POINTS, Point};
use signorini_problem::tensors::{self, scaled};
use signorini_scene::scene::Material;

/// A ν that is as good as nothing: functions with a lift are integrated less exactly.
const SAME: f64 = 1e-9;

/// The tensor A on one cell.
pub struct Conductivity<'s> {
    material: &'s Material,
    constant: Option<Tensor<f64>>,
    pieces: Option<&'s Pieces>,
}

impl<'s> Conductivity<'s> {
    /// The tensor of cell `cell`, triangles first.
    pub fn of(problem: &'s Problem, cell: usize) -> Self {
        let material = &problem.scene.materials[problem.binding.materials[cell] as usize];
        let constant = tensors::constant(material);
        Self { material, constant, pieces: problem.coefficients.pieces.get(&cell) }
    }

    /// Whether A is the same all over the cell.
    pub fn is_constant(&self) -> bool {
        self.constant.is_some()
    }

    /// A on pieces of the cell, where its own points do not resolve it.
    pub fn cut(&self) -> Option<&'s Pieces> {
        self.pieces.filter(|pieces| !pieces.is_resolved())
    }

    /// Part of the root of an integral over the cell that its points miss, and what they leave open of what they see.
    pub fn missed(&self, cell: Cell) -> [f64; 2] {
        self.pieces.map_or([0.0; 2], |pieces| [pieces.slack(cell), 2.0 * pieces.left])
    }

    /// The pieces that count for functions which are no polynomials: where p is A but for rounding, rules of their own see more.
    pub fn cut_for_curves(&self) -> Option<&'s Pieces> {
        self.cut().filter(|pieces| pieces.share() > SAME)
    }

    /// ν of a cell that is not cut.
    pub fn share(&self) -> f64 {
        self.pieces.map_or(0.0, Pieces::share)
    }

    /// Tensors that are, each on its piece of the cell, below A.
    pub fn floors(&self) -> Vec<Tensor<f64>> {
        let pieces = self.pieces.map(|pieces| pieces.floors().collect());
        self.constant.map(|a| vec![a]).or(pieces).unwrap_or_default()
    }

    /// A lower bound of the eigenvalues of A in the cell.
    pub fn alpha(&self) -> f64 {
        self.floors().iter().map(smallest_eigenvalue).fold(f64::INFINITY, f64::min)
    }

    /// The points of a rule on the cell, with A there; where they do not resolve A those of its pieces, with what is below A.
    pub fn points(&self, cell: &Cell, rule: &[[f64; 2]]) -> Vec<PiecePoint> {
        match self.cut() {
            Some(pieces) => pieces.points(*cell).collect(),
            None => cell.points(rule).into_iter().map(|point| self.resolved(point)).collect(),
        }
    }

    /// Points a direction that polynomials inside the cell need: of degree 2 on quads, and so many on a triangle.
    pub fn points_for(&self, cell: &Cell, on_triangle: usize) -> usize {
        match cell {
            Cell::Triangle(_) if self.is_constant() => on_triangle,
            Cell::Quad(_) if self.is_constant() && cell.is_affine() => 3,
            _ => DATA_POINTS,
        }
    }

    /// A at a point of a cell that is not cut, with what is open there.
    pub fn resolved(&self, point: Point) -> PiecePoint {
        let a = self.at(point.x);
        self.pieces.map_or(PiecePoint::known(point, a), |pieces| pieces.resolved(point, a))
    }

    /// A tensor above A all over the cell.
    pub fn ceiling(&self, cell: &Cell) -> Tensor<f64> {
        let middle = self.at(cell.middle());
        scaled(&middle, self.pieces.map_or(1.0, |pieces| pieces.most(&middle)))
    }

    /// A at a point.
    pub fn at(&self, point: [f64; 2]) -> Tensor<f64> {
        self.constant.unwrap_or_else(|| tensors::at(self.material, point))
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
