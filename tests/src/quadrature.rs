//! Quadrature rules on the reference interval, triangle and square.

use crate::field::{Point, Scalar};

/// Points in [0, 1] with weights that sum to 1.
pub type Rule1 = Vec<(f64, f64)>;
/// Points of a reference cell with weights that sum to its area.
pub type Rule2 = Vec<(Point, f64)>;

/// The n-point Gauss–Legendre rule on [0, 1], exact up to degree 2n − 1.
///
/// The points are the roots of the Legendre polynomial P_n, found by Newton's iteration from
/// cos(π (i + 3/4) / (n + 1/2)); the weights on [−1, 1] are 2 / ((1 − x²) P_n'(x)²).
pub fn gauss_legendre(n: usize) -> Rule1 {
    (0..n)
        .map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            for _ in 0..10 {
                let (p, derivative) = legendre(n, x);
                x -= p / derivative;
            }
            let derivative = legendre(n, x).1;
            ((1.0 - x) / 2.0, 1.0 / ((1.0 - x * x) * derivative * derivative))
        })
        .collect()
}

/// P_n(x) and P_n'(x) for |x| < 1, by k P_k = (2k − 1) x P_{k−1} − (k − 1) P_{k−2}.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut p) = (0.0, 1.0);
    for k in 1..=n {
        let k = k as f64;
        (previous, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k);
    }
    (p, n as f64 * (x * p - previous) / (x * x - 1.0))
}

/// The n × n tensor rule on the unit square.
pub fn square(n: usize) -> Rule2 {
    let rule = gauss_legendre(n);
    let column = |(x, w): (f64, f64)| rule.iter().map(move |&(y, v)| ([x, y], w * v));
    rule.iter().copied().flat_map(column).collect()
}

/// Duffy's rule on the triangle (0,0), (1,0), (0,1): the square's rule through
/// (s, t) ↦ (s, (1 − s) t), whose Jacobian is 1 − s; exact up to degree 2n − 2.
pub fn triangle(n: usize) -> Rule2 {
    let collapse = |([s, t], w): (Point, f64)| ([s, (1.0 - s) * t], w * (1.0 - s));
    square(n).into_iter().map(collapse).collect()
}

/// The mean of f over the straight edge from a to b, with n Gauss points.
pub fn edge_mean(f: &Scalar, [a, b]: [Point; 2], n: usize) -> f64 {
    let point = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    gauss_legendre(n).into_iter().map(|(t, w)| w * f(point(t))).sum()
}

#[cfg(test)]
mod tests {
    use super::{gauss_legendre, square, triangle};
    use signorini_tolerances::twins::OWN_RULES;

    fn factorial(n: usize) -> f64 {
        (1..=n).map(|k| k as f64).product()
    }

    /// ∫₀¹ xᵈ = 1 / (d + 1) for d ≤ 2n − 1; degree 2n is missed by what theory says.
    #[test]
    fn gauss_is_exact_to_its_degree_and_no_further() {
        for n in 1..=20 {
            let moment = |d: usize| -> f64 {
                gauss_legendre(n).iter().map(|(x, w)| w * x.powi(d as i32)).sum()
            };
            for d in 0..2 * n {
                OWN_RULES
                    .check(format_args!("n {n}, degree {d}"), moment(d) - 1.0 / (d as f64 + 1.0));
            }
            let miss = factorial(n).powi(4) / ((2 * n + 1) as f64 * factorial(2 * n).powi(2));
            let missed = 1.0 / (2 * n + 1) as f64 - moment(2 * n);
            OWN_RULES.check(format_args!("n {n}"), missed - miss);
        }
    }

    #[test]
    fn square_and_triangle_integrate_monomials() {
        for (a, b) in (0..8).flat_map(|a| (0..8 - a).map(move |b| (a, b))) {
            let monomial = |[x, y]: [f64; 2]| x.powi(a as i32) * y.powi(b as i32);
            let on = |rule: Vec<([f64; 2], f64)>| -> f64 {
                rule.into_iter().map(|(p, w)| w * monomial(p)).sum()
            };
            let expected = 1.0 / ((a + 1) * (b + 1)) as f64;
            OWN_RULES.check("square", on(square(5)) - expected);
            let expected = factorial(a) * factorial(b) / factorial(a + b + 2);
            OWN_RULES.check("triangle", on(triangle(5)) - expected);
        }
    }
}
