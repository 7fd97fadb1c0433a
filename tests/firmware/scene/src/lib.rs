//! A baked scene and what is done with it: ticks with known inputs, told bit for bit.
#![no_std]

pub mod figures;
pub mod loads;
pub mod play;
#[cfg(feature = "worst")]
pub mod worst;

include!(concat!(env!("OUT_DIR"), "/module.rs"));
