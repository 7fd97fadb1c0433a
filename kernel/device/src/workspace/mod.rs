//! Owned storage of fixed capacity, and the short way through the layers.
//!
//! A [`Workspace`] is a `static` or a local of the size that its type says; nothing is allocated. Build
//! it once for a mesh, then, as often as loads change, set them and tick or solve: pattern, element matrices
//! and the last iterate stay, so that every one starts warm. Who needs another arrangement takes the
//! layers themselves: they work on slices.

mod answers;
mod bound;
mod conditions;
mod sizes;

use heapless::Vec;

use crate::condition::{BoundaryEdge, Condition};
use crate::tick::Progress;
use signorini_bound::conforming::VertexData;
use signorini_kernel::error::{Array, Error};
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::rows::OwnedRows;
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Index, Math, Mesh, Real, assembly};

use bound::{BoundSupport, Equilibration};

/// Everything one contact problem needs, for meshes up to the given numbers of vertices, triangles, quads, boundary
/// edges, cells, edges plus one, matrix entries, and entries of a packed row. [`workspace!`](macro@crate::workspace) works
/// out the last four from the others.
///
/// Too small a capacity is an error that names the array and the number that it needs. Without room for matrix entries
/// it [`tick`](Workspace::tick)s and does not [`solve`](Workspace::solve).
#[derive(Debug, Default)]
pub struct Workspace<
    R: Real,
    I: Index,
    const VERTICES: usize,
    const TRIANGLES: usize,
    const QUADS: usize,
    const BOUNDARY: usize,
    const CELLS: usize,
    const EDGES: usize,
    const ENTRIES: usize,
    const WIDTH: usize,
> {
    at_vertex: Vec<[I; 2], VERTICES>,
    of_triangles: Vec<[I; 3], TRIANGLES>,
    of_quads: Vec<[I; 4], QUADS>,
    half_edges: Vec<[I; 2], EDGES>,
    counts: EdgeCounts,
    /// The boundary edges, ascending.
    boundary: Vec<I, BOUNDARY>,
    /// Their lengths.
    lengths: Vec<R, BOUNDARY>,
    triangles: Vec<[R; 3], TRIANGLES>,
    quads: Vec<[R; 6], QUADS>,
    source_triangles: Vec<R, TRIANGLES>,
    source_quads: Vec<R, QUADS>,
    neumann: Vec<Neumann<R, I>, BOUNDARY>,
    robin: Vec<Robin<R, I>, BOUNDARY>,
    contact_flux: Vec<R, BOUNDARY>,
    gap: Vec<R, BOUNDARY>,
    gap_ends: Vec<[R; 2], BOUNDARY>,
    dirichlet: Vec<R, BOUNDARY>,
    dirichlet_ends: Vec<[R; 2], BOUNDARY>,
    /// Whether all is as [`Workspace::build`] and the last conditions ask, with matrix and ways out those of `robin`.
    built: bool,
    /// That of the cells' vertices.
    fingerprint: u32,
    /// ∫_C (τ·n − q) of the last answer.
    force: R,
    row_ptr: Vec<u32, EDGES>,
    col_idx: Vec<I, ENTRIES>,
    values: Vec<R, ENTRIES>,
    rows: OwnedRows<R, I, WIDTH, EDGES>,
    load: Vec<R, EDGES>,
    u: Vec<R, EDGES>,
    flux: Vec<R, EDGES>,
    equilibration: Equilibration<R, I, VERTICES, TRIANGLES, QUADS, CELLS, EDGES>,
    /// What the boundary data allow for.
    support: BoundSupport,
    active: Vec<bool, BOUNDARY>,
    vertices: Vec<R, VERTICES>,
    bubbles: Vec<R, EDGES>,
    progress: Progress<R>,
}

impl<
    R: Real,
    I: Index,
    const V: usize,
    const T: usize,
    const Q: usize,
    const B: usize,
    const C: usize,
    const E: usize,
    const N: usize,
    const W: usize,
