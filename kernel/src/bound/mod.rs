//! How wrong an iterate can be, with no unknown constant.
//!
//! [`forest`] → packed [`cells`] → [`averages`] → [`conforming`] and [`equilibrium`] → [`certificate`], which ends in a [`verdict`].

#[cfg(feature = "mesh")]
pub mod averages;
#[cfg(feature = "mesh")]
pub mod cells;
#[cfg(feature = "mesh")]
pub mod certificate;
#[cfg(feature = "mesh")]
pub mod conforming;
#[cfg(feature = "mesh")]
pub mod equilibrium;
pub(crate) mod excess;
#[cfg(feature = "mesh")]
pub mod forest;
pub mod verdict;
