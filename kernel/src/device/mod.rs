//! What firmware calls: contact in a control loop, in memory of its own.
//!
//! [`tick`] puts sweeps and certificates into a control loop; [`limits`] say when it ends, a [`report`] how. [`mod@workspace`] owns
//! the memory of any mesh that fits, with [`condition`]s by place. Modules that `signorini bake` writes stand on [`condensed`], a
//! problem of contact edges alone, or on [`full`], the mesh itself with loads that follow inputs. [`model`] is one problem as
//! borrowed arrays.

pub mod codes;
pub mod condensed;
#[cfg(feature = "workspace")]
pub mod condition;
#[cfg(feature = "mesh")]
pub mod full;
pub mod intervals;
pub mod limits;
#[cfg(feature = "mesh")]
pub mod model;
pub mod ranges;
pub mod report;
#[cfg(feature = "mesh")]
pub mod tick;
#[cfg(feature = "workspace")]
pub mod workspace;
