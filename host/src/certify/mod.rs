//! What the error bound needs beyond the solver's own data, and the exact norms it is checked by.
//!
//! The kernel holds vertex values, edge fluxes and element integrals. Here are the numbers that only
//! the scene's expressions can give:
//! ```text
//!   ends         ψ and u_D at the ends of edges      ─┐
//!   deviation ─► curved   what lies above their chords ├─► the bound
//!   oscillation  what the means of f, g, q leave out  ─┤
//!   robin        h and u_ext at points of edges       ─┘
//!   admissible ─► exact   the true distance to s and τ, from an exact solution
//! ```

pub mod admissible;
mod cell;
mod conductivity;
pub mod curved;
mod deviation;
pub mod ends;
pub mod exact;
#[cfg(test)]
mod fixtures;
#[cfg(test)]
mod identity;
pub mod oscillation;
pub mod robin;
