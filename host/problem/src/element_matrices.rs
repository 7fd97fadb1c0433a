//! Element matrices in f64, integrated once, narrowed once, and whether the scalar can hold them; and the diagonal of K with
//! the load b alone, which tell the size of a problem's numbers before it is assembled.

use signorini_kernel::element::crouzeix_raviart;
use signorini_kernel::error::{Array, CellId};
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::Side;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Error, Real, Tensor};

use super::Problem;
use super::integrals::{Integrated, QuadCoefficient};
use crate::cell::Cell;
use crate::pieces::Pieces;
use crate::quadrature::DATA_POINTS;
use crate::scalar::{Scalar, UnitBox};

/// K_T of every cell, as the kernel keeps them.
#[derive(Debug, Clone)]
pub(super) struct ElementMatrices<R> {
    pub triangles: Vec<[R; 3]>,
    pub quads: Vec<[R; 6]>,
    /// The most of any cell.
    pub obliqueness: f64,
}

/// Of a determinant that cancels down to this many ε of its terms nothing is left.
const TOLD_APART: f64 = 32.0;

impl<R: Scalar> ElementMatrices<R> {
    /// Narrows what is integrated once.
    ///
    /// # Errors
    /// Cells too thin or too oblique for the scalar.
    pub fn of(problem: &Problem) -> Result<Self, Error> {
        let coefficients = &problem.coefficients;
        let integrated = coefficients.matrices.get_or_init(|| Integrated::new(problem));
        let Integrated { triangles, quads, obliqueness } =
            integrated.as_ref().map_err(|error| *error)?;
        let is_told = |of: &f64| of * TOLD_APART * R::EPSILON.wide() < 1.0;
        if let Some(at) = obliqueness.iter().position(|of| !is_told(of)) {
            let quad = at.checked_sub(triangles.len());
            return Err(Error::Oblique(quad.map_or(CellId::Triangle(at), CellId::Quad)));
        }
        Ok(Self {
            triangles: triangles.iter().map(|matrix| matrix.map(R::narrow)).collect(),
            quads: quads.iter().map(|matrix| matrix.map(R::narrow)).collect(),
            obliqueness: obliqueness.iter().fold(1.0, |most: f64, &of| most.max(of)),
        })
    }

    /// The matrices in the form that the kernel takes.
    pub fn stiffness(&self) -> Stiffness<'_, R> {
        Stiffness { triangles: &self.triangles, quads: &self.quads }
    }

    /// All entries, triangles first.
    pub fn entries(&self) -> impl Iterator<Item = &R> {
        self.triangles.as_flattened().iter().chain(self.quads.as_flattened())
    }
}

impl Integrated {
    fn new(problem: &Problem) -> Result<Self, Error> {
        let mesh = &problem.mesh;
        let vertices = UnitBox::of(&mesh.vertices).narrowed(&mesh.vertices);
        let in_box = Mesh::<f64, u32>::new(&vertices, &mesh.triangles, &mesh.quads)?;
        let triangles = mesh.triangles.iter().zip(&problem.coefficients.triangles);
        let triangles =
            triangles.map(|(cell, a)| crouzeix_raviart::stiffness(in_box.triangle(cell), *a));
        let triangles: Vec<_> = triangles.collect();
        let mut obliqueness: Vec<_> = triangles.iter().map(|matrix| of_triangle(*matrix)).collect();
        let rule = f64::GAUSS[DATA_POINTS - 1];
        let quads = mesh.quads.iter().zip(&problem.coefficients.quads);
        let quads = quads.enumerate().map(|(at, (cell, coefficient))| {
            let corners = in_box.quad(cell);
            obliqueness.push(of_quad(corners, problem.mean_conductivity(triangles.len() + at)));
            match (coefficient, problem.coefficients.cut(triangles.len() + at)) {
                (_, Some(pieces)) => on_pieces(problem, triangles.len() + at, pieces),
                (QuadCoefficient::Constant(a), _) => {
                    problem.element.stiffness(corners, rule, |_, _| *a)
                }
                (QuadCoefficient::AtPoints(tensors), _) => {
                    problem.element.stiffness(corners, rule, |point, _| tensors[point])
                }
            }
        });
        let quads = quads.collect();
        Ok(Self { triangles, quads, obliqueness })
    }
}

