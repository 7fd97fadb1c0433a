//! The element matrices of all cells, stored once: assembly, flux and certificate read them.

use crate::element::{QuadElement, copy_row, crouzeix_raviart};
use crate::error::{Array, CellId, Error, same_length};
use crate::index::{Index, read};
use crate::mesh::edges::{Edges, Side};
use crate::{Mesh, Real, Tensor};

/// A as the kernel needs it: means over triangles, values at the quadrature points of quads.
#[derive(Debug, Clone, Copy)]
pub enum Coefficient<'a, R> {
    /// One tensor everywhere.
    Uniform(Tensor<R>),
    /// One tensor a cell, triangles first (their means), then quads (taken as constant).
    PerCell(&'a [Tensor<R>]),
    /// One tensor a triangle, then points² a quad: row by row, x̂ running fastest.
    PerPoint(&'a [Tensor<R>]),
}

impl<R: Real> Coefficient<'_, R> {
    fn expected(&self, triangles: usize, quads: usize, points: usize) -> Option<usize> {
        match self {
            Self::Uniform(_) => None,
            Self::PerCell(_) => Some(triangles + quads),
            Self::PerPoint(_) => Some(triangles + quads * points * points),
        }
    }

    /// Tensor of a cell, of a quad at its first point; `triangles` come first.
    pub fn of_cell(&self, cell: usize, triangles: usize, points: usize) -> Tensor<R> {
        let of_quad = cell.checked_sub(triangles).map(|quad| triangles + quad * points * points);
        self.at(cell, of_quad.unwrap_or(cell))
    }

    fn len(&self) -> usize {
        match self {
            Self::Uniform(_) => 1,
            Self::PerCell(tensors) | Self::PerPoint(tensors) => tensors.len(),
        }
    }

    fn at(&self, cell: usize, point: usize) -> Tensor<R> {
        match self {
            Self::Uniform(tensor) => *tensor,
            Self::PerCell(tensors) => read(tensors, cell),
            Self::PerPoint(tensors) => read(tensors, point),
        }
    }
}

/// Element matrices without their diagonals (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Stiffness<'a, R> {
    /// \[01, 12, 20\] of each triangle.
    pub triangles: &'a [[R; 3]],
    /// \[01, 02, 03, 12, 13, 23\] of each quad.
    pub quads: &'a [[R; 6]],
}

impl<R: Real> Stiffness<'_, R> {
    /// K_ii of a boundary edge, which has one cell, without what stands on the diagonal besides.
    pub fn of_boundary_edge<I: Index>(&self, edges: &Edges<I>, edge: usize) -> R {
        let mut others = [].iter_mut();
        match edges.first_side(edge) {
            Side::Triangle(at, side) => copy_row(&read(self.triangles, at), 3, side, &mut others),
            Side::Quad(at, side) => copy_row(&read(self.quads, at), 4, side, &mut others),
        }
    }
}

/// Fills the element matrices of `mesh`; quads are parametric and integrated with `points`² Gauss
/// points, 1 to 8 in each direction (2 are exact on parallelograms with constant A).
///
/// # Errors
/// Arrays of the wrong length, a tensor that is not positive definite, an entry that overflows.
pub fn fill<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    coefficient: Coefficient<R>,
    points: usize,
    triangles: &mut [[R; 3]],
    quads: &mut [[R; 6]],
) -> Result<(), Error> {
    fill_with(QuadElement::Parametric, mesh, coefficient, points, triangles, quads)
}

