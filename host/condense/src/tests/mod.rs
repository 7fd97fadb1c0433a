//! Condensed models against the full solver, and what has none.

mod equality;
mod limits;
mod limits_bound;
mod limits_same;
mod modes;
mod rejected;

use signorini_scene::error::Result;
use signorini_scene::scene::Scene;

use signorini_problem::Problem;
use signorini_problem::fixtures::{EVERY_INPUT as ALL, changed, on_grid, scatter};
use signorini_solve::fixtures::full_at;
