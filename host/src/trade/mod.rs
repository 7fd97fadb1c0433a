//! Speed for accuracy, measured: settings of a scene, what each costs, how wrong its answer is.
//!
//! ```text
//!   scene ─► settings ─► measured points ─┬─► front ─► recommendation ─► scene fragment
//!              truth ─────────┘           └─► trade.json, trade.csv, picture
//! ```

pub mod math;
pub mod record;
