//! A problem in the kernel's hands: narrowed to one scalar and assembled.

use signorini_kernel::law::Law;
use std::collections::HashMap;

use signorini_device::model::Model;
use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::csr::Csr;
use signorini_kernel::flux::{self, Recovered};
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::system::Shifts;
use signorini_kernel::system::System;
use signorini_kernel::{Error, Tensor};

use super::element_matrices::ElementMatrices;
use super::{Loads, Parts, Problem, QuadCoefficient, Step};
use crate::scalar::{Scalar, UnitBox, narrowed};

/// Element matrices, CSR and loads in the scalar `R`; [`Assembled::system`] is the contact problem.
///
/// Coordinates are moved to the unit box before they are narrowed: in two dimensions K and all
/// edge fluxes stay the same, and a mesh far from the origin keeps its shape in `f32`.
#[derive(Debug, Clone)]
pub struct Assembled<'p, R: Scalar> {
    problem: &'p Problem,
    vertices: Vec<[R; 2]>,
    tensors: Vec<Tensor<R>>,
    edges: Edges<'p, u32>,
    matrices: ElementMatrices<R>,
    row_ptr: Vec<u32>,
    col_idx: Vec<u32>,
    values: Vec<R>,
    loads: Loads<R>,
    load: Vec<R>,
    part: Vec<u32>,
    parts: usize,
}

impl<'p, R: Scalar> Assembled<'p, R> {
    /// Narrows and assembles.
    ///
    /// # Errors
    /// What the scalar type cannot hold: cells too thin for it, coefficients or loads too large.
    pub fn new(problem: &'p Problem) -> Result<Self, Error> {
        let edges = problem.topology.edges()?;
        let vertices = UnitBox::of(&problem.mesh.vertices).narrowed(&problem.mesh.vertices);
        let matrices = ElementMatrices::of(problem)?;
        let loads = problem.loads.narrowed();
        let unknowns = edges.counts().unknowns();
        let mut assembled = Self {
            problem,
            vertices,
            tensors: tensors(problem).unwrap_or_default(),
            edges,
            matrices,
            row_ptr: vec![0; unknowns + 1],
            col_idx: vec![0; edges.nonzeros()],
            values: vec![R::ZERO; edges.nonzeros()],
            loads,
            load: vec![R::ZERO; unknowns],
            part: Vec::new(),
            parts: 1,
        };
        assembly::pattern(&edges, &mut assembled.row_ptr, &mut assembled.col_idx)?;
        assembled.fill_values()?;
        assembled.fill_load()?;
        Ok(assembled)
    }

    /// Tells which part of the domain each unknown belongs to; without, all are one part.
    pub fn set_parts(&mut self, parts: &Parts) {
        let mut numbers = HashMap::new();
        let unknowns = 0..self.edges.counts().unknowns();
        let roots = unknowns.map(|edge| parts.of_edge(&self.edges, edge));
        self.part = roots
            .map(|root| {
                let next = numbers.len() as u32;
                *numbers.entry(root).or_insert(next)
            })
            .collect();
        self.parts = numbers.len();
    }

