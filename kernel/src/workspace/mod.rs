//! Owned storage of fixed capacity, and the short way through the layers.
//!
//! A [`Workspace`] is a `static` or a local of the size that its type says; nothing is allocated. Build
//! it once for a mesh, then, as often as loads change, set them and solve: pattern, element matrices
//! and the last iterate stay, so that every solve starts warm. Who needs another arrangement takes the
//! layers themselves: they work on slices.

mod data;

use heapless::Vec;

use crate::assembly::{self, CellLoads};
use crate::boundary::{Neumann, Robin};
use crate::condition::{BoundaryEdge, Condition};
use crate::csr::Csr;
use crate::edges::{EdgeCounts, Edges};
use crate::error::{Array, Error, all_moderate};
use crate::index::Index;
use crate::math::Math;
use crate::mesh::Mesh;
use crate::numbering::{NumberingBuffers, number};
use crate::real::Real;
use crate::rows::{Row, Rows};
use crate::signorini::Shifts;
use crate::signorini::System;
use crate::solver::{Outcome, Settings, Solver};
use crate::stiffness::{self, Coefficient, Stiffness};
use crate::{contact, flux};

/// Everything one contact problem needs, for meshes up to the given numbers of vertices, triangles,
/// quads, boundary edges, edges **plus one**, matrix entries, and entries a packed row
/// ([`crate::rows::TRIANGLES`] = 4, with quads [`crate::rows::QUADS`] = 6).
///
/// A mesh of T triangles and Q quads with B boundary edges has (3T + 4Q + B)/2 edges, and at most
/// 5 (triangles) or 7 (quads) matrix entries an edge. Too small a capacity is an error that names the
/// array and the number that it needs.
#[derive(Debug)]
pub struct Workspace<
    R,
    I,
    const VERTICES: usize,
    const TRIANGLES: usize,
    const QUADS: usize,
    const BOUNDARY: usize,
    const EDGES: usize,
    const ENTRIES: usize,
    const WIDTH: usize,
> {
    at_vertex: Vec<[I; 2], VERTICES>,
    of_triangles: Vec<[I; 3], TRIANGLES>,
    of_quads: Vec<[I; 4], QUADS>,
    half_edges: Vec<[I; 2], EDGES>,
    counts: EdgeCounts,
    triangles: Vec<[R; 3], TRIANGLES>,
    quads: Vec<[R; 6], QUADS>,
    source_triangles: Vec<R, TRIANGLES>,
    source_quads: Vec<R, QUADS>,
    neumann: Vec<Neumann<R, I>, BOUNDARY>,
    robin: Vec<Robin<R, I>, BOUNDARY>,
    contact_flux: Vec<R, BOUNDARY>,
    gap: Vec<R, BOUNDARY>,
    row_ptr: Vec<u32, EDGES>,
    col_idx: Vec<I, ENTRIES>,
    values: Vec<R, ENTRIES>,
    rows: Vec<Row<R, I, WIDTH>, EDGES>,
    load: Vec<R, EDGES>,
    u: Vec<R, EDGES>,
    flux: Vec<R, EDGES>,
}

impl<
    R: Real,
    I: Index,
    const V: usize,
    const T: usize,
    const Q: usize,
    const B: usize,
    const E: usize,
    const N: usize,
    const W: usize,
> Default for Workspace<R, I, V, T, Q, B, E, N, W>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<
    R: Real,
    I: Index,
    const V: usize,
    const T: usize,
    const Q: usize,
    const B: usize,
    const E: usize,
    const N: usize,
    const W: usize,
