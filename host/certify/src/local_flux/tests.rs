//! Fluxes inside cells against their definition.

use super::*;
use crate::legendre::integrated;
use crate::profile::NO_SIDES;
use signorini_kernel::element::rannacher_turek::place;
use signorini_problem::quadrature::gauss;
use signorini_tolerances::solve::{LOCAL_FLUX, OSCILLATION};

const OBLIQUE: Tensor<f64> = Tensor { xx: 40.0, xy: 17.0, yy: 9.0 };
const TRIANGLE: Cell = Cell::Triangle([[0.2, -0.1], [3.0, 0.4], [0.9, 0.7]]);
const QUAD: Cell = Cell::Quad([[0.1, 0.0], [3.0, 0.3], [2.2, 1.1], [-0.3, 0.6]]);

fn fit(
    cell: &Cell,
    a: &Tensor<f64>,
    f: impl Fn([f64; 2]) -> f64,
    sides: &Sides,
) -> (LocalFlux, f64) {
    let rule = gauss(16);
    let points = cell.points(&rule);
    let [load, area] = points.iter().fold([0.0; 2], |[load, area], point| {
        [load + point.weight * f(point.x), area + point.weight]
    });
    let value = |point: &Point| match cell {
        Cell::Triangle(_) => f(point.x) - load / area,
        Cell::Quad(_) => f(point.x) - load / cell.determinant(point.reference),
    };
    let values: Vec<_> = points.iter().map(value).collect();
    let flux = LocalFlux::fitted(cell, a, &rule, (&points, &values), sides);
    let rest = |point: &Point, value: &f64| {
        let determinant = cell.determinant(point.reference);
        point.weight * (value - flux.divergence(point.reference, determinant)).powi(2)
    };
    let rest: f64 = points.iter().zip(&values).map(|(point, value)| rest(point, value)).sum();
    (flux, rest.sqrt())
}

impl LocalFlux {
    /// ρ by its formula.
    fn field(&self, cell: &Cell, reference: [f64; 3], sides: &Sides) -> [f64; 2] {
        match (&self.divergence, cell) {
            (Divergence::Triangle(k), Cell::Triangle(corners)) => {
                let term = |i: usize, axis: usize| {
                    let [j, l] = [(i + 1) % 3, (i + 2) % 3];
                    let side = corners[l][axis] - corners[j][axis];
                    k[i] * reference[j] * reference[l] * side
                };
                [0, 1].map(|axis| (0..3).map(|i| term(i, axis)).sum())
            }
            (Divergence::Quad(factors), Cell::Quad(corners)) => {
                let [x, y] = [reference[0], reference[1]];
                let mut phi = [0.0; 2];
                for i in 0..DEGREES {
                    for j in 0..DEGREES {
                        phi[0] += factors[i][j][0] * integrated(x)[i] * legendre(y)[j];
                        phi[1] += factors[i][j][1] * legendre(x)[i] * integrated(y)[j];
                    }
                }
                // Backwards through the left side, and inwards; upwards through the lower one.
                for (into, side, at) in [(0, sides[3], 1.0 - y), (1, sides[0], x)] {
                    let sum: f64 = side.iter().zip(legendre(at)).skip(1).map(|(s, p)| s * p).sum();
                    phi[into] -= sum;
                }
                let here = place(*corners, [x, y]);
                let [by_x, by_y] = here.directions();
                [0, 1].map(|k| (phi[0] * by_x[k] + phi[1] * by_y[k]) / here.determinant)
            }
            _ => panic!("another cell"),
        }
    }
}

