//! The guaranteed error bound on a scene, and the exact norms that it is checked by.
//!
//! The kernel bounds the error of any iterate ([`signorini_bound::certificate`]) from vertex values, edge
//! fluxes and element integrals. Here are the numbers that only the scene's expressions can give:
//! ```text
//!   metric       A in reference coordinates where it varies  ─┬─► ways (forest, packed cells) ─┐
//!   ends         ψ and u_D at the ends of edges      ─┐                                        │
//!   between ─► deviation ─► curved   what lies above their chords ├─► data ─────────────────────────► certifier
//!   energy       what is left out of either, by A    ─┤                                        │
//!   profile ─► local_flux, edge_flux ─► oscillation  what the means of f, g, q leave out  ─┤                                       │
//!   robin        h and u_ext at points of edges       ─┘                                     bound
//!   admissible ─┬► exact   the true distance to s and τ, from an exact solution
//! ```

pub mod admissible;
mod between;
mod bound;
mod certifier;
pub mod conductivity;
pub mod curved;
mod data;
pub mod deviation;
mod edge_flux;
mod enclosed;
pub mod ends;
pub mod energy;
pub mod evolution;
pub mod exact;
pub mod factor;
mod fields;
pub mod forest;
mod imbalance;
mod legendre;
pub mod lifted;
mod local_flux;
pub mod metric;
mod no_bound;
pub mod oscillation;
mod profile;
pub mod reach;
mod relaxed;
pub mod robin;
pub mod sampled;
pub mod stated;
pub mod stored;
mod stretch;
pub mod term;
#[cfg(test)]
mod tests;
pub mod transfer_forms;
pub mod transfer_points;
pub mod weighed;

pub use bound::{Certified, ErrorBound};
pub use certifier::Certifier;
pub use conductivity::eigenvalues;
pub use data::{Data, Evaluated};
pub use enclosed::Enclosed;
pub use fields::{CertifiedFields, Column};
pub use no_bound::NoBound;
pub use signorini_problem::cell;
pub use term::TermData;
