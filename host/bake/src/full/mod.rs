//! The full model: the mesh goes onto the target, and the kernel's tick solves it there.
//!
//! ```text
//!   Scene, Problem ─► Baked<R>: owned arrays ─► borrowed: as the kernel takes them ─┬─► source: Rust text  ─► firmware
//!                                                                                   ├─► sizes: RAM and flash
//!                                                                                   └─► controller: the same here
//! ```

use signorini_device::tick::Limits;

use signorini_problem::scalar::Scalar;
use signorini_scene::setting::Setting;

mod arrays;
mod baking;
mod bent;
mod borrowed;
mod cancellation;
mod controller;
mod data;
mod factored;
mod linear;
mod listing;
mod on_rows;
mod options;
mod output;
mod pattern;
mod sizes;
mod solver;
mod source;
mod storing;
#[cfg(test)]
mod tests;

pub use arrays::Baked;
pub use controller::Controller;
pub use sizes::{Sizes, sizes};
pub use source::source;

/// What the algebraic part of a tick's bound may be of the whole. Outputs follow the iterate: at a tenth, which is
/// enough for the bound, they are off by some thousandths.
pub const SHARE: f64 = 0.01;

/// The limits of a baked module's ticks: exactly so many sweeps where the setting says how many, whatever is
/// left to do after fewer; else its share of the bound, or [`SHARE`].
pub fn limits<R: Scalar>(setting: &Setting) -> Limits<R> {
    match setting.sweeps {
        Some(sweeps) => Limits { error: R::ZERO, share: R::ZERO, sweeps },
        None => Limits { share: R::narrow(setting.share.unwrap_or(SHARE)), ..Limits::default() },
    }
}
