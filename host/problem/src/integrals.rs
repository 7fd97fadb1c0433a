//! The coefficient A over the cells: means on triangles, Gauss-point values on quads, and what they make of the cells.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use signorini_kernel::{Error as KernelError, Real, Tensor};

use super::{Binding, Problem};
use crate::cell::Cell;
use crate::pieces::Pieces;
use crate::quadrature::{DATA_POINTS, Point, TRIANGLE_POINTS, on_quad};
use crate::threads::in_portions;
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Material, Scene};

/// A as the element matrices need it.
#[derive(Debug, Clone)]
pub struct Coefficients {
    /// The mean over each triangle.
    pub triangles: Vec<Tensor<f64>>,
    /// Constant quads have one tensor, others the 8×8 quadrature points of theirs.
    pub quads: Vec<QuadCoefficient>,
    /// A on the pieces of cells in which it varies, triangles first.
    pub pieces: BTreeMap<usize, Pieces>,
    /// Element matrices that follow, once somebody asks.
    pub(super) matrices: OnceLock<std::result::Result<Integrated, KernelError>>,
}

impl Coefficients {
    /// The pieces of a cell whose own points do not resolve A.
    pub fn cut(&self, cell: usize) -> Option<&Pieces> {
        self.pieces.get(&cell).filter(|pieces| !pieces.is_resolved())
    }
}

/// A on one quad.
#[derive(Debug, Clone)]
pub enum QuadCoefficient {
    /// One tensor everywhere.
    Constant(Tensor<f64>),
    /// At the 8×8 Gauss points, x̂ running fastest.
    AtPoints(Vec<Tensor<f64>>),
}

impl QuadCoefficient {
    /// A at the Gauss point of this number.
    pub fn at(&self, point: usize) -> Tensor<f64> {
        match self {
            Self::Constant(tensor) => *tensor,
            Self::AtPoints(tensors) => tensors[point],
        }
    }
}

/// Element matrices in f64 and in the unit box, before a scalar is chosen: mesh and A alone decide them.
#[derive(Debug, Clone)]
pub(super) struct Integrated {
    pub triangles: Vec<[f64; 3]>,
    pub quads: Vec<[f64; 6]>,
    /// Of every cell, triangles first.
    pub obliqueness: Vec<f64>,
}

/// Evaluates and checks A on every cell.
pub(super) fn coefficients(scene: &Scene, mesh: &Mesh, binding: &Binding) -> Result<Coefficients> {
    let constants =
        scene.materials.iter().map(|m| constant(scene, m)).collect::<Result<Vec<_>>>()?;
    let of_cell = |at: usize| binding.materials[at] as usize;
    let varying: Vec<usize> =
        (0..binding.materials.len()).filter(|&at| constants[of_cell(at)].is_none()).collect();
    let pieces = pieces(scene, mesh, binding, &varying)?;
    let triangles = mesh.triangles.iter().enumerate().map(|(at, _)| {
        let material = of_cell(at);
        match (constants[material], pieces.get(&at)) {
            (Some(tensor), _) => Ok(tensor),
            (_, Some(pieces)) if !pieces.is_resolved() => Ok(pieces.mean(Cell::in_mesh(mesh, at))),
            _ => mean(scene, &scene.materials[material], Cell::in_mesh(mesh, at)),
        }
    });
    let triangles = triangles.collect::<Result<Vec<_>>>()?;
    let quads = mesh.quads.iter().enumerate().map(|(at, vertices)| {
        let material = of_cell(triangles.len() + at);
        if let Some(tensor) = constants[material] {
            return Ok(QuadCoefficient::Constant(tensor));
        }
        let corners = vertices.map(|vertex| mesh.vertices[vertex as usize]);
        let points = on_quad(corners, f64::GAUSS[DATA_POINTS - 1]);
        let tensors = points.map(|point| at_point(scene, &scene.materials[material], point.x));
        Ok(QuadCoefficient::AtPoints(tensors.collect::<Result<_>>()?))
    });
    let quads = quads.collect::<Result<_>>()?;
    Ok(Coefficients { triangles, quads, pieces, matrices: OnceLock::new() })
}

/// Most pieces of a cell, and of all cells; fewest that one may be cut into.
const MOST: [usize; 2] = [1024, 40_000];
const FEWEST: usize = 16;

