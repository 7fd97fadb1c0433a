//! What the Python module `signorini` does in Rust: plain functions over text, arrays and dictionaries, which its Python side makes
//! classes of.
//!
//! ```text
//!   scene (text or file, mesh) ─► Problem ─┬─ solve ──────► arrays
//!                                          ├─ tick ───────► arrays
//!                                          ├─ bake ───────► source
//!                                          └─ Controller ─► a thread of its own
//! ```
//! All work runs without the interpreter's lock, on a thread that Ctrl-C does not wait for (`work`).

mod arrays;
mod baking;
mod controller;
mod error;
mod posed;
mod solving;
mod ticking;
mod words;
mod work;

use pyo3::prelude::*;

/// The module.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("SceneError", module.py().get_type::<error::SceneError>())?;
    module.add_function(wrap_pyfunction!(solving::solve, module)?)?;
    module.add_function(wrap_pyfunction!(ticking::tick, module)?)?;
    module.add_function(wrap_pyfunction!(baking::bake, module)?)?;
    module.add_class::<controller::Controller>()
}