/// The sides of the entries of the matrix of a quad.
const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// K_T of a quad by the points of its pieces.
fn on_pieces(problem: &Problem, at: usize, pieces: &Pieces) -> [f64; 6] {
    let mut k = [0.0; 6];
    let Cell::Quad(corners) = Cell::of(problem, at) else { return k };
    for piece in pieces.points(Cell::Quad(corners)) {
        let ([x, y, _], a) = (piece.point.reference, piece.middle());
        let unit = |side: usize| std::array::from_fn(|other| f64::from(u8::from(other == side)));
        let slopes = [0, 1, 2, 3].map(|k| problem.element.gradient(corners, [x, y], unit(k)));
        for (entry, [i, j]) in k.iter_mut().zip(PAIRS) {
            *entry += piece.point.weight * a.apply(slopes[i]).dot(&slopes[j]);
        }
    }
    k
}

/// How oblique A is in a triangle: the terms of 4 det A = ab + bc + ca, with the negative entries a, b, c of the
/// element matrix, over what they cancel to. Rounded entries carry ε times as much of their energy.
fn of_triangle([a, b, c]: [f64; 3]) -> f64 {
    let [ab, bc, ca] = [a * b, b * c, c * a];
    (ab.abs() + bc.abs() + ca.abs()) / (ab + bc + ca).max(0.0)
}

/// Stiffest entry of a quad whose opposite sides' midpoints p and q join: G_pp G_qq over det G, G being A in their
/// coordinates.
fn of_quad([a, b, c, d]: [[f64; 2]; 4], tensor: Tensor<f64>) -> f64 {
    let p: [f64; 2] = std::array::from_fn(|i| b[i] + c[i] - a[i] - d[i]);
    let q: [f64; 2] = std::array::from_fn(|i| c[i] + d[i] - a[i] - b[i]);
    let Tensor { xx, xy, yy } = tensor;
    // The normals of p and q take A into G, up to the square of the area.
    let [m, n] = [[q[1], -q[0]], [-p[1], p[0]]];
    let product = |v: [f64; 2], w: [f64; 2]| {
        xx * v[0] * w[0] + xy * (v[0] * w[1] + v[1] * w[0]) + yy * v[1] * w[1]
    };
    let area = p[0] * q[1] - p[1] * q[0];
    product(m, m) * product(n, n) / ((xx * yy - xy * xy).max(0.0) * area * area)
}

impl Problem {
    /// The diagonal of K, and b, with the bits of [`super::Assembled`].
    ///
    /// # Errors
    /// As for [`super::Assembled::system`].
    pub fn diagonal_and_load(&self) -> Result<[Vec<f64>; 2], Error> {
        let (edges, loads) = (self.topology.edges()?, &self.loads);
        let matrices = ElementMatrices::of(self)?;
        let unknowns = edges.counts().unknowns();
        let own = |half: &u32| match edges.side(*half as usize) {
            Side::Triangle(at, side) => of_side(&matrices.triangles[at], &TRIANGLE[side]),
            Side::Quad(at, side) => of_side(&matrices.quads[at], &QUAD[side]),
        };
        let pairs = self.topology.half_edges.iter().take(unknowns);
        let sum = |pair: &[u32; 2]| {
            let halves = pair.iter().filter(|&&half| half != u32::MAX);
            halves.map(own).fold(0.0, |sum, own| sum + own)
        };
        let mut diagonal: Vec<f64> = pairs.map(sum).collect();
        loads.diagonal(&edges)?.entries().for_each(|(edge, term)| diagonal[edge] += term);
        let mut load = vec![0.0; unknowns];
        loads.fill(&edges, &mut load)?;
        finite(Array::MatrixValues, matrices.entries())?;
        finite(Array::MatrixValues, diagonal.iter())?;
        finite(Array::Load, load.iter())?;
        finite(Array::LowerBounds, loads.gap.iter())?;
        match diagonal.iter().position(|own| *own <= 0.0) {
            Some(at) => Err(Error::OutOfRange { of: Array::RowPointers, at }),
            None => Ok([diagonal, load]),
        }
    }
}

/// Where the entries of a row stand in an element matrix, but for the diagonal one.
const TRIANGLE: [[usize; 2]; 3] = [[0, 2], [0, 1], [2, 1]];
/// Positions of the entries of a row in the matrix of a quad, but for the diagonal one.
const QUAD: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 4], [1, 3, 5], [2, 4, 5]];

/// Rows add up to 0.
fn of_side(matrix: &[f64], others: &[usize]) -> f64 {
    others.iter().fold(0.0, |sum, &at| sum - matrix[at])
}

fn finite<'n>(of: Array, mut numbers: impl Iterator<Item = &'n f64>) -> Result<(), Error> {
    match numbers.position(|number| !number.is_finite()) {
        Some(at) => Err(Error::NotFinite { of, at }),
        None => Ok(()),
    }
}
