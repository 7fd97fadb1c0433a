//! The coefficient A over the cells: means on triangles, Gauss-point values on quads, and what they make of the cells.

use std::sync::OnceLock;

use signorini_kernel::{Error as KernelError, Real, Tensor};

use super::{Binding, Problem};
use crate::cell::Cell;
use crate::quadrature::{DATA_POINTS, Point, TRIANGLE_POINTS, on_quad, on_triangle};
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
    /// Element matrices that follow, once somebody asks.
    pub(super) matrices: OnceLock<std::result::Result<Integrated, KernelError>>,
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
    let corners = |vertex: u32| mesh.vertices[vertex as usize];
    let constants =
        scene.materials.iter().map(|m| constant(scene, m)).collect::<Result<Vec<_>>>()?;
    let triangles = mesh.triangles.iter().enumerate().map(|(cell, vertices)| {
        let material = binding.materials[cell] as usize;
        match constants[material] {
            Some(tensor) => Ok(tensor),
            None => mean(scene, &scene.materials[material], vertices.map(corners)),
        }
    });
    let triangles = triangles.collect::<Result<_>>()?;
    let quads = mesh.quads.iter().enumerate().map(|(at, vertices)| {
        let material = binding.materials[mesh.triangles.len() + at] as usize;
        if let Some(tensor) = constants[material] {
            return Ok(QuadCoefficient::Constant(tensor));
        }
        let points = on_quad(vertices.map(corners), f64::GAUSS[DATA_POINTS - 1]);
        let tensors = points.map(|point| at_point(scene, &scene.materials[material], point));
        Ok(QuadCoefficient::AtPoints(tensors.collect::<Result<_>>()?))
    });
    Ok(Coefficients { triangles, quads: quads.collect::<Result<_>>()?, matrices: OnceLock::new() })
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
        match &quads[quad] {
            QuadCoefficient::Constant(tensor) => *tensor,
            QuadCoefficient::AtPoints(tensors) => {
                let points = Cell::of(self, cell).points(f64::GAUSS[DATA_POINTS - 1]);
                average(points.iter().zip(tensors).map(|(point, tensor)| (point.weight, *tensor)))
            }
        }
    }
}

fn mean(scene: &Scene, material: &Material, triangle: [[f64; 2]; 3]) -> Result<Tensor<f64>> {
    let points = on_triangle(triangle, f64::GAUSS[TRIANGLE_POINTS - 1]);
    let weighted = points.map(|point| Ok((point.weight, at_point(scene, material, point)?)));
    Ok(average(weighted.collect::<Result<Vec<_>>>()?))
}

fn average(weighted: impl IntoIterator<Item = (f64, Tensor<f64>)>) -> Tensor<f64> {
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

fn at_point(scene: &Scene, material: &Material, point: Point) -> Result<Tensor<f64>> {
    let [x, y] = point.x;
    let [xx, xy, yy] = material.conductivity.each_ref().map(|entry| entry.value.eval(x, y, 0.0));
    checked(scene, material, Tensor { xx, xy, yy }, Some(point.x))
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
