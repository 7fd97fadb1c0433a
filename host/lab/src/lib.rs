//! Measurements of the method: accuracy against cost, other solvers on the same problems, numbers pushed to extremes, and
//! the study of the main job.
//!
//! ```text
//!   study ──► checks, convergence, pictures of the catalogue ─┐
//!   trade ──► settings, what they cost ◄── baseline           ├─► report.html
//!   extremes ─► axes of scales, random scenes ────────────────┘
//! ```
//! The only crate that builds other solvers. Nothing that a user's answer needs is here.

mod baseline;
pub mod checkout;
mod cycles;
pub mod extremes;
mod mesh_solution;
mod record_file;
pub mod study;
pub mod trade;
