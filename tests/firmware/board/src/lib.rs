//! The board: its console, its end, and a panic handler that no image may need. Of all this a desk has the
//! [`journal`] alone.
#![no_std]

#[cfg(target_os = "none")]
pub mod clock;
#[cfg(target_os = "none")]
mod console;
pub mod draw;
#[cfg(all(target_os = "none", target_abi = "eabihf"))]
pub mod flush;
pub mod journal;
#[cfg(target_os = "none")]
pub mod stack;

#[cfg(target_os = "none")]
pub use console::{end, print, run};
