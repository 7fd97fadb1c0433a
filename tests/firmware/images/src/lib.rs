//! What the images have in common: the stages that they run, and the board that they run on.
//!
//! [`stages`] is the kernel at work on exported scenes, and knows no machine: an image and the program
//! `desk` run the same code and print the same lines, where the bits are the same.
#![cfg_attr(not(feature = "desk"), no_std)]

pub mod breach;
pub mod grid;
#[cfg(target_os = "none")]
pub mod meter;
pub mod plate;
pub mod scenes;
pub mod stages;
pub mod tick;
pub mod tiny;

#[cfg(target_os = "none")]
pub use signorini_board as board;
pub use signorini_board::journal;
