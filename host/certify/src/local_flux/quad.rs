//! Polynomial fluxes inside a quad, in its reference coordinates.

use super::super::conductivity::product;
use super::super::legendre::{DEGREES, integrated, legendre};
use super::{Factors, Sides};
use signorini_kernel::Tensor;
use signorini_kernel::element::rannacher_turek::place;
use signorini_problem::quadrature::Point;

/// Legendre's polynomials and their integrals at a point of a rule.
type Table = ([f64; DEGREES], [f64; DEGREES]);

/// φ at opposite sides: P_n(ŷ) in φ_x at x̂ = 0 and 1, P_n(x̂) in φ_y at ŷ = 0 and 1.
struct Ends([[[f64; 2]; DEGREES]; 2]);

impl Ends {
    /// From what leaves through the sides, each in its own direction: those at x̂ = 0 and ŷ = 1 run backwards.
    fn of([below, right, above, left]: &Sides) -> Self {
        let sign = |n: usize| if n.is_multiple_of(2) { 1.0 } else { -1.0 };
        let of_x = |n: usize| [-sign(n) * left[n], right[n]];
        let of_y = |n: usize| [-below[n], sign(n) * above[n]];
        Self([std::array::from_fn(of_x), std::array::from_fn(of_y)])
    }

    /// The amount that the ends add to the factor of P_n(ŷ) in the divergence, or of P_n(x̂).
    fn rise(&self, axis: usize, n: usize) -> f64 {
        self.0[axis][n][1] - self.0[axis][n][0]
    }

    /// Linear between both ends, at the point t of the way and with P_n beside it.
    fn at(&self, axis: usize, t: f64, beside: &[f64; DEGREES]) -> f64 {
        let ends = self.0[axis].iter().zip(beside);
        ends.skip(1).map(|([a, b], p)| ((1.0 - t) * a + t * b) * p).sum()
    }
}

/// ‖A^{−½}ρ‖² and the factors of both parts of ∇·ρ on a quad, `metric` being A⁻¹.
pub(super) fn fitted(
    corners: [[f64; 2]; 4],
    metric: &Tensor<f64>,
    rule: &[[f64; 2]],
    mut factors: Factors<f64>,
    sides: &Sides,
) -> (f64, Box<Factors<[f64; 2]>>) {
    let (tables, ends) = (tables(rule), Ends::of(sides));
    (1..DEGREES).for_each(|n| factors[0][n] -= ends.rise(0, n));
    (1..DEGREES).for_each(|n| factors[n][0] -= ends.rise(1, n));
    let [square, cross, added] = squares(corners, metric, (rule, &tables), &factors, &ends);
    let theta = if added > 0.0 { -cross / added } else { 0.0 };
    let split = |i: usize, j: usize| match (i, j) {
        (0, 0) => [0.0; 2],
        (_, 0) => [factors[i][0], ends.rise(1, i)],
        (0, _) => [ends.rise(0, j), factors[0][j]],
        _ => [theta * factors[i][j], (1.0 - theta) * factors[i][j]],
    };
    let split = std::array::from_fn(|i| std::array::from_fn(|j| split(i, j)));
    (square + theta * (2.0 * cross + theta * added), Box::new(split))
}

/// Square of ρ with θ = 0, its product with what θ adds, and the square of that.
fn squares(
    corners: [[f64; 2]; 4],
    metric: &Tensor<f64>,
    (rule, tables): (&[[f64; 2]], &[Table]),
    factors: &Factors<f64>,
    ends: &Ends,
) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let sum = |of: &dyn Fn(usize) -> f64| (1..DEGREES).map(of).sum::<f64>();
    for ([y, weight_y], (p_y, i_y)) in rule.iter().zip(tables) {
        let along: [_; DEGREES] = std::array::from_fn(|i| sum(&|j| factors[i][j] * p_y[j]));
        let across: [_; DEGREES] = std::array::from_fn(|i| sum(&|j| factors[i][j] * i_y[j]));
        for ([x, weight_x], (p_x, i_x)) in rule.iter().zip(tables) {
            let own = [
                sum(&|i| factors[i][0] * i_x[i]) + ends.at(0, *x, p_y),
                across[0] + ends.at(1, *y, p_x),
            ];
            let shared = [sum(&|i| along[i] * i_x[i]), sum(&|i| across[i] * p_x[i])];
            let here = place(corners, [*x, *y]);
            let [by_x, by_y] = here.directions();
            let image = |v: [f64; 2]| [0, 1].map(|k| v[0] * by_x[k] + v[1] * by_y[k]);
            let first = image([own[0], own[1] + shared[1]]);
            let more = image([shared[0], -shared[1]]);
            let weight = weight_y * weight_x / here.determinant;
            let products = [(first, first), (first, more), (more, more)];
            let products = products.map(|(v, w)| weight * product(metric, v, w));
            sums.iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
        }
    }
    sums
}

fn tables(rule: &[[f64; 2]]) -> Vec<Table> {
    rule.iter().map(|[t, _]| (legendre(*t), integrated(*t))).collect()
}

/// c_ij, but for c_00: the mean, which is 0.
pub(super) fn of_values(rule: &[[f64; 2]], points: &[Point], values: &[f64]) -> Factors<f64> {
    let tables = tables(rule);
    let mut factors = [[0.0; DEGREES]; DEGREES];
    let rows = points.chunks(rule.len()).zip(values.chunks(rule.len()));
    for ((points, values), (p_y, _)) in rows.zip(&tables) {
        let mut along = [0.0; DEGREES];
        for ((point, value), (p_x, _)) in points.iter().zip(values).zip(&tables) {
            let share = point.weight * value;
            along.iter_mut().zip(p_x).for_each(|(sum, p)| *sum += share * p);
        }
        for (i, row) in factors.iter_mut().enumerate() {
            row.iter_mut().zip(p_y).for_each(|(sum, p)| *sum += along[i] * p);
        }
    }
    for (i, row) in factors.iter_mut().enumerate() {
        let norm = |n: usize| (2 * n + 1) as f64;
        row.iter_mut().enumerate().for_each(|(j, factor)| *factor *= norm(i) * norm(j));
    }
    factors[0][0] = 0.0;
    factors
}
