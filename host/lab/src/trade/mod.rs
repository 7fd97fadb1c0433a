//! Speed for accuracy, measured: settings of a scene, what each costs, how wrong its answer is.
//!
//! ```text
//!   scene ─► settings ─► measured points ─┬─► front ─► recommendation ─► scene fragment
//!              truth ─────────┘           └─► trade.json, trade.csv, picture
//!   records of many scenes ─► verdict (which knobs pay) ─► section of the main report
//! ```

pub mod board;
pub mod campaign;
mod digits;
pub mod files;
pub mod front;
pub mod journal;
pub mod math;
pub mod measure;
mod meshes;
pub mod mpi;
pub mod picture;
pub mod plan;
pub mod promised;
pub mod record;
pub mod records;
pub mod reference;
mod run;
pub mod section;
pub mod shard;
pub mod study;
pub mod table;
pub mod target;
#[cfg(test)]
pub(crate) mod tests;
pub mod verdict;
