//! The full model: the mesh goes onto the target, and the kernel's tick solves it there.
//!
//! ```text
//!   Scene, Problem ─► Baked<R>: owned arrays ─┬─► source: Rust text      ─► firmware
//!                                             ├─► sizes: RAM and flash
//!                                             └─► controller: the same on this machine
//! ```

mod arrays;
mod bent;
mod controller;
mod data;
mod driver;
mod items;
mod listing;
mod source;
#[cfg(test)]
mod tests;

pub use arrays::Baked;
pub use controller::Controller;
pub use items::{Sizes, sizes};
pub use source::source;
