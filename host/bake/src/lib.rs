//! A scene as the Rust source of its firmware: static data and a `Controller` for the kernel.
//!
//! ```text
//!   Scene, Problem ─┬─► terms of certify: loads as base + Σ input · pattern ─► full ──────┬─► source
//!                   └─► condense: a dense problem on contact edges ───────► condensed ─┘  face, text
//! ```
//! Whatever the model, the module has one interface ([`module_api`]): `Inputs`, `Outputs`, `Answer` with one type of report, and one
//! `Controller`.

pub mod budget;
pub mod c;
pub mod choice;
pub mod compiled;
pub mod condensed;
mod controller;
pub mod costs;
pub mod dense;
mod desk;
pub mod emit;
pub mod explain;
pub mod fingerprint;
pub mod full;
mod instances;
pub mod intervals;
mod item;
mod meanings;
pub mod module_api;
pub mod narrow;
pub mod promise;
pub mod range;
pub mod ranges;
mod room;
pub mod setting;
mod state;
mod statics;
#[cfg(test)]
mod tests;
pub mod text;
pub mod trial;
mod worst;

pub use instances::Bakes;
