//! u_h and σ_h inside the cells, from edge means and edge fluxes.

use signorini_kernel::element::{QuadElement, crouzeix_raviart, rannacher_turek};

use crate::Problem;
use crate::cell::Cell;

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
            Self::Triangle(corners, means, _) => {
                let basis = crouzeix_raviart::basis(point.reference);
                let gradient = crouzeix_raviart::gradient(corners, means);
                Sample { u: dot(basis, means), gradient: gradient.into(), flux: self.flux(point) }
            }
            Self::Quad(corners, means, _, element) => {
                let [x, y, _] = point.reference;
                Sample {
                    u: dot(element.basis(corners, [x, y]), means),
                    gradient: element.gradient(corners, [x, y], means).into(),
                    flux: self.flux(point),
                }
            }
        }
    }

    /// The Raviart–Thomas field at a point.
    pub fn flux(&self, point: &crate::quadrature::Point) -> [f64; 2] {
        match *self {
            Self::Triangle(corners, _, fluxes) => {
                crouzeix_raviart::raviart_thomas(corners, fluxes, point.x).into()
            }
            Self::Quad(corners, _, fluxes, _) => {
                let [x, y, _] = point.reference;
                rannacher_turek::place(corners, [x, y]).raviart_thomas(fluxes).into()
            }
        }
    }

    /// Reference coordinates of a point, where it lies in the cell (with a rounding's width around it).
    pub fn locate(&self, x: [f64; 2]) -> Option<[f64; 3]> {
        const SLACK: f64 = 1e-12;
        match *self {
            Self::Triangle(corners, ..) => {
                let lambda = Cell::Triangle(corners).reference(x);
                lambda.iter().all(|&part| part >= -SLACK).then_some(lambda)
            }
            Self::Quad(corners, ..) => {
                let reference = Cell::Quad(corners).reference(x);
                let inside = |t: &f64| (-SLACK..=1.0 + SLACK).contains(t);
                reference.iter().all(inside).then_some(reference)
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

    /// Σ_E ∫σ·n + ∫f, with ∫f = `load`, less what the cell stores by its sides in a step of time: 0 for a cell in balance.
    pub fn surplus(&self, load: f64, stored: &[f64]) -> f64 {
        let [_, fluxes] = self.sides();
        fluxes.iter().sum::<f64>() + load - stored.iter().sum::<f64>()
    }

    /// ∫A∇u_h·∇u_h of a cell in balance: Σ_E u_E (∫_E σ·n + ∫f/m), less what it stores by each side, because ∫A∇u_h·∇φ_E stands in brackets.
    pub fn energy(&self, load: f64, stored: &[f64]) -> f64 {
        let ([means, fluxes], mean) = (self.sides(), self.mean());
        let share = load / means.len() as f64;
        let stored = stored.iter().chain(std::iter::repeat(&0.0));
        // The brackets add up to the surplus, so that the mean may be left out: less cancels.
        let sides = means.iter().zip(fluxes).zip(stored);
        sides.map(|((u, out), stored)| (u - mean) * (out + share - stored)).sum()
    }
}

fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