> Workspace<R, I, V, T, Q, B, E, N, W>
{
    /// An empty workspace; can initialise a `static`.
    pub const fn new() -> Self {
        Self {
            at_vertex: Vec::new(),
            of_triangles: Vec::new(),
            of_quads: Vec::new(),
            half_edges: Vec::new(),
            counts: EdgeCounts { free: 0, contact: 0, dirichlet: 0 },
            triangles: Vec::new(),
            quads: Vec::new(),
            source_triangles: Vec::new(),
            source_quads: Vec::new(),
            neumann: Vec::new(),
            robin: Vec::new(),
            contact_flux: Vec::new(),
            gap: Vec::new(),
            row_ptr: Vec::new(),
            col_idx: Vec::new(),
            values: Vec::new(),
            rows: Vec::new(),
            load: Vec::new(),
            u: Vec::new(),
            flux: Vec::new(),
        }
    }

    /// Numbers the edges, computes element matrices and assembles. `condition` is asked for every
    /// boundary edge; the iterate starts at 0, on the gap and at the Dirichlet values.
    ///
    /// # Errors
    /// Capacities that are too small, meshes, coefficients or conditions that are not admissible.
    pub fn build(
        &mut self,
        mesh: &Mesh<R, I>,
        coefficient: Coefficient<R>,
        mut condition: impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<EdgeCounts, Error> {
        self.number_edges(mesh, &mut condition)?;
        fit(&mut self.triangles, mesh.triangles().len(), Array::Stiffness)?;
        fit(&mut self.quads, mesh.quads().len(), Array::Stiffness)?;
        stiffness::fill(mesh, coefficient, POINTS, &mut self.triangles, &mut self.quads)?;
        let nonzeros = self.edges()?.nonzeros();
        fit(&mut self.row_ptr, self.counts.unknowns() + 1, Array::RowPointers)?;
        fit(&mut self.col_idx, nonzeros, Array::MatrixValues)?;
        fit(&mut self.values, nonzeros, Array::MatrixValues)?;
        let (triangles, quads) = (&self.of_triangles, &self.of_quads);
        let edges = Edges::new(triangles, quads, &self.half_edges, self.counts)?;
        assembly::pattern(&edges, &mut self.row_ptr, &mut self.col_idx)?;
        fit(&mut self.rows, self.counts.unknowns(), Array::Rows)?;
        fit(&mut self.load, self.counts.unknowns(), Array::Load)?;
        fit(&mut self.u, self.counts.edges(), Array::Unknowns)?;
        fit(&mut self.flux, self.counts.edges(), Array::Fluxes)?;
        fit(&mut self.source_triangles, mesh.triangles().len(), Array::CellLoads)?;
        fit(&mut self.source_quads, mesh.quads().len(), Array::CellLoads)?;
        self.u.fill(R::ZERO);
        self.source_triangles.fill(R::ZERO);
        self.source_quads.fill(R::ZERO);
        self.set_conditions(mesh, condition)?;
        Ok(self.counts)
    }

    fn number_edges(
        &mut self,
        mesh: &Mesh<R, I>,
        condition: &mut impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<(), Error> {
        fit(&mut self.at_vertex, mesh.vertices().len(), Array::Vertices)?;
        fit(&mut self.of_triangles, mesh.triangles().len(), Array::Triangles)?;
        fit(&mut self.of_quads, mesh.quads().len(), Array::Quads)?;
        let most = E.min(mesh.half_edges());
        fit(&mut self.half_edges, most, Array::Edges)?;
        // The column indices are not needed yet: they lend their memory to the numbering.
        fit(&mut self.col_idx, most, Array::MatrixValues)?;
        let buffers = NumberingBuffers {
            of_triangles: &mut self.of_triangles,
            of_quads: &mut self.of_quads,
            half_edges: &mut self.half_edges,
            at_vertex: &mut self.at_vertex,
            next: &mut self.col_idx,
        };
        let block = |ends| condition(&BoundaryEdge::new(mesh, ends)).map(|found| found.block());
        self.counts = number(mesh, buffers, block)?.counts();
        self.half_edges.truncate(self.counts.edges());
        Ok(())
    }

    /// Solves from the present iterate and recovers the flux. Look at the outcome's status: the
    /// iterate is feasible and usable also where sweeps ran out.
    ///
    /// # Errors
    /// Data that are not finite or within 1/ε² of the largest number, where the answer may overflow (ψ, u_D, b and
    /// b_i/K_ii); a relaxation factor outside (0, 2). The last answer stays then, bit for bit.
    pub fn solve(&mut self, settings: Settings<R>) -> Result<Outcome<R>, Error> {
        // Borrowed apart, since moving an array out of the workspace would pass through the stack.
        let Self { of_triangles, of_quads, half_edges, counts, u, flux, .. } = self;
        let edges = Edges::new(of_triangles, of_quads, half_edges, *counts)?;
        let matrix = Csr::new(&self.row_ptr, &self.col_idx, &self.values, counts.edges())?;
        let shifts = Shifts { part: &[], parts: 1, robin: &self.robin };
        let system = System::new(matrix, &self.load, &self.gap, *counts)?.with_shifts(shifts)?;
        let (unknowns, dirichlet) = u.split_at_mut_checked(counts.unknowns()).unwrap_or_default();
        all_moderate(Array::Load, self.load.iter().copied())?;
        let steps = matrix.iter().zip(&self.load).map(|(row, &load)| load / row.diagonal());
        all_moderate(Array::Load, steps)?;
        all_moderate(Array::LowerBounds, self.gap.iter().copied())?;
        all_moderate(Array::Dirichlet, dirichlet.iter().copied())?;
        let mut solver = Solver::<R>::new(settings)?;
        if unknowns.iter().any(|u| !u.finite()) {
            // An overflow of the last solve: start anew.
            unknowns.fill(R::ZERO);
        }
        let mut rows = Rows::new(&edges, &mut self.rows)?;
        let outcome = solver.run(&system, &mut rows, u)?;
        let stiffness = Stiffness { triangles: &self.triangles, quads: &self.quads };
        let cells = CellLoads { triangles: &self.source_triangles, quads: &self.source_quads };
        flux::recover(&edges, stiffness, cells, u, &[], flux)?;
        Ok(outcome)
    }

    /// The edges and their order.
    ///
    /// # Errors
    /// None once [`Workspace::build`] has succeeded.
    pub fn edges(&self) -> Result<Edges<'_, I>, Error> {
        Edges::new(&self.of_triangles, &self.of_quads, &self.half_edges, self.counts)
    }

    /// Means of u over the edges.
    pub fn u(&self) -> &[R] {
        &self.u
    }

    /// ∫_E σ·n of every edge, outward on the boundary.
    pub fn flux(&self) -> &[R] {
        &self.flux
    }

    /// ∫_C (τ·n − q) ≥ 0: the sum of λ, within the law of contact wherever the solve was stopped
    /// ([`contact::force`]).
    pub fn contact_force(&self) -> R {
        let on_contact = self.u.iter().zip(&self.flux).skip(self.counts.free);
        let given = self.gap.iter().zip(&self.contact_flux);
        on_contact.zip(given).fold(R::ZERO, |sum, ((&u, &flux), (&lower, &given))| {
            sum + (contact::within_law(u, lower, flux, given) - given)
        })
    }

    /// Σ|E| over the active contact edges, lengths by the square root of `M`.
    ///
    /// # Errors
    /// None once [`Workspace::build`] has succeeded.
    pub fn contact_length<M: Math<R>>(&self, mesh: &Mesh<R, I>) -> Result<R, Error> {
        Ok(contact::length::<R, I, M>(mesh, &self.edges()?, &self.gap, &self.u))
    }
}

/// Gauss points a direction for quads: exact on parallelograms, a relative error of 2e−6 in the flux
/// on moderately distorted ones, at a quarter of the host's work.
const POINTS: usize = 4;

fn fit<T: Copy + Default, const N: usize>(
    storage: &mut Vec<T, N>,
    needed: usize,
    of: Array,
) -> Result<(), Error> {
    storage.clear();
    storage.resize_default(needed).map_err(|_| Error::Capacity { of, needed, limit: N })
}
