//! The discrete problem: K u = b with bounds on the contact edges.
//!
//! [`stiffness`] of each [`element`] → [`assembly`] into [`csr`] → [`signorini`], the contact problem with its [`law`], or packed [`rows`] straight away.
//! What an iterate says: the conservative [`flux`], and [`contact`]: force, length, active edges.

pub mod assembly;
pub mod contact;
pub mod csr;
pub mod element;
pub mod flux;
pub mod law;
pub mod rows;
pub mod signorini;
pub mod stiffness;
pub(crate) mod tensor;
