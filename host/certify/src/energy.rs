//! Energies of what is left out of the boundary data: each is weighed by A on its cell before it is called small.

use signorini_kernel::Tensor;

use super::cell::Cell;
use super::conductivity::{Conductivity, product};
use signorini_problem::Problem;
use signorini_problem::quadrature::gauss;

/// Points away from the side, and a direction for vertex functions: these energies bound small terms.
const POINTS: usize = 3;

/// A place along a side with its weight, and a function and its derivative there.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    pub(crate) t: f64,
    pub(crate) weight: f64,
    pub(crate) w: f64,
    pub(crate) slope: f64,
}

/// A on one cell.
pub struct CellEnergy<'s> {
    cell: Cell,
    conductivity: Conductivity<'s>,
    /// Above A, where no rule of points sees it.
    ceiling: Option<Tensor<f64>>,
}

impl<'s> CellEnergy<'s> {
    /// The energy of cell `at`, triangles first.
    pub fn of(problem: &'s Problem, at: usize) -> Self {
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let ceiling = conductivity.cut().map(|_| conductivity.ceiling(&cell));
        Self { cell, conductivity, ceiling }
    }

    fn at(&self, x: [f64; 2]) -> Tensor<f64> {
        self.ceiling.unwrap_or_else(|| self.conductivity.at(x))
    }

    /// The root of Σ_k ∫A∇N_k·∇N_k: what moving the values at the vertices by 1 may cost here.
    pub fn of_vertices(&self) -> f64 {
        let mut sum = 0.0;
        for point in self.cell.points(&gauss(POINTS)) {
            let a = self.at(point.x);
            let local = self.cell.local(point.reference);
            let energies = local.vertices.iter().map(|n| product(&a, n.gradient, n.gradient));
            sum += point.weight * energies.sum::<f64>();
        }
        sum.sqrt()
    }

    /// ‖A^½∇v‖ at most, from ∫w² and ∫w′² at most along side `side`.
    pub fn of_missed(&self, side: usize, [square, of_slope]: [f64; 2]) -> f64 {
        let unit = |w: f64, slope: f64| [0.0, 1.0].map(|t| Sample { t, weight: 1.0, w, slope });
        let of = |samples: &[Sample], square: f64| match square {
            0.0 => 0.0,
            square => self.of_extension(side, samples) * square.sqrt(),
        };
        of(&unit(1.0, 0.0), square) + of(&unit(0.0, 1.0), of_slope)
    }

    /// ‖A^½∇v‖ of v = (1 − η) w(t) from samples of w along side `side`. The largest sample is the unit: squares of w
    /// may overflow or vanish.
    pub fn of_extension(&self, side: usize, samples: &[Sample]) -> f64 {
        let largest = |most: f64, of: &Sample| most.max(of.w.abs()).max(of.slope.abs());
        let unit = samples.iter().fold(0.0, largest);
        if unit == 0.0 {
            return 0.0;
        }
        let (mut sum, away) = (0.0, gauss(POINTS));
        for of in samples {
            for &[eta, weight] in &away {
                let local = self.cell.local(self.cell.side_point(side, of.t, eta));
                let element = self.cell.area_element(&local, eta);
                let v = local.sides[side].extension(of.w / unit, of.slope / unit).gradient;
                let a = self.at(local.x);
                sum += of.weight * weight * element * product(&a, v, v);
            }
        }
        unit * sum.sqrt()
    }
}
