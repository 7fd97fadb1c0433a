//! An exact solver for meshes on which projected SOR crawls: sparse LDLᵀ, then pivoting on the contact edges.
//!
//! Sweeps need as many rounds as D⁻¹K is ill-conditioned: at an anisotropy of 10³ across the mesh, or where
//! A jumps from cell to cell, 10⁵ and more. Elimination does not see the condition. With I the free and C the
//! contact unknowns,
//! ```text
//!   K_II = L D Lᵀ,   S = K_CC − K_CI K_II⁻¹ K_IC        once for a matrix
//!   y = L⁻¹ r_I,     b = r_C − L_CI y                   for every load: r is the defect of an iterate
//!   v ≥ 0, S v − b ≥ 0, vᵀ(S v − b) = 0                 by exchanges, as in a condensed model
//!   z_I = L⁻ᵀ (D⁻¹ y − L_CIᵀ v)
//! ```
//! and again with the defect of what was found, until corrections vanish: defects are measured in
//! differences ([`signorini_kernel::refinement`]), so that a factor in a short scalar is enough where it is any use at all.
//!
//! ```text
//!   order (from the host) ─► elimination (pattern of L) ─► factor (L, D, S) ─► contact (exchanges, corrections)
//!                                                          or baked             ▲
//!                                                                               └─ defects: cells (element matrices)
//! ```
//! The order of elimination is worked out beforehand, by whatever keeps L sparse; the contact unknowns come
//! last. The memory is the caller's: [`elimination::Pattern`] says how much L takes. Solving costs twice the
//! entries of L in multiply-adds and one pass over S, whatever the condition.

pub mod cells;
pub mod contact;
pub mod elimination;
pub mod factor;
mod solved;
pub mod storage;

pub use cells::Balance;
pub use contact::{Exact, Factored};
pub use elimination::Pattern;
pub use factor::Factor;
pub use solved::Solved;
pub use storage::{ArrayStorage, Memory, Storage};