/// Fills the matrices with a choice of the element on quads. With the nonparametric one 2 points per direction are
/// exact on every quad with constant A.
///
/// # Errors
/// As for [`fill`].
#[inline(always)]
pub fn fill_with<R: Real, I: Index>(
    element: QuadElement,
    mesh: &Mesh<R, I>,
    coefficient: Coefficient<R>,
    points: usize,
    triangles: &mut [[R; 3]],
    quads: &mut [[R; 6]],
) -> Result<(), Error> {
    same_length(Array::Stiffness, triangles.len(), mesh.triangles().len())?;
    same_length(Array::Stiffness, quads.len(), mesh.quads().len())?;
    let rule = *R::GAUSS.get(points.wrapping_sub(1)).ok_or(Error::Capacity {
        of: Array::Coefficients,
        needed: points,
        limit: R::GAUSS.len(),
    })?;
    if let Some(expected) = coefficient.expected(triangles.len(), quads.len(), points) {
        same_length(Array::Coefficients, coefficient.len(), expected)?;
    }
    fill_triangles(mesh, coefficient, triangles)?;
    fill_quads(element, mesh, coefficient, rule, quads)
}

/// Element matrices of triangles: one tensor for all of them is checked once.
#[inline(never)]
fn fill_triangles<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    coefficient: Coefficient<R>,
    triangles: &mut [[R; 3]],
) -> Result<(), Error> {
    // Becomes NaN with the first matrix that is not finite, and stays it.
    let mut sum = R::ZERO;
    match coefficient {
        Coefficient::Uniform(_) if triangles.is_empty() => {}
        Coefficient::Uniform(tensor) => {
            let tensor = checked(tensor, CellId::Triangle(0))?;
            for (vertices, k) in mesh.triangles().iter().zip(triangles.iter_mut()) {
                let Some(corners) = mesh.corners(vertices) else { break };
                *k = crouzeix_raviart::stiffness(corners, tensor);
                sum += (k[0] + k[1] + k[2]) * R::ZERO;
            }
        }
        Coefficient::PerCell(tensors) | Coefficient::PerPoint(tensors) => {
            let cells = mesh.triangles().iter().zip(tensors).enumerate();
            for ((at, (vertices, &tensor)), k) in cells.zip(triangles.iter_mut()) {
                let tensor = checked(tensor, CellId::Triangle(at))?;
                *k = crouzeix_raviart::stiffness(mesh.triangle(vertices), tensor);
                sum += (k[0] + k[1] + k[2]) * R::ZERO;
            }
        }
    }
    if sum.finite() {
        return Ok(());
    }
    triangles.iter().enumerate().try_for_each(|(at, k)| check_entries(k, at))
}

/// Element matrices of quads. Not inlined, so that symbols tell whether it is there.
#[inline(never)]
fn fill_quads<R: Real, I: Index>(
    element: QuadElement,
    mesh: &Mesh<R, I>,
    coefficient: Coefficient<R>,
    rule: &[[R; 2]],
    quads: &mut [[R; 6]],
) -> Result<(), Error> {
    let points = rule.len();
    for (at, (vertices, k)) in mesh.quads().iter().zip(quads.iter_mut()).enumerate() {
        let cell = mesh.triangles().len() + at;
        let first_point = mesh.triangles().len() + at * points * points;
        let mut definite = true;
        *k = element.stiffness(mesh.quad(vertices), rule, |point, _| {
            let tensor = coefficient.at(cell, first_point + point);
            definite &= tensor.is_positive_definite();
            tensor
        });
        if !definite {
            return Err(Error::NotPositiveDefinite(CellId::Quad(at)));
        }
        check_entries(k, cell)?;
    }
    Ok(())
}

fn checked<R: Real>(tensor: Tensor<R>, cell: CellId) -> Result<Tensor<R>, Error> {
    if tensor.is_positive_definite() { Ok(tensor) } else { Err(Error::NotPositiveDefinite(cell)) }
}

/// Infinite and NaN entries show in their sum.
fn check_entries<R: Real>(k: &[R], at: usize) -> Result<(), Error> {
    let sum = k.iter().fold(R::ZERO, |sum, &entry| sum + entry);
    if sum.finite() { Ok(()) } else { Err(Error::NotFinite { of: Array::Stiffness, at }) }
}
