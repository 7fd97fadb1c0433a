//! A scene on its mesh: every integral that the method needs, in f64, before a scalar is chosen.
//!
//! ```text
//!   Scene + Mesh ─► binding (names to cells and edges) ─► topology ─► integrals ─► Problem ─► Assembled<R>
//!                                        other loads or units on the same mesh ◄─ restated ◄─┘
//! ```
//! [`Approach`] says what can be done with it, and what not: no other place decides that.
//!
//! A [`Problem`] keeps the scene that states it: whoever has the one asks it for expressions, setting and places in the
//! file. Clones share what does not change: mesh, edges and A.

mod assembled;
mod balance;
mod bilinear;
mod binding;
pub mod cell;
mod corners;
mod element_matrices;
pub mod field;
pub mod fixtures;
pub mod functional;
mod groups;
pub mod inputs;
mod integrals;
mod lacks;
mod limits;
mod loads;
mod lowest;
pub mod outline;
pub mod pieces;
mod pinched;
pub mod pointwise;
mod polygon;
pub mod progress;
mod property;
pub mod quadrature;
pub mod random;
mod restated;
mod room;
pub mod rounding;
pub mod scalar;
pub mod search;
mod solvability;
mod step;
mod stored;
mod sum;
pub mod tensors;
#[cfg(test)]
mod tests;
pub mod threads;
mod topology;
mod transfer;
pub mod triangular;
mod warnings;
mod widths;

pub use assembled::Assembled;
pub use binding::Binding;
pub use corners::Exclusion;
pub use groups::check_groups;
pub use integrals::{Coefficients, QuadCoefficient};
pub use lacks::{Approach, Lack};
pub use limits::RangeTerm;
pub use loads::Loads;
pub use property::Property;
pub use room::{Room, rooms};
pub use solvability::{BALANCE, Parts};
pub use step::{State, Step, Trace};
pub use sum::Sum;
pub use topology::{EdgeKind, Topology};
pub use transfer::TransferPattern;
pub use widths::{excess, excess_within_ranges};

use std::sync::Arc;

use signorini_kernel::Real;
use signorini_kernel::element::QuadElement;

use element_matrices::ElementMatrices;
use groups::Groups;
use quadrature::DATA_POINTS;
use signorini_scene::error::Result;
use signorini_scene::faults::Faults;
use signorini_scene::mesh::{Mesh, shape};
use signorini_scene::scene::units::Units;
use signorini_scene::scene::{Boundary, Field, Input, Scene};

/// Everything that defines one discrete contact problem.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The scene that states it, its inputs at the values of the loads.
    pub scene: Arc<Scene>,
    /// The mesh as read.
    pub mesh: Arc<Mesh>,
    /// Edge numbering.
    pub topology: Arc<Topology>,
    /// Start and end vertex of each edge: the normal is this direction turned clockwise.
    pub ends: Arc<[[u32; 2]]>,
    /// |E|
    pub lengths: Arc<[f64]>,
    /// Kind of each edge.
    pub kinds: Arc<[EdgeKind]>,
    /// Element of u_h on quads.
    pub element: QuadElement,
    /// Which names mean which cells and edges.
    pub binding: Arc<Binding>,
    /// A.
    pub coefficients: Arc<Coefficients>,
    /// (∫_T c)/m of each cell T with m sides, c the capacity; nothing where no material stores anything.
    pub capacities: Arc<[f64]>,
    /// Loads, gaps and boundary values at `time`.
    pub loads: Loads,
    /// The time t of the loads and of the exact solution.
    pub time: f64,
    /// The units of all its numbers, in those of the scene as it was given.
    pub units: Units,
    /// Findings that are no errors, but may not be meant: a sentence each.
    pub warnings: Vec<String>,
}

