//! Features of this build of the kernel: one constant for each Cargo feature.
//!
//! Code for what a scene does not have is left out where its constant is false, and what would need it
//! is refused by the constructors: a mesh of quads by [`crate::mesh::edges::Edges::new`], say.

/// Triangles.
pub const TRIANGLES: bool = cfg!(feature = "triangles");
/// Quads.
pub const QUADS: bool = cfg!(feature = "quads");
/// Cells in which A in reference coordinates is not constant.
pub const VARYING: bool = cfg!(feature = "varying");
/// Cells whose points do not resolve A, and transfer edges whose points do not see h.
pub const PIECES: bool = cfg!(feature = "pieces");
/// Quads of the nonparametric element that are no parallelograms.
pub const DISTORTED: bool = cfg!(feature = "distorted");
/// Contact edges.
pub const CONTACT: bool = cfg!(feature = "contact");
/// Contact edges whose flux has another range than "from ∫q on".
pub const LIMITED: bool = cfg!(feature = "limited");
/// Transfer laws.
pub const ROBIN: bool = cfg!(feature = "robin");
/// Transfer coefficients that inputs of a full model change.
pub const TRANSFER: bool = cfg!(feature = "transfer");
/// Cells that store u in a step of time.
pub const STORAGE: bool = cfg!(feature = "storage");
/// Gaps and Dirichlet values that are not affine along an edge.
pub const CURVED: bool = cfg!(feature = "curved");
/// Each cell's share in the error bound.
pub const INDICATORS: bool = cfg!(feature = "indicators");
/// Whether there is the fast square root: modules that take it ask at compile time.
pub const MICROMATH: bool = cfg!(feature = "micromath");
