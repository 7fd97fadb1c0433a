//! The groups of a scene on its mesh: names bound to cells and edges, and everything that is wrong with them.

use signorini_kernel::mesh::Mesh as KernelMesh;
use signorini_scene::error::Result;
use signorini_scene::faults::Faults;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::Scene;

use crate::topology::wrong_mesh;
use crate::{Binding, Topology};

/// A mesh whose edges are numbered, each cell and boundary edge with its group.
pub(super) struct Groups {
    pub binding: Binding,
    pub topology: Topology,
    /// Start and end vertex of each edge.
    pub ends: Vec<[u32; 2]>,
}

/// The groups of `scene` on `mesh`.
///
/// # Errors
/// Every name that does not match, every curve or surface without a table or with two, conditions inside the domain; a mesh
/// that the kernel refuses.
pub(super) fn bind(scene: &Scene, mesh: &Mesh) -> Result<Groups> {
    let faults = Faults::default();
    let binding = Binding::new(scene, mesh, &faults);
    let kernel_mesh = KernelMesh::new(&mesh.vertices, &mesh.triangles, &mesh.quads)
        .map_err(|error| wrong_mesh(scene, error))?;
    let (topology, uncovered) = Topology::number(scene, mesh, &kernel_mesh, &binding)?;
    let edges = topology.edges().map_err(|error| wrong_mesh(scene, error))?;
    let ends = (0..edges.counts().edges()).map(|edge| edges.endpoints(&kernel_mesh, edge));
    let ends: Vec<[u32; 2]> = ends.collect();
    let outer = (0..ends.len()).filter(|&edge| topology.is_outer(edge)).map(|edge| ends[edge]);
    let outer: Vec<_> = outer.collect();
    Binding::check_covered(scene, mesh, &uncovered, &faults);
    binding.check_once(scene, mesh, &outer, &faults);
    Binding::check_outside(scene, mesh, &outer, &faults);
    faults.into_result()?;
    Ok(Groups { binding, topology, ends })
}

/// Checks the groups of a scene on its mesh and nothing else.
///
/// # Errors
/// Every name that does not match, every curve or surface without a table or with two, conditions inside the domain; a mesh
/// that the kernel refuses.
pub fn check_groups(scene: &Scene, mesh: &Mesh) -> Result<()> {
    bind(scene, mesh).map(drop)
}
