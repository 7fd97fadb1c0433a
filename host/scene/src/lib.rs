//! The input of the host: scene files, their expressions, meshes, settings, and what can be wrong with any of them.
//!
//! ```text
//!   scene.toml ─► scene ─┬─► expression   values as text, with derivatives
//!                        ├─► setting      which solver, how far
//!                        └─► mesh         Gmsh, or made here: vertices, cells, named curves
//! ```
//! Nothing here solves anything. The first crate of the host: it knows the kernel and none of the others.

pub mod error;
pub mod expression;
pub mod faults;
pub mod goal;
pub mod mesh;
pub mod scene;
pub mod setting;

pub use error::{Error, InputError, Result};
pub use expression::Expression;
pub use faults::Faults;
pub use goal::Goal;
pub use mesh::Mesh;
pub use scene::Scene;
pub use setting::Setting;
