//! A in reference coordinates, as the kernel's certificate takes it ([`signorini_bound::certificate`]).

use signorini_bound::certificate::{Above, Factor, POINTS, of_quad, of_triangle};
use signorini_bound::prepare::{is_parallelogram, is_told};
use signorini_kernel::element::QuadElement;
use signorini_kernel::element::nonparametric::axes;
use signorini_kernel::element::rannacher_turek::place;
use signorini_kernel::{Real, Tensor};

use super::cell::Cell;
use super::conductivity::Conductivity;
use super::factor::factor;
use signorini_problem::quadrature::{DATA_POINTS, on_quad, on_triangle};
use signorini_problem::scalar::{Scalar, narrowed};
use signorini_problem::{Problem, QuadCoefficient};

// A on quads is evaluated once, for element matrices and bound.
const _: () = assert!(POINTS == DATA_POINTS);

/// B at the 64 points of a cell.
pub type Points<R> = [Tensor<R>; POINTS * POINTS];

/// Owned arrays of a [`signorini_bound::certificate::Metric`], and ½ tr A of the cells.
#[derive(Debug, Clone)]
pub struct Metric<R: Scalar> {
    compliance: Vec<R>,
    at_points: Vec<Points<R>>,
    factors: Vec<Factor<R>>,
    above: Vec<Above<R>>,
    place: Vec<u32>,
    distortions: Vec<[R; 2]>,
    alpha: Vec<R>,
    missed: f64,
}

impl<R: Scalar> Metric<R> {
    /// Evaluates A where it varies inside a cell, and where a quad is no parallelogram or too thin for
    /// its element matrix to tell B.
    pub fn new(problem: &Problem) -> Self {
        let coefficients = &problem.coefficients;
        let compliance = coefficients.triangles.iter().map(|a| {
            let determinant = a.xx * a.yy - a.xy * a.xy;
            R::narrow(0.25 / determinant)
        });
        let mut metric = Self {
            compliance: compliance.collect(),
            at_points: Vec::new(),
            factors: Vec::new(),
            above: Vec::new(),
            place: vec![u32::MAX; problem.cells()],
            distortions: distortions(problem),
            alpha: (0..problem.cells()).map(|at| R::narrow(half_trace(problem, at))).collect(),
            missed: 0.0,
        };
        for cell in 0..problem.cells() {
            metric.add(problem, cell);
        }
        metric.cut(problem);
        metric
    }

    /// The kernel's view of it.
    pub fn view(&self) -> signorini_bound::certificate::Metric<'_, R> {
        signorini_bound::certificate::Metric {
            at_points: &self.at_points,
            factors: &self.factors,
            above: &self.above,
            missed: R::narrow(self.missed),
            place: &self.place,
            distortions: &self.distortions,
        }
    }

    /// 1/(4 det A) of every triangle, A its mean.
    pub fn compliance(&self) -> &[R] {
        &self.compliance
    }

    /// ½ tr A of every cell, triangles first.
    pub fn alpha(&self) -> &[R] {
        &self.alpha
    }

    /// Adds B at the points of a cell where it varies, and what A has above what the points see.
    fn add(&mut self, problem: &Problem, cell: usize) {
        let a = Conductivity::of(problem, cell);
        if a.cut().is_some() {
            return;
        }
        let Some(points) = varying(problem, cell, &a) else { return };
        self.place[cell] = self.at_points.len() as u32;
        self.at_points.push(points);
        // ‖A^{−½}(τ − A∇s)‖ ≤ √(1 + ν) of what the points see and 2ν‖A^½∇s‖.
        self.above.push([4.0 * a.share() * a.share(), 0.0].map(R::narrow));
        let [missed, _] = a.missed(Cell::of(problem, cell));
        self.missed = self.missed.max(missed);
    }

    /// Adds the factors of the cells whose points do not resolve A.
    fn cut(&mut self, problem: &Problem) {
        for (&cell, cut) in problem.cuts() {
            let (factor, above) = factor(cut);
            self.place[cell] = (self.at_points.len() + self.factors.len()) as u32;
            self.factors.push(factor.map(R::narrow));
            self.above.push(above.map(R::narrow));
            let [missed, _] = Conductivity::of(problem, cell).missed(Cell::of(problem, cell));
            self.missed = self.missed.max(missed);
        }
        if self.above.iter().all(|above| *above == [R::ZERO; 2]) {
            self.above.clear();
        }
    }
}

/// B at the points, where it is not the same in the whole cell.
fn varying<R: Scalar>(problem: &Problem, cell: usize, a: &Conductivity) -> Option<Points<R>> {
    let mesh = &problem.mesh;
    let corner = |vertex: u32| mesh.vertices[vertex as usize];
    let rule = f64::GAUSS[POINTS - 1];
    let tensors: Vec<Tensor<f64>> = match cell.checked_sub(mesh.triangles.len()) {
        None if a.is_constant() => return None,
        None => {
            let corners = mesh.triangles[cell].map(corner);
            let points = on_triangle(corners, rule);
            points.map(|point| of_triangle(corners, a.at(point.x))).collect()
        }
        Some(quad) => {
            let corners = mesh.quads[quad].map(corner);
            let here = |reference: [f64; 3]| place(corners, [reference[0], reference[1]]);
            if a.is_constant() && is_parallelogram(corners) {
                let middle = here([0.5, 0.5, 0.0]);
                if is_told(of_quad(&middle, a.at(middle.x)), R::EPSILON.wide()) {
                    return None;
                }
            }
            // The element matrices have the same points.
            let known = &problem.coefficients.quads[quad];
            let points = on_quad(corners, rule).enumerate();
            points.map(|(at, p)| of_quad(&here(p.reference), known.at(at))).collect()
        }
    };
    Some(std::array::from_fn(|point| narrowed(&tensors[point])))
}

/// The distortion of every quad, where u_h is nonparametric and there is a quad on which that matters.
fn distortions<R: Scalar>(problem: &Problem) -> Vec<[R; 2]> {
    let mesh = &problem.mesh;
    let corners = |quad: &[u32; 4]| quad.map(|vertex| mesh.vertices[vertex as usize]);
    let straight = mesh.quads.iter().all(|quad| is_parallelogram(corners(quad)));
    if straight || problem.element == QuadElement::Parametric {
        return Vec::new();
    }
    mesh.quads.iter().map(|quad| axes(corners(quad)).distortion().map(R::narrow)).collect()
}

/// ½ tr A of a cell: of its mean on triangles, of its middle on quads.
fn half_trace(problem: &Problem, cell: usize) -> f64 {
    let triangles = &problem.coefficients.triangles;
    let tensor = match triangles.get(cell) {
        Some(tensor) => tensor,
        None => match &problem.coefficients.quads[cell - triangles.len()] {
            QuadCoefficient::Constant(tensor) => tensor,
            QuadCoefficient::AtPoints(tensors) => &tensors[tensors.len() / 2],
        },
    };
    0.5 * (tensor.xx + tensor.yy)
}
