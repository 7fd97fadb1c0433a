//! Quadrature in physical coordinates: edges, triangles, quads, as the scene file's contract fixes it.
//!
//! Edges take 8 Gauss points, quads 8×8 through the bilinear map. Triangles take n×n Gauss points
//! through the collapsed square, (x̂, ŷ) ↦ a + x̂ (1 − ŷ)(b − a) + ŷ (c − a): exact to degree 2n − 2.

pub mod bisected;
pub mod enclosed;
pub mod refined;

use std::sync::OnceLock;

use signorini_kernel::Real;
use signorini_kernel::element::rannacher_turek::place;

/// Points a direction for data on edges and quads.
pub const DATA_POINTS: usize = 8;
/// Points a direction for data on triangles: exact to degree 10.
pub const TRIANGLE_POINTS: usize = 6;

/// A Gauss–Legendre rule on \[0, 1\] with any number of points: (point, weight).
///
/// The points are the zeros of P_n, by Newton's iteration from their asymptotic positions; rules that are asked for in every cell
/// are worked out once.
pub fn gauss(points: usize) -> Vec<[f64; 2]> {
    const KNOWN: usize = 17;
    static RULES: [OnceLock<Vec<[f64; 2]>>; KNOWN] = [const { OnceLock::new() }; KNOWN];
    match RULES.get(points) {
        Some(rule) => rule.get_or_init(|| roots(points)).clone(),
        None => roots(points),
    }
}

fn roots(points: usize) -> Vec<[f64; 2]> {
    let n = points as f64;
    let root = |k: usize| {
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (value, previous) = legendre(points, x);
            slope = n * (x * value - previous) / (x * x - 1.0);
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        [0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..points).map(root).collect()
}

/// A rule on \[0, 1\] repeated on equal panels: for integrands with a kink somewhere.
pub fn on_panels(panels: u32, rule: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let width = 1.0 / f64::from(panels);
    let shifted = |panel: u32| {
        rule.iter().map(move |[t, weight]| [width * (f64::from(panel) + t), width * weight])
    };
    (0..panels).flat_map(shifted).collect()
}

/// (P_n, P_{n−1}) at x by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut value, mut previous) = (1.0, 0.0);
    for k in 0..n {
        let k = k as f64;
        (value, previous) = (((2.0 * k + 1.0) * x * value - k * previous) / (k + 1.0), value);
    }
    (value, previous)
}

/// A point of a cell: where it is, its reference coordinates, and its weight (an area).
#[derive(Debug, Clone, Copy)]
pub struct Point {
    /// Physical coordinates.
    pub x: [f64; 2],
    /// Barycentric coordinates (triangles) or (x̂, ŷ, 0) (quads).
    pub reference: [f64; 3],
    /// Quadrature weight times area element.
    pub weight: f64,
}

/// The points of a triangle under a one-dimensional rule.
pub fn on_triangle<'r>(
    [a, b, c]: [[f64; 2]; 3],
    rule: &'r [[f64; 2]],
) -> impl Iterator<Item = Point> + 'r {
    let doubled = signorini_kernel::mesh::geometry::doubled_area(a, b, c);
    rule.iter().flat_map(move |&[y, weight_y]| {
        rule.iter().map(move |&[x, weight_x]| {
            let (l1, l2) = (x * (1.0 - y), y);
            let l0 = (1.0 - x) * (1.0 - y);
            let at = |k: usize| l0 * a[k] + l1 * b[k] + l2 * c[k];
            let weight = weight_x * weight_y * (1.0 - y) * doubled;
            Point { x: [at(0), at(1)], reference: [l0, l1, l2], weight }
        })
    })
}

/// The points of a quad under a one-dimensional rule, x̂ running fastest.
pub fn on_quad<'r>(quad: [[f64; 2]; 4], rule: &'r [[f64; 2]]) -> impl Iterator<Item = Point> + 'r {
    rule.iter().flat_map(move |&[y, weight_y]| {
        rule.iter().map(move |&[x, weight_x]| {
            let here = place(quad, [x, y]);
            let weight = weight_x * weight_y * here.determinant;
            Point { x: here.x, reference: [x, y, 0.0], weight }
        })
    })
}

/// The mean of `f` over the segment from `a` to `b`, by 8 Gauss points.
pub fn mean_on_edge([a, b]: [[f64; 2]; 2], mut f: impl FnMut(f64, f64) -> f64) -> f64 {
    let at = |t: f64, k: usize| a[k] + t * (b[k] - a[k]);
    f64::GAUSS[DATA_POINTS - 1].iter().map(|&[t, weight]| weight * f(at(t, 0), at(t, 1))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::solve::RULE;

    #[test]
    fn gauss_rules_integrate_their_degree_and_no_more() {
        for points in 1..=20 {
            let rule = gauss(points);
            let integral = |degree: i32| rule.iter().map(|[x, w]| w * x.powi(degree)).sum::<f64>();
            for degree in 0..2 * points as i32 {
                let exact = 1.0 / (f64::from(degree) + 1.0);
                RULE.check(format_args!("{points} points, x^{degree}"), integral(degree) - exact);
            }
            if points < 8 {
                let degree = 2 * points as i32;
                let exact = 1.0 / (f64::from(degree) + 1.0);
                assert!((integral(degree) - exact).abs() > 1e-11, "{points} points, x^{degree}");
            }
        }
    }

    #[test]
    fn the_kernels_tables_are_these_rules() {
        for points in 1..=8 {
            for (table, rule) in f64::GAUSS[points - 1].iter().zip(gauss(points)) {
                RULE.check_each("kernel's table", table, &rule);
            }
        }
    }

    #[test]
    fn cells_integrate_monomials() {
        let triangle = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
        let moment: f64 =
            on_triangle(triangle, &gauss(6)).map(|p| p.weight * p.x[0] * p.x[0] * p.x[1]).sum();
        // ∫ x²y over the triangle with legs a = 2, b = 1 is a³b² 2!·1!/5!.
        RULE.check("a moment", moment - 8.0 * 2.0 / 120.0);
        let quad = [[0.0, 0.0], [2.0, 0.0], [1.5, 1.0], [0.0, 1.0]];
        let area: f64 = on_quad(quad, &gauss(8)).map(|p| p.weight).sum();
        RULE.check("an area", area - 1.75);
    }
}
