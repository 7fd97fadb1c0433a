//! The coefficient A over the cells: means on triangles, Gauss-point values on quads, and what they make of the cells.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use signorini_kernel::{Error as KernelError, Real, Tensor};

use super::{Binding, Problem};
use crate::cell::Cell;
use crate::pieces::{Cut, Pieces};
use crate::quadrature::{DATA_POINTS, Point, TRIANGLE_POINTS, on_quad};
use crate::tensors::{self, average};
use crate::threads::{in_portions, on_two_threads};
use signorini_scene::error::Result;
use signorini_scene::faults::Faults;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Material, Scene};

/// A as the element matrices need it.
#[derive(Debug, Clone, Default)]
pub struct Coefficients {
    /// The mean over each triangle.
    pub triangles: Vec<Tensor<f64>>,
    /// Constant quads have one tensor, others the 8×8 quadrature points of theirs.
    pub quads: Vec<QuadCoefficient>,
    /// A on the pieces of cells in which it varies, triangles first.
    pub pieces: BTreeMap<usize, Pieces>,
    /// Integrals over those of cells whose own points do not resolve A, once somebody asks.
    cuts: OnceLock<BTreeMap<usize, Cut>>,
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
///
/// `known` are its pieces, where these have been found.
pub(super) fn coefficients(
    scene: &Scene,
    mesh: &Mesh,
    binding: &Binding,
    known: Option<BTreeMap<usize, Pieces>>,
) -> Result<Coefficients> {
    let faults = Faults::default();
    let constants = scene.materials.iter().map(|m| faults.keep(constant(scene, m)).flatten());
    let constants: Vec<_> = constants.collect();
    faults.into_result()?;
    let of_cell = |at: usize| binding.materials[at] as usize;
    let varying: Vec<usize> =
        (0..binding.materials.len()).filter(|&at| constants[of_cell(at)].is_none()).collect();
    let pieces = match known {
        Some(pieces) => pieces,
        None => pieces(scene, mesh, binding, &varying)?,
    };
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
    Ok(Coefficients { triangles, quads, pieces, cuts: OnceLock::new(), matrices: OnceLock::new() })
}

/// Pieces are small enough where what is not seen is this part of what can be seen.
const LEFT: f64 = 1e-3;
/// So much is left of what is proved at all.
const PROVED: f64 = 1e100;
/// Most cuts of all cells, and of those where nothing is proved otherwise.
const MOST: usize = 40_000;
const MOST_UNPROVED: usize = 200_000;
/// Most cuts of a cell, and the number that any may have.
const MOST_OF_CELL: usize = 1024;
const FEWEST: usize = 32;

/// A on pieces of these cells.
fn pieces(
    scene: &Scene,
    mesh: &Mesh,
    binding: &Binding,
    cells: &[usize],
) -> Result<BTreeMap<usize, Pieces>> {
    let of_cells = |cells: &[usize], most: usize, left: f64| -> Result<BTreeMap<usize, Pieces>> {
        let portions = in_portions(cells.len(), |portion| {
            let of = |&at: &usize| {
                let material = &scene.materials[binding.materials[at] as usize];
                (at, Pieces::new(material, Cell::in_mesh(mesh, at), (most, left)))
            };
            Ok(cells[portion].iter().map(of).collect::<Vec<_>>())
        })?;
        Ok(portions.into_iter().flatten().collect())
    };
    let mut all = of_cells(cells, 0, LEFT)?;
    // First what is to be small enough, then what is to be proved at all.
    for (most, left) in [(MOST, LEFT), (MOST_UNPROVED, PROVED)] {
        let is_open = |at: &&usize| all.get(at).is_some_and(|of| of.left > left);
        let open: Vec<usize> = cells.iter().filter(is_open).copied().collect();
        let most = (most / open.len().max(1)).clamp(FEWEST, MOST_OF_CELL);
        all.extend(of_cells(&open, most, left)?);
    }
    // Where it is no tensor of a material, that is told with the point.
    for (&at, pieces) in &all {
        let material = &scene.materials[binding.materials[at] as usize];
        pieces.unproved().map(|x| at_point(scene, material, x)).transpose()?;
    }
    Ok(all)
}

/// The tensor of a material whose entries are all constant.
fn constant(scene: &Scene, material: &Material) -> Result<Option<Tensor<f64>>> {
    tensors::constant(material).map(|a| checked(scene, material, a, None)).transpose()
}

impl Problem {
    /// Integrals over the cells whose own points do not resolve A.
    pub fn cuts(&self) -> &BTreeMap<usize, Cut> {
        self.coefficients.cuts.get_or_init(|| {
            let pieces = self.coefficients.pieces.iter().filter(|(_, of)| !of.is_resolved());
            let pieces: Vec<_> = pieces.collect();
            let of = |&(&at, pieces): &(&usize, &Pieces)| Ok((at, Cut::of(self, at, pieces)));
            let cuts = on_two_threads(&pieces, of, || ());
            cuts.map(|cuts| cuts.into_iter().collect()).unwrap_or_default()
        })
    }

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

fn at_point(scene: &Scene, material: &Material, at: [f64; 2]) -> Result<Tensor<f64>> {
    checked(scene, material, tensors::at(material, at), Some(at))
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
