#![no_std]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// Pages of a lean build name what it leaves out.
#![cfg_attr(not(feature = "workspace"), allow(rustdoc::broken_intra_doc_links))]
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
//! use signorini_kernel::device::condition::Condition;
//! use signorini_kernel::solve::solver::{Settings, Status};
//! use signorini_kernel::discrete::stiffness::Coefficient;
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
//! | | |
//! |---|---|
//! | [`mesh`] | coordinates and cells, validated; edges and their numbering; what holds on the boundary |
//! | [`discrete`] | element matrices, CSR or packed rows, the contact problem, its flux |
//! | [`solve`] | projected SOR and its help, a sparse factor, a dense problem of contact edges |
//! | [`bound`] | an admissible function and an admissible flux beside an iterate: the guaranteed error bound |
//! | [`device`] | ticks with a deadline, a workspace of fixed capacity, what `signorini bake` writes stands on |
//!
//! Each works on slices and can be used alone; a layer knows those above it in this table only.
//!
//! ## What is absent
//!
//! The kernel never allocates, prints, panics, reads a clock or knows a file format. It adds,
//! subtracts, multiplies, divides, compares and takes correctly rounded square roots, in one fixed
//! order: the same bits on every machine.

pub mod bound;
pub mod device;
#[cfg(feature = "mesh")]
pub mod discrete;
pub mod error;
pub mod features;
pub mod flux_range;
mod index;
mod math;
#[cfg(feature = "mesh")]
pub mod mesh;
pub mod quadrature;
mod real;
pub mod solve;

pub use bound::verdict::{Certificate, Verdict};
pub use device::report::Report;
#[cfg(feature = "workspace")]
pub use device::workspace::Workspace;
#[cfg(feature = "mesh")]
pub use discrete::tensor::Tensor;
pub use error::Error;
pub use index::Index;
#[cfg(feature = "micromath")]
pub use math::Micromath;
pub use math::{Libm, Math};
#[cfg(feature = "mesh")]
pub use mesh::Mesh;
pub use real::Real;

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
