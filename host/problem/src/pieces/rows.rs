//! Integrals over the pieces of a cell as rows over what v and τ are made of: of many points' rows the triangular factor is all that
//! matters.

use signorini_kernel::Tensor;

use super::{PiecePoint, Pieces};
use crate::Problem;
use crate::cell::Cell;
use crate::field::CellField;
use crate::triangular::triangular;

/// The means of the function of u_h on a quad that is curved.
const CURVED: [f64; 4] = [0.0, 0.5, 0.0, 0.5];

/// Rows over the coefficients of v and then of τ.
pub type Rows = Vec<Vec<f64>>;

/// Integrals over a cell as rows, ν being that of each piece.
#[derive(Debug, Clone)]
pub struct Cut {
    /// p^½∇v − p^{−½}τ
    pub seen: Rows,
    /// That times √ν′, ν′ = min(1, ν).
    pub doubtful: Rows,
    /// √N′∇v and √N∇v
    pub above: [Rows; 2],
    /// Coefficients of v.
    pub gradients: usize,
    /// Part of the root of an integral that the points of its pieces miss.
    pub missed: f64,
}

impl Cut {
    /// The integrals over cell `at`.
    pub fn of(problem: &Problem, at: usize, pieces: &Pieces) -> Self {
        let functions = Functions::of(problem, at);
        let sides = functions.cell.corners().len();
        let gradients = if sides == 3 { 2 } else { 8 };
        let [mut seen, mut doubtful] = [0, 1].map(|_| vec![Vec::new(); gradients + sides]);
        let mut above = [0, 1].map(|_| vec![Vec::new(); gradients]);
        for at in pieces.points(functions.cell) {
            let (root, weight) = (Root::of(&at.below, at.point.weight.sqrt()), at.point.weight);
            let slopes = functions.slopes(&at);
            let of_v = slopes.iter().map(|slope| root.gradient(*slope));
            let of_tau = functions.fluxes[..sides].iter();
            let of_tau = of_tau.map(|of| root.flux(of.flux(&at.point)).map(|x| -x));
            let rows: Vec<[f64; 2]> = of_v.chain(of_tau).collect();
            extend(&mut seen, rows.iter().copied());
            if at.share == 0.0 {
                continue;
            }
            extend(&mut doubtful, rows.iter().map(|row| row.map(|x| at.share.sqrt() * x)));
            for (columns, share) in above.iter_mut().zip([at.share, 1.0]) {
                let root = Root::of(&at.above, (weight * share).sqrt());
                extend(columns, slopes.iter().map(|slope| root.gradient(*slope)));
            }
        }
        let [seen, doubtful] = [seen, doubtful].map(triangular);
        let missed = pieces.slack(functions.cell);
        Self { seen, doubtful, above: above.map(triangular), gradients, missed }
    }
}

fn extend(columns: &mut [Vec<f64>], rows: impl Iterator<Item = [f64; 2]>) {
    columns.iter_mut().zip(rows).for_each(|(column, row)| column.extend(row));
}

/// The functions of v and τ on a cell.
struct Functions {
    cell: Cell,
    /// The Raviart–Thomas field with the outward flux 1 through each side.
    fluxes: [CellField; 4],
    /// The curved function of u_h.
    curved: CellField,
}

impl Functions {
    fn of(problem: &Problem, at: usize) -> Self {
        let unit = |side: usize| std::array::from_fn(|k| f64::from(u8::from(k == side)));
        let flux = |side| CellField::of_sides(problem, at, [0.0; 4], unit(side));
        let curved = CellField::of_sides(problem, at, CURVED, [0.0; 4]);
        Self { cell: Cell::of(problem, at), fluxes: [0, 1, 2, 3].map(flux), curved }
    }

    /// Gradients at a point, in the order of the factor's columns.
    fn slopes(&self, at: &PiecePoint) -> Vec<[f64; 2]> {
        let local = self.cell.local(at.point.reference);
        let corners = self.cell.corners().len();
        let mut slopes: Vec<_> = local.vertices[1..corners].iter().map(|of| of.gradient).collect();
        if corners == 4 {
            slopes.extend(local.sides.iter().map(|side| side.bubble().gradient));
            slopes.push(self.curved.sample(&at.point).gradient);
        }
        slopes
    }
}

/// √w L of a tensor A = LLᵀ at a point of weight w.
pub struct Root {
    xx: f64,
    yx: f64,
    yy: f64,
    /// √w
    weight: f64,
}

impl Root {
    /// The root of `a`, times that of the weight, `weight`.
    pub fn of(a: &Tensor<f64>, weight: f64) -> Self {
        let xx = a.xx.sqrt();
        let yx = if xx > 0.0 { a.xy / xx } else { 0.0 };
        Self { xx, yx, yy: (a.yy - yx * yx).max(f64::MIN_POSITIVE).sqrt(), weight }
    }

    /// √w Lᵀg
    pub fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.weight * (self.xx * x + self.yx * y), self.weight * self.yy * y]
    }

    /// √w L⁻¹τ
    pub fn flux(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let first = x / self.xx;
        [self.weight * first, self.weight * (y - self.yx * first) / self.yy]
    }
}
