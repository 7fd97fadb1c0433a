//! A scene as the Rust source of its firmware: static data and a `Controller` for the kernel.
//!
//! ```text
//!   Scene, Problem ─► superposition: every load as base + Σ input · pattern ─┬─► full ────► arrays ─► source
//!                     measure: every output as a form on u and fluxes       ─┘            face, text ──┘
//! ```
//! Whatever the model, the module has one face ([`face`]): `Inputs`, `Outputs`, `Answer`, `Controller`.

pub mod budget;
pub mod choice;
#[cfg(test)]
mod compiled;
pub mod condensed;
pub mod costs;
pub mod explain;
pub mod face;
pub mod full;
pub mod measure;
pub mod superposition;
pub mod text;
pub mod trial;
