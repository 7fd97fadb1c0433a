//! Words of Python for choices of the host.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use signorini_scene::setting::ModelKind;
use signorini_solve::{ScalarKind, SolverKind};

/// The scalar type, where one is named.
pub fn scalar(word: Option<&str>) -> PyResult<Option<ScalarKind>> {
    chosen("scalar", word, &[("f32", ScalarKind::F32), ("f64", ScalarKind::F64)])
}

/// The solver.
pub fn solver(word: Option<&str>) -> PyResult<Option<SolverKind>> {
    let all = [
        ("auto", SolverKind::Auto),
        ("kernel", SolverKind::Kernel),
        ("direct", SolverKind::Direct),
        ("multigrid", SolverKind::Multigrid),
    ];
    chosen("solver", word, &all)
}

/// The model of a controller.
pub fn model(word: Option<&str>) -> PyResult<Option<ModelKind>> {
    chosen("model", word, &[("full", ModelKind::Full), ("condensed", ModelKind::Condensed)])
}

fn chosen<T: Copy>(name: &str, word: Option<&str>, all: &[(&str, T)]) -> PyResult<Option<T>> {
    let Some(word) = word else { return Ok(None) };
    let found = all.iter().find(|(known, _)| *known == word);
    found.map(|(_, value)| Some(*value)).ok_or_else(|| {
        let known: Vec<_> = all.iter().map(|(known, _)| *known).collect();
        PyValueError::new_err(format!("{name} is {word:?}, expected {}", known.join(" or ")))
    })
}
