//! The judges of the workspace's tests, written from the paper's formulas and from
//! nothing else: no line here uses the kernel or the host, so agreement means something. Only `hostile`
//! calls both: it compares with nothing, and asks whether arbitrary bytes can break them.
//!
//! ```text
//! quadrature ─┬─► cell ─► element ─┬─► problem ─► contact ─► flux ─► norms
//! elimination ┘   grid ─► exact ───┘              cholesky
//! random: scenes to compare on     targets: numbers to meet (how closely: the crate `tolerances`)
//! polynomial ─► written: scene files with an exact solution, for whoever reads such files
//! hostile: arbitrary bytes into readers, constructors and control loops
//! ```
//!
//! Speed and memory are no concern: matrices are maps from pairs of edges, basis functions come
//! out of linear systems, every integral is a quadrature. An edge is the pair of its vertex
//! numbers, lower one first, so that two programs can be compared without a common numbering.

pub mod cell;
pub mod cholesky;
pub mod contact;
pub mod element;
pub mod elimination;
pub mod exact;
pub mod field;
pub mod flux;
pub mod grid;
pub mod hostile;
pub mod norms;
pub mod polynomial;
pub mod problem;
pub mod quadrature;
pub mod random;
pub mod targets;
pub mod written;

/// The example of the page on embedding is compiled and run: here, since a package of the kernel holds no page of `docs`.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embedding.md")]
struct Embedding;