impl Problem {
    /// Binds `scene` to `mesh` and integrates its data at time t = 0.
    ///
    /// # Errors
    /// Names that do not match, boundary edges without a condition, conditions inside the domain, data that are
    /// not finite or not admissible; each names the culprit.
    pub fn new(scene: &Scene, mesh: impl Into<Arc<Mesh>>) -> Result<Self> {
        let mesh = mesh.into();
        let Groups { binding, topology, ends } = groups::bind(scene, &mesh)?;
        if let Some(parted) = pinched::parted(&mesh, &topology, &ends) {
            return Self::new(scene, parted);
        }
        let count = topology.counts.edges();
        let kinds = (0..count).map(|edge| binding.kind(scene, &topology, edge, ends[edge]));
        let at = |ends: [u32; 2]| ends.map(|vertex| mesh.vertices[vertex as usize]);
        let lengths = ends.iter().map(|&ends| shape::edge_length(at(ends)));
        let faults = Faults::default();
        let coefficients = faults.keep(integrals::coefficients(scene, &mesh, &binding, None));
        let capacities = faults.keep(step::capacities(scene, &mesh, &binding));
        let mut problem = Self {
            scene: Arc::new(scene.clone()),
            kinds: kinds.collect(),
            lengths: lengths.collect(),
            topology: Arc::new(topology),
            ends: ends.into(),
            element: scene.setting.unwrap_or_default().element,
            capacities: capacities.unwrap_or_default(),
            mesh,
            binding: Arc::new(binding),
            coefficients: Arc::new(coefficients.unwrap_or_default()),
            loads: Loads::default(),
            time: 0.0,
            units: Units::default(),
            warnings: Vec::new(),
        };
        faults.keep(problem.set_time(0.0));
        faults.into_result()?;
        let faults = Faults::default();
        faults.keep(transfer::check(&problem));
        faults.keep(corners::check_within_ranges(&problem));
        faults.into_result()?;
        problem.warnings = warnings::warnings(&problem);
        Ok(problem)
    }

    /// Number of cells: triangles, then quads.
    pub fn cells(&self) -> usize {
        self.mesh.triangles.len() + self.mesh.quads.len()
    }

    /// The largest entry of an element matrix.
    pub fn stiffest(&self) -> f64 {
        ElementMatrices::<f64>::of(self).map_or(0.0, |matrices| {
            matrices.entries().fold(0.0, |most: f64, entry| most.max(entry.abs()))
        })
    }

    /// Coordinates of the ends of an edge.
    pub fn segment(&self, edge: usize) -> [[f64; 2]; 2] {
        self.mesh.segment(self.ends[edge])
    }

    /// The point of an edge at the part t of its way.
    pub fn along(&self, edge: usize, t: f64) -> [f64; 2] {
        let [a, b] = self.segment(edge);
        [0, 1].map(|k| a[k] + t * (b[k] - a[k]))
    }

    /// The points of the rule for edge data, and both ends of the edge.
    fn rule_points(&self, edge: usize) -> impl Iterator<Item = [f64; 2]> {
        let inside = f64::GAUSS[DATA_POINTS - 1].iter().map(|point| point[0]);
        inside.chain([0.0, 1.0]).map(move |t| self.along(edge, t))
    }

    /// The boundary of the scene that an edge lies on.
    pub fn boundary_of(&self, edge: usize) -> Option<&Boundary> {
        self.binding.boundary(self.ends[edge]).map(|at| &self.scene.boundaries[at])
    }

    /// The inputs that add to one of these fields of a boundary.
    pub fn inputs_of<'s>(
        &'s self,
        boundary: &'s Boundary,
        fields: &'s [Field],
    ) -> impl Iterator<Item = &'s Input> {
        let is_own = |input: &&Input| {
            fields.contains(&input.field.value) && input.of.value == boundary.name.value
        };
        self.scene.inputs.iter().filter(is_own)
    }

    /// The vertices of cell `at`, triangles first.
    pub fn vertices_of(&self, at: usize) -> &[u32] {
        self.mesh.corners_of(at)
    }
}
