//! Fluxes inside a cell that carry what the mean of a flux leaves out along one of its sides.
//!
//! On E = ab, with w′ = |E| (g − ḡ) and w = 0 at both ends, v = (1 − η) w(t) on the triangle K of E and any apex c in the cell is
//! w on E and 0 on the other sides of K ([`super::cell`]). ρ = ∇v, turned by 90°, has no divergence, ρ·n = g − ḡ on E and 0 on the
//! other sides, and
//! ```text
//!   ‖A^{−½}ρ‖² = |K|/det A ∫₀¹ |w′∇λ_b + (t w′ − w)∇λ_c|²_A dt
//!              = ½ I₁ (σ + ((τ − t₀)² + s²)/σ)/√det A,    t₀ = I₂/I₁,  s² = I₃/I₁ − t₀²,
//! ```
//! where I₁, I₂ and I₃ are the integrals of w′², w′(t w′ − w) and (t w′ − w)², and c is at the height σ|E| above the point τ of E, in
//! the metric of A⁻¹. The best apex is at the height s above t₀; ρ takes the point nearest to it on two ways through the cell, that
//! along A n and that towards its middle.
//!
//! w′ is piecewise polynomial; the trace inequality takes the rest.

use signorini_kernel::Tensor;
use signorini_kernel::mesh::geometry::triangle_area;

use super::cell::Cell;
use super::conductivity::{apply, dot, inverse, product};
use super::legendre::{DEGREES, integrated, legendre};
use super::weighed::minus;

/// ρ on one side of a cell.
#[derive(Debug, Clone)]
pub struct EdgeFlux {
    /// ‖A^{−½}ρ‖; infinite where no apex was found.
    pub norm: f64,
    /// By parts of the edge, the factors of Legendre's polynomials in w′/|E|.
    parts: Vec<[f64; DEGREES]>,
}

impl EdgeFlux {
    /// The flux for a side from a to b. `differences` has g − ḡ at the points of `rule` on so many equal `parts` of it; `a` is
    /// below A all over the cell.
    pub fn fitted(
        (cell, [start, end]): (&Cell, [[f64; 2]; 2]),
        a: &Tensor<f64>,
        (parts, rule): (usize, &[[f64; 2]]),
        differences: &[f64],
    ) -> Self {
        let mut parts: Vec<_> =
            (0..parts).map(|at| factors(rule, &differences[at * rule.len()..])).collect();
        let mean = parts.iter().map(|part| part[0]).sum::<f64>() / parts.len() as f64;
        parts.iter_mut().for_each(|part| part[0] -= mean);
        let found = Self { norm: f64::INFINITY, parts };
        let along = minus(end, start);
        let integrals @ [first, second, _] = found.integrals(rule, dot(along, along));
        if first == 0.0 {
            return Self { norm: 0.0, ..found };
        }
        let foot = (second / first).clamp(0.0, 1.0);
        let from = [0, 1].map(|k| start[k] + foot * along[k]);
        let targets = [exit(cell, from, apply(a, [-along[1], along[0]])), cell.middle()];
        let norms = targets.map(|target| best(integrals, a, ([start, end], foot), target).0);
        Self { norm: norms.into_iter().fold(found.norm, f64::min), ..found }
    }

    /// w/|E| and w′/|E| at t.
    pub fn at(&self, t: f64) -> [f64; 2] {
        let count = self.parts.len();
        let at = ((t * count as f64) as usize).min(count - 1);
        let own = t * count as f64 - at as f64;
        let sum = |all: [f64; DEGREES]| dot_all(&self.parts[at], &all);
        let before: f64 = self.parts[..at].iter().map(|part| part[0]).sum();
        [(before + sum(integrated(own))) / count as f64, sum(legendre(own))]
    }

