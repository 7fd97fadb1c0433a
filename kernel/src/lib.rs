#![no_std]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// Pages of a lean build name what it leaves out.
#![cfg_attr(not(feature = "mesh"), allow(rustdoc::broken_intra_doc_links))]
// `!(a < b)` is meant: it is true where a or b is NaN.
#![allow(clippy::neg_cmp_op_on_partial_ord)]
#![doc = include_str!("../README.md")]

#[cfg(feature = "mesh")]
pub mod assembly;
pub mod codes;
#[cfg(feature = "mesh")]
pub mod conjugate;
#[cfg(feature = "mesh")]
pub mod contact;
#[cfg(feature = "mesh")]
pub mod csr;
#[cfg(feature = "mesh")]
pub mod element;
pub mod error;
pub mod evolution;
pub mod excess;
pub mod features;
pub mod flags;
#[cfg(feature = "mesh")]
pub mod flux;
pub mod flux_range;
pub mod index;
#[cfg(feature = "mesh")]
pub mod law;
pub mod limits;
mod math;
#[cfg(feature = "mesh")]
pub mod mesh;
#[cfg(feature = "mesh")]
pub mod psor;
pub mod quadrature;
mod real;
#[cfg(feature = "mesh")]
pub mod refinement;
#[cfg(feature = "mesh")]
pub mod relaxation;
pub mod report;
#[cfg(feature = "mesh")]
pub mod rows;
#[cfg(feature = "mesh")]
pub mod shift;
#[cfg(feature = "mesh")]
pub mod solver;
#[cfg(feature = "mesh")]
pub mod stiffness;
#[cfg(feature = "mesh")]
pub mod storage;
#[cfg(feature = "mesh")]
pub mod system;
#[cfg(feature = "mesh")]
mod tensor;
pub mod verdict;

pub use error::Error;
pub use index::Index;
#[cfg(feature = "micromath")]
pub use math::Micromath;
pub use math::{Libm, Math};
#[cfg(feature = "mesh")]
pub use mesh::Mesh;
pub use real::Real;
pub use report::Report;
#[cfg(feature = "mesh")]
pub use tensor::Tensor;
pub use verdict::{Certificate, Verdict};