/// ρ·n is 0 on the sides, or what is asked for, ∫ρ·∇v = −∫(∇·ρ) v for polynomials v, and the norm is that of ρ.
#[test]
fn fluxes_are_what_they_say() {
    let mut shaped = NO_SIDES;
    shaped.iter_mut().enumerate().for_each(|(k, side)| side[1 + k % 3] = 0.3 - 0.2 * k as f64);
    for (cell, sides) in [(TRIANGLE, NO_SIDES), (QUAD, NO_SIDES), (QUAD, shaped)] {
        let f = |[x, y]: [f64; 2]| x * x - 0.7 * x * y + 2.0 * y + x;
        let (flux, rest) = fit(&cell, &OBLIQUE, f, &sides);
        // A quadratic f is no linear one; on a quad it is a polynomial of its coordinates.
        assert_eq!(rest > 1e-3, matches!(cell, Cell::Triangle(_)), "{rest}");
        let corners = cell.corners();
        for side in 0..corners.len() {
            let [a, b] = [corners[side], corners[(side + 1) % corners.len()]];
            for t in [0.0, 0.1, 0.5, 0.8] {
                let rho = flux.field(&cell, cell.side_point(side, t, 0.0), &sides);
                let through = rho[0] * (b[1] - a[1]) - rho[1] * (b[0] - a[0]);
                let asked: f64 = sides[side].iter().zip(legendre(t)).map(|(q, p)| q * p).sum();
                LOCAL_FLUX.check(format_args!("side {side} at {t}"), through - asked);
            }
        }
        let mut norm = 0.0;
        let mut sums = [0.0; 10];
        let powers =
            [[1, 0], [0, 1], [2, 0], [1, 1], [0, 2], [3, 0], [2, 1], [1, 2], [0, 3], [0, 0]];
        let power = |x: f64, n: i32| if n < 0 { 0.0 } else { x.powi(n) };
        for (side, profile) in sides.iter().enumerate().take(corners.len()) {
            let [a, b] = [corners[side], corners[(side + 1) % corners.len()]];
            for [t, weight] in gauss(20) {
                let asked: f64 = profile.iter().zip(legendre(t)).map(|(q, p)| q * p).sum();
                let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
                for (sum, [m, n]) in sums.iter_mut().zip(powers) {
                    *sum -= weight * asked * power(x, m) * power(y, n);
                }
            }
        }
        for point in cell.points(&gauss(20)) {
            let local = cell.local(point.reference);
            let rho = flux.field(&cell, point.reference, &sides);
            norm += point.weight * product(&inverse(&OBLIQUE), rho, rho);
            let divergence = flux.divergence(point.reference, local.determinant);
            let [x, y] = point.x;
            for (sum, [m, n]) in sums.iter_mut().zip(powers) {
                let by_x = f64::from(m) * power(x, m - 1) * y.powi(n);
                let by_y = f64::from(n) * x.powi(m) * power(y, n - 1);
                let v = x.powi(m) * y.powi(n);
                *sum += point.weight * (rho[0] * by_x + rho[1] * by_y + divergence * v);
            }
        }
        LOCAL_FLUX.check("norm", norm.sqrt() - flux.norm);
        LOCAL_FLUX.check_each("by parts", &sums, &[0.0; 10]);
    }
}

/// On a rectangle f = x: ρ = ((x² − h²/4)/2, 0) and ‖A^{−½}ρ‖² = k h⁵/(120 A_xx).
#[test]
fn across_a_rectangle_it_is_the_primitive() {
    let a = Tensor { xx: 1e6, xy: 0.0, yy: 1.0 };
    let cell = Cell::Quad([[0.0, 0.0], [0.5, 0.0], [0.5, 0.25], [0.0, 0.25]]);
    let (flux, rest) = fit(&cell, &a, |[x, _]| x, &NO_SIDES);
    let expected = (0.25 * 0.5_f64.powi(5) / 120.0 / 1e6).sqrt();
    OSCILLATION.check_over("norm", flux.norm - expected, expected);
    OSCILLATION.check("rest", rest);
    // (½/10³)² + ¼²
    let reach = (0.25_f64.powi(2) + 0.25e-6).sqrt() / PI;
    OSCILLATION.check_over("reach", flux.reach - reach, reach);
}

/// Any other quadratic ρ of the same divergence has k with another common part, and is longer.
#[test]
fn on_a_triangle_no_quadratic_flux_is_shorter() {
    let (flux, _) = fit(&TRIANGLE, &OBLIQUE, |[x, y]| x - 3.0 * y, &NO_SIDES);
    let Divergence::Triangle(k) = flux.divergence else { panic!("a triangle") };
    for step in [-1e-3, 1e-3, 0.1] {
        let other = LocalFlux { divergence: Divergence::Triangle(k.map(|k| k + step)), ..flux };
        let points = TRIANGLE.points(&gauss(6));
        let norm = points.iter().map(|point| {
            let rho = other.field(&TRIANGLE, point.reference, &NO_SIDES);
            point.weight * product(&inverse(&OBLIQUE), rho, rho)
        });
        assert!(norm.sum::<f64>().sqrt() > flux.norm, "{step}");
    }
}