    /// The largest |w′|/|E| where t is complex and in the ellipse of `rho` around a part: there |P_n| ≤ rhoⁿ.
    pub fn modulus(&self, rho: f64) -> f64 {
        let of_part = |part: &[f64; DEGREES]| -> f64 {
            part.iter().enumerate().map(|(n, factor)| factor.abs() * rho.powi(n as i32)).sum()
        };
        self.parts.iter().map(of_part).fold(0.0, f64::max)
    }

    /// I₁, I₂ and I₃, the square of |E| being given.
    fn integrals(&self, rule: &[[f64; 2]], square: f64) -> [f64; 3] {
        let (mut sums, width) = ([0.0; 3], 1.0 / self.parts.len() as f64);
        for part in 0..self.parts.len() {
            for [t, weight] in rule {
                let t = width * (part as f64 + t);
                let [w, slope] = self.at(t);
                let rest = t * slope - w;
                let terms = [slope * slope, slope * rest, rest * rest];
                sums.iter_mut().zip(terms).for_each(|(sum, x)| *sum += square * width * weight * x);
            }
        }
        sums
    }
}

/// Factors of g on a part of an edge, from its values at the points of a rule.
fn factors(rule: &[[f64; 2]], values: &[f64]) -> [f64; DEGREES] {
    let mut factors = [0.0; DEGREES];
    for ([t, weight], value) in rule.iter().zip(values) {
        let p = legendre(*t);
        (0..DEGREES).for_each(|n| factors[n] += (2 * n + 1) as f64 * weight * value * p[n]);
    }
    factors
}