/// A on pieces of these cells.
fn pieces(
    scene: &Scene,
    mesh: &Mesh,
    binding: &Binding,
    cells: &[usize],
) -> Result<BTreeMap<usize, Pieces>> {
    let of_cells = |cells: &[usize], most: usize| -> Result<BTreeMap<usize, Pieces>> {
        let portions = in_portions(cells.len(), |portion| {
            let of = |&at: &usize| {
                let material = &scene.materials[binding.materials[at] as usize];
                (at, Pieces::new(material, Cell::in_mesh(mesh, at), most))
            };
            Ok(cells[portion].iter().map(of).collect::<Vec<_>>())
        })?;
        Ok(portions.into_iter().flatten().collect())
    };
    let mut all = of_cells(cells, 0)?;
    let is_open = |at: &&usize| all.get(at).is_some_and(Pieces::is_open);
    let open: Vec<usize> = cells.iter().filter(is_open).copied().collect();
    let most = (MOST[1] / open.len().max(1)).clamp(FEWEST, MOST[0]);
    all.extend(of_cells(&open, most)?);
    // Where it is no tensor of a material, that is told with the point.
    for (&at, pieces) in &all {
        let material = &scene.materials[binding.materials[at] as usize];
        pieces.unproved().map(|x| at_point(scene, material, x)).transpose()?;
    }
    Ok(all)
}

/// The tensor of a material whose entries are all constant.
fn constant(scene: &Scene, material: &Material) -> Result<Option<Tensor<f64>>> {
    let [xx, xy, yy] = material.conductivity.each_ref().map(|entry| entry.value.is_constant());
    let (Some(xx), Some(xy), Some(yy)) = (xx, xy, yy) else { return Ok(None) };
    checked(scene, material, Tensor { xx, xy, yy }, None).map(Some)
}

impl Problem {
    /// The mean of A over a cell, triangles first.
    pub fn mean_conductivity(&self, cell: usize) -> Tensor<f64> {
        let Coefficients { triangles, quads, .. } = &*self.coefficients;
        let Some(quad) = cell.checked_sub(triangles.len()) else { return triangles[cell] };
        match (&quads[quad], self.coefficients.cut(cell)) {
            (QuadCoefficient::Constant(tensor), _) => *tensor,
            (_, Some(pieces)) => pieces.mean(Cell::of(self, cell)),
            (QuadCoefficient::AtPoints(tensors), _) => {
                let points = Cell::of(self, cell).points(f64::GAUSS[DATA_POINTS - 1]);
                average(points.iter().zip(tensors).map(|(point, tensor)| (point.weight, *tensor)))
            }
        }
    }
}

fn mean(scene: &Scene, material: &Material, cell: Cell) -> Result<Tensor<f64>> {
    let points = cell.points(f64::GAUSS[TRIANGLE_POINTS - 1]).into_iter();
    let weighted =
        points.map(|Point { x, weight, .. }| Ok((weight, at_point(scene, material, x)?)));
    Ok(average(weighted.collect::<Result<Vec<_>>>()?))
}

pub(super) fn average(weighted: impl IntoIterator<Item = (f64, Tensor<f64>)>) -> Tensor<f64> {
    let mut sum = Tensor::<f64>::default();
    let mut area = 0.0;
    for (weight, tensor) in weighted {
        sum.xx += weight * tensor.xx;
        sum.xy += weight * tensor.xy;
        sum.yy += weight * tensor.yy;
        area += weight;
    }
    Tensor { xx: sum.xx / area, xy: sum.xy / area, yy: sum.yy / area }
}

fn at_point(scene: &Scene, material: &Material, [x, y]: [f64; 2]) -> Result<Tensor<f64>> {
    let [xx, xy, yy] = material.conductivity.each_ref().map(|entry| entry.value.eval(x, y, 0.0));
    checked(scene, material, Tensor { xx, xy, yy }, Some([x, y]))
}

fn checked(
    scene: &Scene,
    material: &Material,
    tensor: Tensor<f64>,
    at: Option<[f64; 2]>,
) -> Result<Tensor<f64>> {
    if tensor.is_positive_definite() {
        return Ok(tensor);
    }
    let place = at.map_or(String::new(), |[x, y]| format!(" at ({x}, {y})"));
    let entries = [tensor.xx, tensor.xy, tensor.yy];
    let culprit = entries.iter().position(|entry| !entry.is_finite()).unwrap_or(0);
    let message =
        format!("A = [{}, {}; {}, {}]{place}", tensor.xx, tensor.xy, tensor.xy, tensor.yy);
    let (message, hint) = if entries.iter().all(|entry| entry.is_finite()) {
        (
            format!("{message} is not positive definite"),
            "a scalar must be > 0, a tensor needs axx > 0, ayy > 0 and axx·ayy > axy²",
        )
    } else {
        (format!("{message} is not finite"), "the expression must be finite all over its region")
    };
    Err(scene.error(&material.conductivity[culprit], message).hint(hint).into())
}
