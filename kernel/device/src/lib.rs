#![no_std]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// `!(a < b)` is meant: it is true where a or b is NaN.
#![allow(clippy::neg_cmp_op_on_partial_ord)]
// Pages of a lean build name what it leaves out.
#![cfg_attr(not(feature = "workspace"), allow(rustdoc::broken_intra_doc_links))]
//! Contact in a control loop, in fixed memory: what firmware calls.
//!
//! [`tick`] puts sweeps and certificates into a loop; [`kernel::limits`] say when it ends, a [`Report`] how. [`mod@workspace`] owns
//! the memory of any mesh that fits, with [`condition`]s by place. Modules that `signorini bake` writes stand on [`contact`], a
//! problem of contact edges alone, or on [`full`], the mesh itself with loads that follow inputs. Where sweeps crawl, a [`sparse`]
//! factor solves. [`model`] is one problem as borrowed arrays.
//!
//! ## An example
//!
//! A heated bar: 0 °C outside on the left, a heater on the right that keeps at least 2 °C.
//! ```
//! use signorini_device::condition::Condition;
//! use signorini_device::kernel::solver::{Settings, Status};
//! use signorini_device::kernel::stiffness::Coefficient;
//! use signorini_device::kernel::{Libm, Mesh, Tensor};
//! use signorini_device::workspace;
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
//! # Ok::<(), signorini_device::Error>(())
//! ```
//!

#[cfg(feature = "mesh")]
pub use signorini_bound as bound;
pub use signorini_contact as contact;
pub use signorini_kernel as kernel;

pub mod codes;
pub mod condensed;
#[cfg(feature = "workspace")]
pub mod condition;
pub mod controller;
pub mod exclusions;
#[cfg(feature = "mesh")]
pub mod full;
pub mod intervals;
#[cfg(feature = "mesh")]
pub mod model;
pub mod ranges;
#[cfg(feature = "mesh")]
pub mod sparse;
mod state;
#[cfg(feature = "mesh")]
pub mod tick;
mod window;
#[cfg(feature = "workspace")]
pub mod workspace;

pub use signorini_kernel::{Error, Report};
pub use state::{State, checksum};
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

/// The example of the crate's own page is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct OwnPage;
