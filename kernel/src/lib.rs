#![no_std]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// `!(a < b)` is meant: it is true where a or b is NaN.
#![allow(clippy::neg_cmp_op_on_partial_ord)]
//! # Signorini, the kernel
//!
//! Unilateral contact inside a control loop: `no_std`, no allocation, no panic, fixed memory.
//!
//! The problem: find u on a polygon cut into triangles and quads with
//! ```text
//!   −∇·(A∇u) = f       in the domain       A: symmetric positive definite tensor, one a cell or varying
//!   u = u_D            on D (Dirichlet)
//!   A∇u·n = g          on N (Neumann)      n: outward normal; flux is σ = A∇u, without a minus sign
//!   A∇u·n = h(u_ext−u) on R (Robin)
//!   u ≥ ψ,  A∇u·n ≥ q,  (u − ψ)(A∇u·n − q) = 0       on C (contact)
//! ```
//! The method: K.-Y. Kim, *Mixed finite volume method on non-staggered grids for the Signorini problem*.
//! One unknown an edge, the mean of u over it; equation numbers in these pages are that paper's.
//!
//! ## An example
//!
//! A heated bar: 0 °C outside on the left, a heater on the right that keeps at least 2 °C.
//! ```
//! use signorini_kernel::condition::Condition;
//! use signorini_kernel::solver::{Settings, Status};
//! use signorini_kernel::stiffness::Coefficient;
//! use signorini_kernel::{Libm, Mesh, Tensor, workspace};
//!
//! let vertices = [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
//! let mesh = Mesh::<f32, u16>::new(&vertices, &[[0, 1, 2], [0, 2, 3]], &[])?;
//! let mut bar = <workspace!(f32, u16: vertices 4, triangles 2, quads 0, boundary 4)>::new();
//! bar.build(&mesh, Coefficient::Uniform(Tensor::scalar(3.0)), |edge| {
//!     Some(match edge.middle() {
//!         [x, _] if x == 0.0 => Condition::Dirichlet { value: 0.0 },
//!         [x, _] if x == 1.0 => Condition::Contact { gap: 2.0, flux: 0.0 },
//!         _ => Condition::Neumann { flux: 0.0 },
//!     })
//! })?;
//! let outcome = bar.solve(Settings::default())?;
//! assert_eq!(outcome.status, Status::Converged);
//! assert!((bar.contact_force() - 6.0).abs() < 1e-5); // 3 W/mK · 2 K / 1 m
//! assert_eq!(bar.contact_length::<Libm>(&mesh)?, 1.0);
//! # Ok::<(), signorini_kernel::Error>(())
//! ```
//!
//! ## The layers, in the order of use
//!
//! [`mesh`] → [`numbering`] and [`edges`] → [`stiffness`] of each [`element`] → [`assembly`] into [`csr`] →
//! [`signorini`] (the contact problem) → packed [`rows`] → [`psor`], one sweep, in the loop of [`solver`],
//! corrected by [`refinement`] → [`flux`] → [`contact`]. How wrong an iterate can be: [`forest`] → packed
//! [`cells`] → [`averages`] → [`conforming`] and [`equilibrium`] → [`certificate`]; [`tick`] puts sweeps and certificates
//! into a control loop, and [`full`] drives one by the inputs of a baked scene. Each works on slices and can be used alone; [`mod@workspace`] owns the memory and goes
//! from mesh to flux. [`components`] tells beforehand whether a solution exists.
//!
//! What `signorini bake` writes stands on [`condensed`], a problem of contact edges alone with everything else
//! eliminated on the host, or on [`full`], the mesh itself with loads that follow inputs.
//!
//! ## What is absent
//!
//! The kernel never allocates, prints, panics, reads a clock or knows a file format. It adds,
//! subtracts, multiplies, divides, compares and takes correctly rounded square roots, in one fixed
//! order: the same bits on every machine.

#[cfg(feature = "mesh")]
pub mod assembly;
#[cfg(feature = "mesh")]
pub mod averages;
#[cfg(feature = "mesh")]
pub mod boundary;
#[cfg(feature = "mesh")]
pub mod cells;
#[cfg(feature = "mesh")]
pub mod certificate;
#[cfg(feature = "mesh")]
pub mod components;
pub mod condensed;
#[cfg(feature = "workspace")]
pub mod condition;
#[cfg(feature = "mesh")]
pub mod conforming;
#[cfg(feature = "mesh")]
pub mod conjugate;
#[cfg(feature = "mesh")]
pub mod contact;
#[cfg(feature = "mesh")]
pub mod csr;
#[cfg(feature = "mesh")]
pub mod edges;
#[cfg(feature = "mesh")]
pub mod element;
#[cfg(feature = "mesh")]
pub mod equilibrium;
pub mod error;
pub mod features;
#[cfg(feature = "mesh")]
pub mod flux;
#[cfg(feature = "mesh")]
pub mod forest;
#[cfg(feature = "mesh")]
pub mod full;
#[cfg(feature = "mesh")]
pub mod geometry;
mod index;
pub mod limits;
mod math;
#[cfg(feature = "mesh")]
pub mod mesh;
#[cfg(feature = "mesh")]
pub mod model;
#[cfg(feature = "mesh")]
pub mod numbering;
#[cfg(feature = "mesh")]
pub mod prolongation;
#[cfg(feature = "mesh")]
pub mod psor;
pub mod quadrature;
mod real;
#[cfg(feature = "mesh")]
pub mod refinement;
#[cfg(feature = "mesh")]
mod relaxation;
pub mod report;
#[cfg(feature = "mesh")]
pub mod rows;
#[cfg(feature = "mesh")]
pub mod shift;
#[cfg(feature = "mesh")]
pub mod signorini;
#[cfg(feature = "mesh")]
pub mod solver;
#[cfg(feature = "mesh")]
pub mod sparse;
#[cfg(feature = "mesh")]
pub mod stiffness;
#[cfg(feature = "mesh")]
mod tensor;
#[cfg(feature = "mesh")]
pub mod tick;
pub mod verdict;
#[cfg(feature = "workspace")]
pub mod workspace;

pub use error::Error;
pub use index::Index;
#[cfg(feature = "micromath")]
pub use math::Micromath;
pub use math::{Libm, Math};
#[cfg(feature = "mesh")]
pub use mesh::Mesh;
#[cfg(feature = "mesh")]
pub use model::Model;
pub use real::Real;
#[cfg(feature = "mesh")]
pub use relaxation::Relaxation;
pub use report::Report;
#[cfg(feature = "mesh")]
pub use tensor::Tensor;
pub use verdict::{Certificate, Verdict};
#[cfg(feature = "workspace")]
pub use workspace::Workspace;

/// The version of this crate.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Whether this is the version: what a module that `signorini bake` wrote asks at compile time, since its data are laid
/// out for the kernel that it was written for.
pub const fn is_version(version: &str) -> bool {
    let (mut own, mut other) = (VERSION.as_bytes(), version.as_bytes());
    while let ([a, rest @ ..], [b, others @ ..]) = (own, other) {
        if *a != *b {
            return false;
        }
        (own, other) = (rest, others);
    }
    own.is_empty() && other.is_empty()
}

/// The example of the page on embedding is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embedding.md")]
struct Embedding;

/// So is that of the crate's own page.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct OwnPage;