fn dot_all(a: &[f64; DEGREES], b: &[f64; DEGREES]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Where a way from a point of a convex cell leaves it.
fn exit(cell: &Cell, from: [f64; 2], towards: [f64; 2]) -> [f64; 2] {
    let corners = cell.corners();
    let reach = (0..corners.len()).map(|at| {
        let (p, side) = (corners[at], minus(corners[(at + 1) % corners.len()], corners[at]));
        let outward = [side[1], -side[0]];
        let speed = dot(outward, towards);
        if speed > 0.0 { dot(outward, minus(p, from)) / speed } else { f64::INFINITY }
    });
    let reach = reach.fold(f64::INFINITY, f64::min).max(0.0);
    [0, 1].map(|k| from[k] + reach * towards[k])
}

/// The best apex between the point `foot` of an edge and `target`, and ‖A^{−½}ρ‖ for it.
fn best(
    [first, second, third]: [f64; 3],
    a: &Tensor<f64>,
    ([start, end], foot): ([[f64; 2]; 2], f64),
    target: [f64; 2],
) -> (f64, [f64; 2]) {
    let (metric, along) = (inverse(a), minus(end, start));
    let root = (a.xx * a.yy - a.xy * a.xy).sqrt();
    let square = product(&metric, along, along);
    let height = 2.0 * triangle_area([start, end, target]) / (root * square);
    let beside = product(&metric, minus(target, start), along) / square - foot;
    let off = foot - second / first;
    let spread = (third / first - (second / first).powi(2)).max(0.0);
    // Of σ + ((τ − t₀)² + s²)/σ with both in proportion; no part of the way is wrong.
    let part = ((spread + off * off) / (height * height + beside * beside)).sqrt().min(1.0);
    let (sigma, tau) = (part * height, off + part * beside);
    let norm = (0.5 * first * (sigma + (tau * tau + spread) / sigma) / root).sqrt();
    let apex = [0, 1].map(|k| {
        let from = start[k] + foot * along[k];
        from + part * (target[k] - from)
    });
    (norm, apex)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::quadrature::{gauss, on_panels};
    use signorini_tolerances::solve::LOCAL_FLUX;

    const OBLIQUE: Tensor<f64> = Tensor { xx: 40.0, xy: 17.0, yy: 9.0 };
    const CORNERS: [[f64; 2]; 4] = [[0.1, 0.0], [3.0, 0.3], [2.2, 1.1], [-0.3, 0.6]];

    fn wave(t: f64) -> f64 {
        (3.0 * t).sin() - (1.0 - 3.0_f64.cos()) / 3.0
    }

    fn fit(a: &Tensor<f64>, side: usize) -> (EdgeFlux, [[f64; 2]; 2]) {
        let (rule, segment) = (gauss(16), [CORNERS[side], CORNERS[(side + 1) % 4]]);
        let values: Vec<_> = on_panels(4, &rule).iter().map(|[t, _]| wave(*t)).collect();
        (EdgeFlux::fitted((&Cell::Quad(CORNERS), segment), a, (4, &rule), &values), segment)
    }

    /// On the triangle of an apex ρ is ∇v, turned: its norm by quadrature is that of the formula, and its flux through the side
    /// is g − ḡ.
    #[test]
    fn the_norm_is_that_of_the_turned_gradient() {
        for side in 0..4 {
            let (flux, [a, b]) = fit(&OBLIQUE, side);
            let along = minus(b, a);
            let integrals = flux.integrals(&gauss(16), dot(along, along));
            for target in [[0.9, 0.5], [1.7, 0.8]] {
                let (norm, apex) = best(integrals, &OBLIQUE, ([a, b], 0.4), target);
                let (cell, metric) = (Cell::Triangle([a, b, apex]), inverse(&OBLIQUE));
                let length = dot(along, along).sqrt();
                let rho = |reference| {
                    let side = cell.local(reference).sides[0];
                    let [w, slope] = flux.at(side.t).map(|w| length * w);
                    let [x, y] = side.extension(w, slope).gradient;
                    [-y, x]
                };
                let mut square = 0.0;
                for panel in on_panels(8, &gauss(8)) {
                    for height in gauss(8) {
                        let reference = cell.side_point(0, panel[0], height[0]);
                        let area = cell.area_element(&cell.local(reference), height[0]);
                        let here = rho(reference);
                        square += panel[1] * height[1] * area * product(&metric, here, here);
                    }
                }
                LOCAL_FLUX.check_relative(format_args!("{side}"), norm, square.sqrt());
                for t in [0.1, 0.3, 0.77] {
                    // Outward on the right of the way from a to b.
                    let [x, y] = rho(cell.side_point(0, t, 0.0));
                    let through = (x * along[1] - y * along[0]) / length;
                    let [_, own] = flux.at(t);
                    assert!((own - wave(t)).abs() < 1e-8, "{t}: {own} {}", wave(t));
                    LOCAL_FLUX.check(format_args!("{side} at {t}"), through.abs() - own.abs());
                    let [p, q] = [1, 2].map(|side| rho(cell.side_point(side, t, 1e-13)));
                    let [to_apex, back] = [minus(apex, b), minus(a, apex)];
                    LOCAL_FLUX.check("beside", p[0] * to_apex[1] - p[1] * to_apex[0]);
                    LOCAL_FLUX.check("beside", q[0] * back[1] - q[1] * back[0]);
                }
            }
        }
    }

    /// The best of many apexes in the cell is hardly better.
    #[test]
    fn the_apex_is_nearly_the_best_one() {
        let strong = Tensor { xx: 1e4, xy: 0.0, yy: 1.0 };
        for (a, side) in [(OBLIQUE, 0), (OBLIQUE, 1), (strong, 0), (strong, 1), (strong, 3)] {
            let (flux, [start, end]) = fit(&a, side);
            let along = minus(end, start);
            let integrals = flux.integrals(&gauss(16), dot(along, along));
            let mut least = f64::INFINITY;
            for point in Cell::Quad(CORNERS).points(&gauss(40)) {
                for foot in [0.1, 0.3, 0.5, 0.7, 0.9] {
                    least = least.min(best(integrals, &a, ([start, end], foot), point.x).0);
                }
            }
            assert!(flux.norm < 1.2 * least, "{side}: {} {least}", flux.norm);
        }
    }
}