> Workspace<R, I, V, T, Q, B, C, E, N, W>
{
    /// An empty workspace; can initialise a `static`.
    pub const fn new() -> Self {
        Self {
            at_vertex: Vec::new(),
            of_triangles: Vec::new(),
            of_quads: Vec::new(),
            half_edges: Vec::new(),
            counts: EdgeCounts { free: 0, contact: 0, dirichlet: 0 },
            boundary: Vec::new(),
            lengths: Vec::new(),
            triangles: Vec::new(),
            quads: Vec::new(),
            source_triangles: Vec::new(),
            source_quads: Vec::new(),
            neumann: Vec::new(),
            robin: Vec::new(),
            contact_flux: Vec::new(),
            gap: Vec::new(),
            gap_ends: Vec::new(),
            dirichlet: Vec::new(),
            dirichlet_ends: Vec::new(),
            built: false,
            fingerprint: 0,
            force: R::ZERO,
            row_ptr: Vec::new(),
            col_idx: Vec::new(),
            values: Vec::new(),
            rows: OwnedRows::new(),
            load: Vec::new(),
            u: Vec::new(),
            flux: Vec::new(),
            equilibration: Equilibration::new(),
            support: BoundSupport::Bound,
            active: Vec::new(),
            vertices: Vec::new(),
            bubbles: Vec::new(),
            progress: Progress::NONE,
        }
    }

    /// Numbers the edges, computes element matrices and assembles. `condition` is asked twice for every
    /// boundary edge; the iterate, the source and the relaxation start anew. It takes an index per edge of stack.
    ///
    /// # Errors
    /// Capacities that are too small, meshes, coefficients or conditions that are not admissible. Nothing else works then
    /// before another mesh is built.
    pub fn build(
        &mut self,
        mesh: &Mesh<R, I>,
        coefficient: Coefficient<R>,
        mut condition: impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<EdgeCounts, Error> {
        self.built = false;
        self.progress = Progress::NONE;
        self.fingerprint = fingerprint(mesh);
        self.robin.clear();
        self.number_edges(mesh, &mut condition)?;
        fit(&mut self.triangles, mesh.triangles().len(), Array::Stiffness)?;
        fit(&mut self.quads, mesh.quads().len(), Array::Stiffness)?;
        stiffness::fill(mesh, coefficient, POINTS, &mut self.triangles, &mut self.quads)?;
        if N > 0 {
            self.lay_out_matrix()?;
        }
        self.fit_answer(mesh)?;
        self.equilibration.build(mesh, coefficient, POINTS, self.counts.edges())?;
        self.replace_conditions(mesh, condition)?;
        self.built = false;
        let edges = Edges::baked(&self.of_triangles, &self.of_quads, &self.half_edges, self.counts);
        self.rows.within(&edges)?;
        self.built = true;
        Ok(self.counts)
    }

    fn lay_out_matrix(&mut self) -> Result<(), Error> {
        let nonzeros = self.numbered().nonzeros();
        fit(&mut self.row_ptr, self.counts.unknowns() + 1, Array::RowPointers)?;
        fit(&mut self.col_idx, nonzeros, Array::MatrixValues)?;
        fit(&mut self.values, nonzeros, Array::MatrixValues)?;
        let (triangles, quads) = (&self.of_triangles, &self.of_quads);
        let edges = Edges::baked(triangles, quads, &self.half_edges, self.counts);
        assembly::pattern(&edges, &mut self.row_ptr, &mut self.col_idx)
    }

    /// Room for data and answer, all of it 0.
    fn fit_answer(&mut self, mesh: &Mesh<R, I>) -> Result<(), Error> {
        let counts = self.counts;
        self.rows.forget();
        fit(&mut self.load, counts.unknowns(), Array::Load)?;
        fit(&mut self.u, counts.edges(), Array::Unknowns)?;
        fit(&mut self.flux, counts.edges(), Array::Fluxes)?;
        fit(&mut self.source_triangles, mesh.triangles().len(), Array::CellLoads)?;
        fit(&mut self.source_quads, mesh.quads().len(), Array::CellLoads)?;
        fit(&mut self.active, counts.contact, Array::Contact)?;
        fit(&mut self.vertices, mesh.vertices().len(), Array::Vertices)?;
        self.force = R::ZERO;
        let bubbles = if mesh.quads().is_empty() { 0 } else { counts.edges() };
        fit(&mut self.bubbles, bubbles, Array::Scratch)
    }

    /// The edges and their order.
    ///
    /// # Errors
    /// None once [`Workspace::build`] has succeeded.
    pub fn edges(&self) -> Result<Edges<'_, I>, Error> {
        Edges::new(&self.of_triangles, &self.of_quads, &self.half_edges, self.counts)
    }

    /// The same, as [`Workspace::build`] has numbered them.
    fn numbered(&self) -> Edges<'_, I> {
        Edges::baked(&self.of_triangles, &self.of_quads, &self.half_edges, self.counts)
    }

    /// Means of u over the edges.
    pub fn u(&self) -> &[R] {
        &self.u
    }

    /// ∫_E σ·n of every edge, outward on the boundary: the flux (15) after a solve, the equilibrated τ of the bound after
    /// a tick.
    pub fn flux(&self) -> &[R] {
        &self.flux
    }

    /// ∫_C (τ·n − q) ≥ 0 of the last answer: the sum of λ, within the law of contact wherever the solve was stopped
    /// ([`signorini_kernel::contact::force`]).
    pub fn contact_force(&self) -> R {
        self.force
    }

    /// Σ|E| over the contact edges that touch in the last answer, lengths by the square root of `M`.
    ///
    /// # Errors
    /// None once [`Workspace::build`] has succeeded.
    pub fn contact_length<M: Math<R>>(&self, mesh: &Mesh<R, I>) -> Result<R, Error> {
        let edges = self.edges()?;
        let touching = self.active.iter().enumerate().filter(|(_, active)| **active);
        let length = |(at, _): (usize, &bool)| edges.length::<R, M>(mesh, self.counts.free + at);
        Ok(touching.map(length).fold(R::ZERO, |sum, length| sum + length))
    }

    fn cells(&self) -> usize {
        self.of_triangles.len() + self.of_quads.len()
    }
}

/// A number that other cells hardly have.
fn fingerprint<R: Real, I: Index>(mesh: &Mesh<R, I>) -> u32 {
    let cells = mesh.triangles().as_flattened().iter().chain(mesh.quads().as_flattened());
    // 32-bit FNV.
    cells.fold(0x811c_9dc5, |hash: u32, vertex| {
        (hash ^ vertex.at() as u32).wrapping_mul(0x0100_0193)
    })
}

/// Gauss points a direction for quads: exact on parallelograms, a relative error of 2e−6 in the flux
/// on moderately distorted ones, at a quarter of the host's work.
const POINTS: usize = 4;

fn stiffness_of<'a, R>(triangles: &'a [[R; 3]], quads: &'a [[R; 6]]) -> Stiffness<'a, R> {
    Stiffness { triangles, quads }
}

fn ends<'a, R>(gap: &'a [[R; 2]], given: &'a [[R; 2]]) -> VertexData<'a, R> {
    VertexData { gap, given }
}

fn fit<T: Copy + Default, const N: usize>(
    storage: &mut Vec<T, N>,
    needed: usize,
    of: Array,
) -> Result<(), Error> {
    storage.clear();
    storage.resize_default(needed).map_err(|_| Error::Capacity { of, needed, limit: N })
}
