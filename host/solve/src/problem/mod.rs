//! A scene on its mesh: every integral that the method needs, in f64, before a scalar is chosen.
//!
//! ```text
//!   Scene + Mesh ─► binding (names to cells and edges) ─► edges ─► integrals ─► Problem ─► Assembled<R>
//! ```

mod assembled;
mod binding;
mod corners;
mod element_matrices;
mod integrals;
mod loads;
mod solvability;
mod sum;
#[cfg(test)]
mod tests;
mod unit_box;
mod warnings;

pub use assembled::Assembled;
pub use binding::Binding;
pub use loads::Loads;
pub use solvability::Parts;
pub use sum::Sum;

use signorini_kernel::edges::{Block, EdgeCounts, Edges};
use signorini_kernel::element::QuadElement;
use signorini_kernel::mesh::Mesh as KernelMesh;
use signorini_kernel::numbering::{NumberingBuffers, number};
use signorini_kernel::{Error as KernelError, Tensor, error::CellId};

use signorini_scene::error::{InputError, Result};
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Condition, Scene};

/// What lies on an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// Between two cells.
    Interior,
    /// Given value.
    Dirichlet,
    /// Given flux.
    Neumann,
    /// Transfer law.
    Robin,
    /// Unilateral contact.
    Contact,
}

impl EdgeKind {
    /// Its name in `edges.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Interior => "interior",
            Self::Dirichlet => "dirichlet",
            Self::Neumann => "neumann",
            Self::Robin => "robin",
            Self::Contact => "contact",
        }
    }

    fn of(condition: &Condition) -> Self {
        match condition {
            Condition::Dirichlet { .. } => Self::Dirichlet,
            Condition::Neumann { .. } => Self::Neumann,
            Condition::Robin { .. } => Self::Robin,
            Condition::Contact { .. } => Self::Contact,
        }
    }

    fn block(self) -> Block {
        match self {
            Self::Interior | Self::Neumann | Self::Robin => Block::Free,
            Self::Contact => Block::Contact,
            Self::Dirichlet => Block::Dirichlet,
        }
    }
}

/// Edge numbering of a mesh, owned; see [`signorini_kernel::edges`] for the order.
#[derive(Debug, Clone, Default)]
pub struct Topology {
    /// The edge of each side of each triangle.
    pub of_triangles: Vec<[u32; 3]>,
    /// The edge of each side of each quad.
    pub of_quads: Vec<[u32; 4]>,
    /// The half-edges of each edge.
    pub half_edges: Vec<[u32; 2]>,
    /// Sizes of the blocks.
    pub counts: EdgeCounts,
}

/// A as the element matrices need it.
#[derive(Debug, Clone)]
pub struct Coefficients {
    /// The mean over each triangle.
    pub triangles: Vec<Tensor<f64>>,
    /// Constant quads have one tensor, others the 8×8 quadrature points of theirs.
    pub quads: Vec<QuadCoefficient>,
}

/// A on one quad.
#[derive(Debug, Clone)]
pub enum QuadCoefficient {
    /// The same everywhere.
    Constant(Tensor<f64>),
    /// At the 8×8 Gauss points, x̂ running fastest.
    AtPoints(Vec<Tensor<f64>>),
}

/// Everything that defines one discrete contact problem.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The mesh as read.
    pub mesh: Mesh,
    /// Edge numbering.
    pub topology: Topology,
    /// Start and end vertex of each edge: the normal is this direction turned clockwise.
    pub ends: Vec<[u32; 2]>,
    /// |E|
    pub lengths: Vec<f64>,
    /// What lies on each edge.
    pub kinds: Vec<EdgeKind>,
    /// What u_h is made of on quads.
    pub element: QuadElement,
    /// Which names mean which cells and edges.
    pub binding: Binding,
    /// A.
    pub coefficients: Coefficients,
    /// Loads, gaps and boundary values at `time`.
    pub loads: Loads,
    /// The time t of the loads and of the exact solution.
    pub time: f64,
    /// What was found and is no error, but may not be meant: a sentence each.
    pub warnings: Vec<String>,
}

impl Problem {
    /// Binds `scene` to `mesh` and integrates its data at time t = 0.
    ///
    /// # Errors
    /// Names that do not match, boundary edges without a condition, conditions inside the domain, data that are
    /// not finite or not admissible; each names the culprit.
    pub fn new(scene: &Scene, mesh: Mesh) -> Result<Self> {
        let binding = Binding::new(scene, &mesh)?;
        let topology = number_edges(scene, &mesh, &binding)?;
        let kernel_mesh = KernelMesh::new(&mesh.vertices, &mesh.triangles, &mesh.quads)
            .map_err(|error| wrong_mesh(scene, error))?;
        let edges = topology.edges().map_err(|error| wrong_mesh(scene, error))?;
        let count = topology.counts.edges();
        let ends: Vec<_> = (0..count).map(|edge| edges.endpoints(&kernel_mesh, edge)).collect();
        let outer = topology.half_edges.iter().zip(&ends).filter(|(pair, _)| pair[1] == u32::MAX);
        let outer: Vec<_> = outer.map(|(_, &ends)| ends).collect();
        outer.iter().try_for_each(|&ends| binding.check_once(scene, &mesh, ends))?;
        Binding::check_outside(scene, &mesh, outer.iter().copied())?;
        let kinds: Vec<_> =
            (0..count).map(|edge| binding.kind(scene, &topology, edge, ends[edge])).collect();
        let at = |ends: [u32; 2]| ends.map(|vertex| mesh.vertices[vertex as usize]);
        let lengths =
            ends.iter().map(|&ends| signorini_scene::mesh::shape::edge_length(at(ends))).collect();
        let coefficients = integrals::coefficients(scene, &mesh, &binding)?;
        let mut problem = Self {
            mesh,
            topology,
            ends,
            lengths,
            kinds,
            element: scene.setting.unwrap_or_default().element,
            binding,
            coefficients,
            loads: Loads::default(),
            time: 0.0,
            warnings: Vec::new(),
        };
        problem.set_time(scene, 0.0)?;
        problem.warnings = warnings::warnings(scene, &problem);
        Ok(problem)
    }

