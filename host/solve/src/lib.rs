//! A scene becomes a problem, the problem a solution with an error bound, or a condensed model on its contact edges.
//!
//! ```text
//!   Scene, Mesh ─► problem ─► solve ─► certify ─► output     edges.csv, solution.vtu, summary.json
//!                     │         └─ reference                  an independent one, by faer
//!                     └─► condense ─► certify
//! ```
//! Integrals stand in [`quadrature`], errors against exact solutions in [`norms`] and [`energy_norm`], declared outputs in
//! [`functional`] and [`outputs`].

pub mod adaptive;
pub mod certify;
pub mod condense;
pub mod energy_norm;
pub mod field;
#[cfg(any(test, feature = "fixtures"))]
pub mod fixtures;
pub mod functional;
pub mod inputs;
pub mod intervals;
pub mod norms;
pub mod output;
pub mod outputs;
pub mod pointwise;
pub mod problem;
pub mod progress;
pub mod quadrature;
pub mod ranges;
pub mod reference;
pub mod scalar;
pub mod search;
pub mod solve;
pub mod threads;
