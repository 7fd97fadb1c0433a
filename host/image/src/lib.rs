//! Images of baked scenes: how they are built, run on emulated boards, and what they take.
//!
//! ```text
//!   module ─┬─ image ─► board ─► ticks ─┬─► firmware (firmware.json)
//!           ├─ program ─► desk ─► ticks ─┘
//!           └─ library ─► libNAME.a, for C
//! ```
//! Who bakes writes the module: `cargo xtask firmware` by the program `signorini`, `signorini trade` itself. It works in a
//! checkout of the sources ([`checkout`]), with tools that it installs where it can ([`tools`]).

mod binutils;
pub mod board;
pub mod cargo;
pub mod checkout;
pub mod chosen;
pub mod files;
pub mod firmware;
pub mod footprint;
pub mod library;
pub mod lock;
pub mod module;
pub mod objects;
pub mod once;
pub mod record;
pub mod room;
pub mod ticks;
pub mod toolchain;
pub mod tools;
pub mod worst;
