//! Speed for accuracy, measured: settings of a scene, what each costs, how wrong its answer is.
//!
//! ```text
//!   scene ─► settings ─► measured points ─┬─► front ─► recommendation ─► scene fragment
//!              truth ─────────┘           └─► trade.json, trade.csv, picture
//!   records of many scenes ─► verdict (which knobs pay) ─► section of the main report
//! ```

mod board;
pub mod campaign;
pub(crate) mod digits;
mod files;
pub mod front;
pub mod journal;
mod math;
mod measure;
mod meshes;
pub mod mpi;
mod picture;
mod plan;
pub mod promised;
mod record;
pub(crate) mod records;
mod reference;
mod run;
pub(crate) mod section;
pub mod shard;
mod study;
pub mod table;
pub mod target;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod verdict;

pub use record::Trade;
