//! Solvers of the discrete problem.
//!
//! [`psor`], one sweep, in the loop of [`solver`] with the factor of `relaxation` and a [`shift`] where parts are weakly held;
//! [`conjugate`] gradients and a [`sparse`] factor where sweeps crawl; [`refinement`] to full accuracy; [`prolongation`] from a
//! coarser mesh. [`dense`] solves what is left on the contact edges alone.

#[cfg(feature = "mesh")]
pub mod conjugate;
pub mod dense;
#[cfg(feature = "mesh")]
pub mod prolongation;
#[cfg(feature = "mesh")]
pub mod psor;
#[cfg(feature = "mesh")]
pub mod refinement;
#[cfg(feature = "mesh")]
pub(crate) mod relaxation;
#[cfg(feature = "mesh")]
pub mod shift;
#[cfg(feature = "mesh")]
pub mod solver;
#[cfg(feature = "mesh")]
pub mod sparse;

#[cfg(feature = "mesh")]
pub use relaxation::Relaxation;
