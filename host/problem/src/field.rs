//! u_h and σ_h inside the cells, from edge means and edge fluxes.

use signorini_kernel::element::{QuadElement, crouzeix_raviart, rannacher_turek};

use crate::Problem;
use crate::cell::Cell;
use crate::quadrature::Point;

/// The discrete solution on one cell.
#[derive(Debug, Clone, Copy)]
pub struct CellField {
    pub(super) cell: Cell,
    element: QuadElement,
    /// Means of u_h over the sides; a triangle's fourth is none.
    means: [f64; 4],
    /// Outward fluxes through the sides; a triangle's fourth is none.
    fluxes: [f64; 4],
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
        let (mut means, mut fluxes) = ([0.0; 4], [0.0; 4]);
        for (side, &edge) in problem.topology.edges_of(cell).iter().enumerate() {
            let edge = edge as usize;
            let is_along = problem.topology.first_side(edge) == (cell, side);
            means[side] = u[edge];
            fluxes[side] = if is_along { flux[edge] } else { -flux[edge] };
        }
        Self::of_sides(problem, cell, means, fluxes)
    }

    /// The field on cell `cell` (triangles first) from means over its sides and outward fluxes through them.
    pub fn of_sides(problem: &Problem, cell: usize, means: [f64; 4], fluxes: [f64; 4]) -> Self {
        Self { cell: Cell::of(problem, cell), element: problem.element, means, fluxes }
    }

    /// Values at a point given by its place and its reference coordinates.
    pub fn sample(&self, point: &Point) -> Sample {
        let [x, y, _] = point.reference;
        let (u, gradient) = match self.cell {
            Cell::Triangle(corners) => {
                let (basis, means) = (crouzeix_raviart::basis(point.reference), three(self.means));
                (dot(basis, means), crouzeix_raviart::gradient(corners, means))
            }
            Cell::Quad(corners) => (
                dot(self.element.basis(corners, [x, y]), self.means),
                self.element.gradient(corners, [x, y], self.means),
            ),
        };
        Sample { u, gradient: gradient.into(), flux: self.flux(point) }
    }

    /// The Raviart–Thomas field at a point.
    pub fn flux(&self, point: &Point) -> [f64; 2] {
        match self.cell {
            Cell::Triangle(corners) => {
                crouzeix_raviart::raviart_thomas(corners, three(self.fluxes), point.x).into()
            }
            Cell::Quad(corners) => {
                let [x, y, _] = point.reference;
                rannacher_turek::place(corners, [x, y]).raviart_thomas(self.fluxes).into()
            }
        }
    }

    /// Reference coordinates of a point, where it lies in the cell (with a rounding's width around it).
    pub fn locate(&self, x: [f64; 2]) -> Option<[f64; 3]> {
        const SLACK: f64 = 1e-12;
        let reference = self.cell.reference(x);
        let is_inside = |part: &f64| match self.cell {
            Cell::Triangle(_) => *part >= -SLACK,
            Cell::Quad(_) => (-SLACK..=1.0 + SLACK).contains(part),
        };
        reference.iter().all(is_inside).then_some(reference)
    }

    /// σ_h in the middle.
    pub fn middle_flux(&self) -> [f64; 2] {
        self.flux(&Point { x: self.middle(), reference: [0.5, 0.5, 0.0], weight: 0.0 })
    }

    /// Its middle.
    pub fn middle(&self) -> [f64; 2] {
        match self.cell {
            Cell::Triangle(_) => self.cell.middle(),
            Cell::Quad(corners) => rannacher_turek::place(corners, [0.5; 2]).x,
        }
    }

    fn means(&self) -> &[f64] {
        &self.means[..self.cell.corners().len()]
    }

    /// Outward fluxes through the sides.
    pub fn fluxes(&self) -> &[f64] {
        &self.fluxes[..self.cell.corners().len()]
    }

    /// The mean of the edge means.
    pub fn mean(&self) -> f64 {
        self.means().iter().sum::<f64>() / self.means().len() as f64
    }

    /// Σ_E ∫σ·n + ∫f, with ∫f = `load`, less what the cell stores by its sides in a step of time: 0 for a cell in balance.
    pub fn surplus(&self, load: f64, stored: &[f64]) -> f64 {
        self.fluxes().iter().sum::<f64>() + load - stored.iter().sum::<f64>()
    }

    /// ∫A∇u_h·∇u_h of a cell in balance: Σ_E u_E (∫_E σ·n + ∫f/m), less what it stores by each side, because ∫A∇u_h·∇φ_E stands in brackets.
    pub fn energy(&self, load: f64, stored: &[f64]) -> f64 {
        let (mean, share) = (self.mean(), load / self.means().len() as f64);
        let stored = stored.iter().chain(std::iter::repeat(&0.0));
        // The brackets add up to the surplus, so that the mean may be left out: less cancels.
        let sides = self.means().iter().zip(self.fluxes()).zip(stored);
        sides.map(|((u, out), stored)| (u - mean) * (out + share - stored)).sum()
    }
}

/// The values of a triangle's sides.
fn three([a, b, c, _]: [f64; 4]) -> [f64; 3] {
    [a, b, c]
}

fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
