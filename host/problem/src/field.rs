//! u_h and σ_h inside the cells, from edge means and edge fluxes.

use signorini_kernel::element::{QuadElement, crouzeix_raviart, rannacher_turek};
use signorini_kernel::mesh::geometry::doubled_area;

use crate::Problem;

/// The discrete solution on one cell.
#[derive(Debug, Clone, Copy)]
pub enum CellField {
    /// Corners, means of u_h over the sides, outward fluxes through the sides.
    Triangle([[f64; 2]; 3], [f64; 3], [f64; 3]),
    /// Corners of a quad, means of u_h over the sides, outward fluxes through the sides, and its element.
    Quad([[f64; 2]; 4], [f64; 4], [f64; 4], QuadElement),
}

/// u_h, its gradient and σ_h at one point.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// u_h
    pub u: f64,
    /// ∇u_h
    pub gradient: [f64; 2],
    /// σ_h
    pub flux: [f64; 2],
}

impl CellField {
    /// The field on cell `cell` (triangles first): `u` holds edge means, `flux` ∫_E σ·n along the
    /// direction of each edge.
    pub fn new(problem: &Problem, cell: usize, u: &[f64], flux: &[f64]) -> Self {
        let corner = |vertex: u32| problem.mesh.vertices[vertex as usize];
        let triangles = problem.mesh.triangles.len();
        let outward = |edge: u32, half: usize| {
            let first = problem.topology.half_edges[edge as usize][0] as usize == half;
            if first { flux[edge as usize] } else { -flux[edge as usize] }
        };
        if cell < triangles {
            let edges = problem.topology.of_triangles[cell];
            let fluxes = std::array::from_fn(|k| outward(edges[k], 3 * cell + k));
            let means = edges.map(|edge| u[edge as usize]);
            Self::Triangle(problem.mesh.triangles[cell].map(corner), means, fluxes)
        } else {
            let at = cell - triangles;
            let edges = problem.topology.of_quads[at];
            let fluxes = std::array::from_fn(|k| outward(edges[k], 3 * triangles + 4 * at + k));
            let means = edges.map(|edge| u[edge as usize]);
            Self::Quad(problem.mesh.quads[at].map(corner), means, fluxes, problem.element)
        }
    }

    /// Values at a point given by its place and its reference coordinates.
    pub fn sample(&self, point: &crate::quadrature::Point) -> Sample {
        match *self {
            Self::Triangle(corners, means, fluxes) => {
                let basis = crouzeix_raviart::basis(point.reference);
                let gradient = crouzeix_raviart::gradient(corners, means);
                let flux = crouzeix_raviart::raviart_thomas(corners, fluxes, point.x);
                Sample { u: dot(basis, means), gradient: gradient.into(), flux: flux.into() }
            }
            Self::Quad(corners, means, fluxes, element) => {
                let [x, y, _] = point.reference;
                Sample {
                    u: dot(element.basis(corners, [x, y]), means),
                    gradient: element.gradient(corners, [x, y], means).into(),
                    flux: rannacher_turek::place(corners, [x, y]).raviart_thomas(fluxes).into(),
                }
            }
        }
    }

    /// Reference coordinates of a point, where it lies in the cell (with a rounding's width around it).
    pub fn locate(&self, x: [f64; 2]) -> Option<[f64; 3]> {
        const SLACK: f64 = 1e-12;
        match *self {
            Self::Triangle([a, b, c], _, _) => {
                let whole = doubled_area(a, b, c);
                let parts = [doubled_area(x, b, c), doubled_area(a, x, c), doubled_area(a, b, x)];
                let lambda = parts.map(|part| part / whole);
                lambda.iter().all(|&part| part >= -SLACK).then_some(lambda)
            }
            Self::Quad(corners, ..) => {
                let reference = inverse_bilinear(corners, x);
                let inside = |t: f64| (-SLACK..=1.0 + SLACK).contains(&t);
                let [s, t] = reference;
                (inside(s) && inside(t)).then_some([s, t, 0.0])
            }
        }
    }

    /// σ_h in the middle.
    pub fn middle_flux(&self) -> [f64; 2] {
        match *self {
            Self::Triangle([a, b, c], _, fluxes) => {
                crouzeix_raviart::raviart_thomas([a, b, c], fluxes, self.middle()).into()
            }
            Self::Quad(corners, _, fluxes, _) => {
                rannacher_turek::place(corners, [0.5; 2]).raviart_thomas(fluxes).into()
            }
        }
    }

    /// Its middle.
    pub fn middle(&self) -> [f64; 2] {
        match *self {
            Self::Triangle([a, b, c], ..) => [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0),
            Self::Quad(corners, ..) => rannacher_turek::place(corners, [0.5; 2]).x,
        }
    }

    /// Means of u_h and outward fluxes, side by side.
    fn sides(&self) -> [&[f64]; 2] {
        match self {
            Self::Triangle(_, means, fluxes) => [means, fluxes],
            Self::Quad(_, means, fluxes, _) => [means, fluxes],
        }
    }

    /// The mean of the edge means.
    pub fn mean(&self) -> f64 {
        let [means, _] = self.sides();
        means.iter().sum::<f64>() / means.len() as f64
    }

    /// Σ_E ∫σ·n + ∫f, with ∫f = `load`: 0 for a cell in balance.
    pub fn surplus(&self, load: f64) -> f64 {
        let [_, fluxes] = self.sides();
        fluxes.iter().sum::<f64>() + load
    }

    /// ∫A∇u_h·∇u_h of a cell in balance: Σ_E u_E (∫_E σ·n + ∫f/m), because ∫A∇u_h·∇φ_E stands in brackets.
    pub fn energy(&self, load: f64) -> f64 {
        let ([means, fluxes], mean) = (self.sides(), self.mean());
        let share = load / means.len() as f64;
        // The brackets add up to the surplus, so that the mean may be left out: less cancels.
        means.iter().zip(fluxes).map(|(u, out)| (u - mean) * (out + share)).sum()
    }
}

/// F⁻¹ on a convex quad by Newton's iteration from the middle; far outside it may not converge, and
/// then returns a point outside.
fn inverse_bilinear(corners: [[f64; 2]; 4], x: [f64; 2]) -> [f64; 2] {
    let [a, b, c, d] = corners;
    let mut at = [0.5; 2];
    for _ in 0..30 {
        let here = rannacher_turek::place(corners, at).x;
        let along = |k: usize, t: f64| (b[k] - a[k]) * (1.0 - t) + (c[k] - d[k]) * t;
        let across = |k: usize, s: f64| (d[k] - a[k]) * (1.0 - s) + (c[k] - b[k]) * s;
        let (sx, sy) = (along(0, at[1]), along(1, at[1]));
        let (tx, ty) = (across(0, at[0]), across(1, at[0]));
        let (rx, ry) = (x[0] - here[0], x[1] - here[1]);
        let determinant = sx * ty - sy * tx;
        let step = [(rx * ty - ry * tx) / determinant, (sx * ry - sy * rx) / determinant];
        at = [at[0] + step[0], at[1] + step[1]];
        if step[0].abs().max(step[1].abs()) < 1e-14 || !at[0].is_finite() {
            break;
        }
    }
    at
}

fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
