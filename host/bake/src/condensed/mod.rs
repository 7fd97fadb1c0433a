//! The condensed model: only contact edges, inputs and outputs go onto the target.
//!
//! ```text
//!   Condensate (f64) ─► Baked<R>: owned arrays ─┬─► source: Rust text      ─► firmware
//!                                               ├─► sizes: RAM and flash
//!                                               └─► controller: the same on this machine
//! ```

mod arrays;
mod balance;
mod bound;
mod controller;
mod evolution;
mod modes;
mod narrowed;
mod sizes;
mod solver;
mod source;
mod start;
mod statics;
mod steps;
#[cfg(test)]
mod tests;
mod visited;

pub use arrays::{Baked, Work};
pub use controller::Controller;
pub use modes::{Modes, unit_of_amplitudes};
pub use sizes::sizes;
pub use source::source;
pub use steps::Steps;
pub use visited::Visited;