    /// Integrates the data of `scene` at time `time`; mesh, edges and A stay.
    ///
    /// # Errors
    /// Data that are not finite or not admissible at that time.
    pub fn set_time(&mut self, scene: &Scene, time: f64) -> Result<()> {
        self.loads = Loads::at_time(scene, self, time)?;
        self.time = time;
        corners::check(scene, self)
    }

    /// Number of cells: triangles, then quads.
    pub fn cells(&self) -> usize {
        self.mesh.triangles.len() + self.mesh.quads.len()
    }

    /// The largest entry of an element matrix.
    pub fn stiffest(&self) -> f64 {
        Assembled::<f64>::new(self).map_or(0.0, |assembled| {
            let stiffness = assembled.stiffness();
            let entries = stiffness.triangles.as_flattened().iter();
            let entries = entries.chain(stiffness.quads.as_flattened());
            entries.fold(0.0, |most: f64, entry| most.max(entry.abs()))
        })
    }

    /// Coordinates of the ends of an edge.
    pub fn segment(&self, edge: usize) -> [[f64; 2]; 2] {
        self.ends[edge].map(|vertex| self.mesh.vertices[vertex as usize])
    }

    /// The vertices of cell `at`, triangles first.
    pub fn vertices_of(&self, at: usize) -> &[u32] {
        match self.mesh.triangles.get(at) {
            Some(vertices) => vertices,
            None => &self.mesh.quads[at - self.mesh.triangles.len()],
        }
    }
}

impl Topology {
    /// The kernel's view of it.
    ///
    /// # Errors
    /// Never for a topology that [`Problem::new`] made.
    pub fn edges(&self) -> std::result::Result<Edges<'_, u32>, KernelError> {
        Edges::new(&self.of_triangles, &self.of_quads, &self.half_edges, self.counts)
    }

    /// The cell (triangles first) and the side of it that an edge is directed along; its normal
    /// points out of that cell.
    pub fn first_side(&self, edge: usize) -> (usize, usize) {
        let triangles = self.of_triangles.len();
        let half = self.half_edges[edge][0] as usize;
        match half.checked_sub(3 * triangles) {
            None => (half / 3, half % 3),
            Some(rest) => (triangles + rest / 4, rest % 4),
        }
    }
}

fn number_edges(scene: &Scene, mesh: &Mesh, binding: &Binding) -> Result<Topology> {
    let kernel_mesh = KernelMesh::new(&mesh.vertices, &mesh.triangles, &mesh.quads)
        .map_err(|error| wrong_mesh(scene, error))?;
    let sides = kernel_mesh.half_edges();
    let mut topology = Topology {
        of_triangles: vec![[0; 3]; mesh.triangles.len()],
        of_quads: vec![[0; 4]; mesh.quads.len()],
        half_edges: vec![[0; 2]; sides],
        counts: EdgeCounts::default(),
    };
    let buffers = NumberingBuffers {
        of_triangles: &mut topology.of_triangles,
        of_quads: &mut topology.of_quads,
        half_edges: &mut topology.half_edges,
        at_vertex: &mut vec![[0; 2]; mesh.vertices.len()],
        next: &mut vec![0; sides],
    };
    let block = |ends| {
        let boundary = binding.boundary(ends)?;
        Some(EdgeKind::of(&scene.boundaries[boundary].condition).block())
    };
    let counts = number(&kernel_mesh, buffers, block).map(|edges| edges.counts());
    topology.counts = counts.map_err(|error| match error {
        KernelError::NoCondition(ends) => binding.unbound(scene, mesh, ends),
        error => wrong_mesh(scene, error),
    })?;
    topology.half_edges.truncate(topology.counts.edges());
    Ok(topology)
}

/// A mesh that the kernel refuses.
fn wrong_mesh(scene: &Scene, error: KernelError) -> InputError {
    let what = match error {
        KernelError::Degenerate(CellId::Triangle(_) | CellId::Quad(_)) => {
            "the mesh has a cell too thin for the scalar type"
        }
        _ => "the mesh is not usable",
    };
    InputError::new(format!("{what}: {error}"))
        .file(&scene.mesh.value)
        .hint("cells are numbered from 0, triangles first, in the order of the file")
}