    /// The problem that it was assembled from.
    pub fn problem(&self) -> &'p Problem {
        self.problem
    }

    /// Takes the loads of another time; the matrix follows where a transfer coefficient is another one.
    ///
    /// # Errors
    /// Loads that the scalar type cannot hold.
    pub fn set_loads(&mut self, loads: &Loads) -> Result<(), Error> {
        let before = std::mem::replace(&mut self.loads, loads.narrowed());
        let of_step = |of: &Loads<R>| of.step.as_ref().map(|step| step.diagonal.clone());
        let coefficients = |of: &Loads<R>| {
            (of.robin.iter().map(|law| law.coefficient).collect::<Vec<R>>(), of_step(of))
        };
        if coefficients(&before) != coefficients(&self.loads) {
            self.fill_values()?;
        }
        self.fill_load()
    }

    /// The numeric pass over the matrix.
    ///
    /// # Errors
    /// Boundary records that are not admissible.
    pub fn fill_values(&mut self) -> Result<(), Error> {
        let mut values = std::mem::take(&mut self.values);
        let filled = self.diagonal().and_then(|diagonal| {
            assembly::values(&self.edges, self.stiffness(), diagonal, &self.row_ptr, &mut values)
        });
        self.values = values;
        filled
    }

    /// The numeric pass over the load.
    ///
    /// # Errors
    /// Boundary records that are not admissible.
    pub fn fill_load(&mut self) -> Result<(), Error> {
        let mut load = std::mem::take(&mut self.load);
        let filled = self.loads.fill(&self.edges, &mut load);
        self.load = load;
        filled
    }

    /// Everything as borrowed arrays; `start` is a copy of [`Assembled::start`].
    pub fn model<'a>(&'a self, title: &'a str, start: &'a [R]) -> Model<'a, R, u32> {
        let (mesh, topology) = (&self.problem.mesh, &self.problem.topology);
        Model {
            title,
            vertices: &self.vertices,
            unit: R::narrow(UnitBox::of(&mesh.vertices).half),
            triangles: &mesh.triangles,
            quads: &mesh.quads,
            of_triangles: &topology.of_triangles,
            of_quads: &topology.of_quads,
            half_edges: &topology.half_edges,
            counts: topology.counts,
            tensors: &self.tensors,
            stiffness: self.stiffness(),
            loads: self.cells(),
            neumann: &self.loads.neumann,
            robin: &self.loads.robin,
            contact_flux: &self.loads.contact_flux,
            gap: &self.loads.gap,
            start,
        }
    }

    /// The mesh, in the unit box.
    ///
    /// # Errors
    /// Never after [`Assembled::new`].
    pub fn mesh(&self) -> Result<Mesh<'_, R, u32>, Error> {
        let mesh = &self.problem.mesh;
        Mesh::new(&self.vertices, &mesh.triangles, &mesh.quads)
    }

    /// Edge numbering.
    pub fn edges(&self) -> &Edges<'p, u32> {
        &self.edges
    }

    /// The share of a bound that rounded element matrices can hide, 64 ε κ: see [`signorini_bound::certificate::Stability::oblique`].
    /// κ ε is how much of a cell's energy rounding of its matrix may be: the terms of the determinant over what they cancel
    /// to, the most of any cell.
    pub fn hidden(&self) -> f64 {
        64.0 * R::EPSILON.wide() * self.matrices.obliqueness
    }

    /// Element matrices.
    pub fn stiffness(&self) -> Stiffness<'_, R> {
        self.matrices.stiffness()
    }

    /// The step in time that it is, if it is one.
    pub fn step(&self) -> Option<&Step<R>> {
        self.loads.step.as_ref()
    }

    /// ∫f over the cells.
    pub fn cells(&self) -> CellLoads<'_, R> {
        self.loads.cells()
    }

    /// Boundary records.
    ///
    /// # Errors
    /// Records that are not admissible in this scalar.
    pub fn boundary(&self) -> Result<Boundary<'_, R, u32>, Error> {
        self.loads.boundary(&self.edges)
    }

    /// Terms on the diagonal of the matrix beyond the element matrices.
    ///
    /// # Errors
    /// As for [`Assembled::boundary`].
    pub fn diagonal(&self) -> Result<DiagonalTerms<'_, R, u32>, Error> {
        self.loads.diagonal(&self.edges)
    }

    /// The fluxes (15) of `u`, which may have a low part, one an edge: see [`flux::recover`].
    ///
    /// # Errors
    /// Slices of the wrong length.
    pub fn recover(&self, u: &[R], low: &[R], flux: &mut [R]) -> Result<Recovered<R>, Error> {
        let (edges, k) = (&self.edges, self.stiffness());
        match &self.loads.step {
            Some(step) => {
                let loads = (self.cells(), step.storage(edges)?);
                flux::recover_in_step(edges, k, loads, u, low, flux)
            }
            None => flux::recover(edges, k, self.cells(), u, low, flux),
        }
    }

    /// The law on the contact edges.
    pub fn law(&self) -> Law<'_, R> {
        self.loads.law()
    }

    /// u_D on the Dirichlet edges.
    pub fn dirichlet(&self) -> &[R] {
        &self.loads.dirichlet
    }

    /// Matrix, load and bounds.
    ///
    /// # Errors
    /// Numbers that the scalar type cannot hold.
    pub fn system(&self) -> Result<System<'_, R, u32>, Error> {
        let counts = self.edges.counts();
        let matrix = Csr::new(&self.row_ptr, &self.col_idx, &self.values, counts.edges())?;
        let system = System::new(matrix, &self.load, self.law(), counts)?;
        let diagonal = self.diagonal()?;
        system.with_shifts(Shifts { part: &self.part, parts: self.parts, diagonal })
    }

    /// A cold start: unknowns at the gap on C and at the mean of all given values elsewhere, u_D in
    /// its place.
    pub fn start(&self) -> Vec<R> {
        let counts = self.edges.counts();
        let given = [&self.loads.gap, &self.loads.dirichlet];
        let number = given.iter().map(|values| values.len()).sum::<usize>().max(1) as f64;
        let sum: f64 = given.iter().flat_map(|values| values.iter()).map(|x| x.wide()).sum();
        let mut u = vec![R::narrow(sum / number); counts.free];
        u.extend(&self.loads.gap);
        u.extend(&self.loads.dirichlet);
        u
    }
}

/// A of every cell, triangles first; `None` where it varies inside a quad.
fn tensors<R: Scalar>(problem: &Problem) -> Option<Vec<Tensor<R>>> {
    let triangles = problem.coefficients.triangles.iter().map(Some);
    let quads = problem.coefficients.quads.iter().map(|quad| match quad {
        QuadCoefficient::Constant(a) => Some(a),
        QuadCoefficient::AtPoints(_) => None,
    });
    triangles.chain(quads).map(|a| a.map(narrowed)).collect()
}
