//! Boundary conditions as a user states them: by place, in the units of the problem.
//!
//! The kernel's own arrays hold integrals over numbered edges ([`signorini_kernel::mesh::boundary`]). Here a condition
//! belongs to a boundary edge that is known by its end points, and its numbers are means over that
//! edge, so that nobody needs to know a number of an edge or its length.

use signorini_kernel::index::{Index, read};
use signorini_kernel::mesh::edges::Block;
use signorini_kernel::{Mesh, Real};

/// The condition on one boundary edge; n points outward, flux is A∇u·n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Condition<R> {
    /// u = `value` all along the edge.
    Dirichlet {
        /// u_D
        value: R,
    },
    /// u goes from one of `values` to the other.
    DirichletBetween {
        /// u_D at the [`BoundaryEdge::ends`].
        values: [R; 2],
    },
    /// A∇u·n = `flux`.
    Neumann {
        /// Mean of g.
        flux: R,
    },
    /// A∇u·n = `coefficient` (`ambient` − u).
    Robin {
        /// Mean of h, not negative.
        coefficient: R,
        /// Mean of u_ext.
        ambient: R,
    },
    /// u ≥ `gap`, A∇u·n ≥ `flux`, and one of both is an equality.
    Contact {
        /// ψ, the same all along the edge.
        gap: R,
        /// Mean of q.
        flux: R,
    },
    /// The same with a gap that goes from one of `gaps` to the other.
    ContactBetween {
        /// ψ at the [`BoundaryEdge::ends`].
        gaps: [R; 2],
        /// Mean of q.
        flux: R,
    },
}

impl<R: Real> Condition<R> {
    /// u_D or ψ at the ends of the edge, or nothing where neither is given.
    pub(crate) fn ends(&self) -> Option<[R; 2]> {
        match *self {
            Self::Dirichlet { value } | Self::Contact { gap: value, .. } => Some([value; 2]),
            Self::DirichletBetween { values } | Self::ContactBetween { gaps: values, .. } => {
                Some(values)
            }
            Self::Neumann { .. } | Self::Robin { .. } => None,
        }
    }

    /// Where an edge with this condition stands among the unknowns.
    pub fn block(&self) -> Block {
        match self {
            Self::Neumann { .. } | Self::Robin { .. } => Block::Free,
            Self::Contact { .. } | Self::ContactBetween { .. } => Block::Contact,
            Self::Dirichlet { .. } | Self::DirichletBetween { .. } => Block::Dirichlet,
        }
    }
}

/// A boundary edge, counterclockwise around its cell: the domain is on its left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryEdge<R, I> {
    /// Its vertices.
    pub vertices: [I; 2],
    /// Their coordinates.
    pub ends: [[R; 2]; 2],
}

impl<R: Real, I: Index> BoundaryEdge<R, I> {
    pub(crate) fn new(mesh: &Mesh<R, I>, vertices: [I; 2]) -> Self {
        Self { vertices, ends: vertices.map(|vertex| read(mesh.vertices(), vertex.at())) }
    }

    /// The point halfway between its ends.
    pub fn middle(&self) -> [R; 2] {
        let [a, b] = self.ends;
        [R::HALF * (a[0] + b[0]), R::HALF * (a[1] + b[1])]
    }
}
