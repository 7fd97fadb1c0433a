//! Energy, contact force and contact length of an exact solution, by quadrature on a mesh of its domain.

use signorini_kernel::mesh::geometry::scaled_normal;

use super::{EXACT, Facts};
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::{Conductivity, apply, dot, product};
use signorini_certify::sampled::Sampled;
use signorini_problem::pointwise::{POINTS, exact_at};
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_problem::{Problem, Sum};
use signorini_scene::Result;
use signorini_scene::scene::{Exact, Field};

/// Panels on a contact edge, each with 8 points: 256 samples find where contact ends.
const PANELS: u32 = 32;

/// Contact is where u − ψ is at most this part of the largest |u| or |ψ| on C. An exact solution as an
/// expression is off by rounding, and leaves ψ like d^{3/2} or d³ at a distance d from contact: the
/// length comes out too long by less than 10⁻³.
const TOUCHING: f64 = 1e-10;

/// The facts of an exact solution, `u` inside the cells.
pub(super) fn facts(exact: &Exact, u: &impl Sampled, problem: &Problem) -> Result<Facts> {
    let [force, length] = contact(exact, problem)?;
    Ok(Facts { words: EXACT.to_owned(), energy: energy(u, problem)?, force, length })
}

/// ‖A^½∇u‖
fn energy(u: &impl Sampled, problem: &Problem) -> Result<f64> {
    let rule = gauss(POINTS);
    let mut square = 0.0;
    for at in 0..problem.cells() {
        let conductivity = Conductivity::of(problem, at);
        let points = Cell::of(problem, at).points(&rule);
        for (point, u) in points.iter().zip(u.on_cell(at, &points)?.iter()) {
            let a = conductivity.at(point.x);
            square += point.weight * product(&a, u.gradient, u.gradient);
        }
    }
    Ok(square.sqrt())
}

/// ∫_C (σ·n − q), and the length of the part of C where u = ψ.
fn contact(exact: &Exact, problem: &Problem) -> Result<[f64; 2]> {
    let counts = problem.topology.counts;
    let rule = on_panels(PANELS, &gauss(8));
    let mut samples = Samples::default();
    for edge in counts.free..counts.unknowns() {
        samples.add_edge(exact, problem, edge, &rule)?;
    }
    let threshold = TOUCHING * samples.largest;
    let touching = samples.openings.iter().filter(|[opening, _]| *opening <= threshold);
    Ok([samples.force, touching.map(|[_, length]| length).sum()])
}

/// Sums and values over the points of C.
#[derive(Default)]
struct Samples {
    force: f64,
    /// u − ψ, and the element of length that it holds for.
    openings: Vec<[f64; 2]>,
    /// The largest |u| or |ψ|.
    largest: f64,
}

impl Samples {
    fn add_edge(
        &mut self,
        exact: &Exact,
        problem: &Problem,
        edge: usize,
        rule: &[[f64; 2]],
    ) -> Result<()> {
        let data = |field| Sum::on_edge(problem, edge, field);
        let (Some(q), Some(gap)) = (data(Field::Flux), data(Field::Gap)) else { return Ok(()) };
        let (length, [a, b]) = (problem.lengths[edge], problem.segment(edge));
        // As long as the edge, and outward.
        let normal: [f64; 2] = scaled_normal(a, b).into();
        let conductivity = Conductivity::of(problem, problem.topology.first_side(edge).0);
        for &[t, weight] in rule {
            let x = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
            let (u, gradient) = exact_at(&problem.scene, exact, x, problem.time)?;
            let (q, psi) = (q.finite_at(x)?, gap.finite_at(x)?);
            let sigma = dot(apply(&conductivity.at(x), gradient), normal);
            self.force += weight * (sigma - length * q);
            self.openings.push([u - psi, weight * length]);
            self.largest = self.largest.max(u.abs()).max(psi.abs());
        }
        Ok(())
    }
}
