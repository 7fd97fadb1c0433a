#![no_std]
#![forbid(unsafe_code)]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// `!(a < b)` is meant: it is true where a or b is NaN.
#![allow(clippy::neg_cmp_op_on_partial_ord)]
//! Kernel.

pub mod assembly;
pub mod boundary;
pub mod components;
pub mod contact;
pub mod csr;
pub mod edges;
pub mod element;
pub mod error;
pub mod flux;
pub mod geometry;
mod index;
mod math;
pub mod mesh;
pub mod numbering;
pub mod psor;
pub mod quadrature;
mod real;
pub mod refinement;
mod relaxation;
pub mod shift;
pub mod signorini;
pub mod solver;
pub mod stiffness;
mod tensor;

pub use error::Error;
pub use index::Index;
pub use math::{Libm, Math, Micromath};
pub use real::Real;
pub use relaxation::Relaxation;
pub use tensor::Tensor;
