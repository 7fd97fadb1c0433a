//! Condensed models against the full solver, and what has none.

mod equality;
mod limits;
mod limits_bound;
mod limits_same;
mod modes;
mod rejected;

use signorini_scene::error::Result;
use signorini_scene::scene::Scene;

use crate::fixtures::{EVERY_INPUT as ALL, changed, full_at, on_grid, scatter};
use crate::problem::Problem;
