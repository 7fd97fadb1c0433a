//! Errors of the host as Python exceptions.

use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use signorini_scene::error::{Error, InputError};
use signorini_solve::Ending;

create_exception!(
    signorini,
    SceneError,
    PyValueError,
    "The scene, its mesh or an argument is wrong.\n\nAttributes: message, file, line, key, hint and, of a controller, refusal (no-solution, not-unique, excluded, empty-range, not-finite, foreign-state or damaged-state); each is None where there is none."
);

/// The exception of an error; `is_file` tells whether the scene is a file that a person can look into.
pub fn raised(py: Python<'_>, error: Error, is_file: bool) -> PyErr {
    let refused = Ending::refused(&error);
    match error {
        Error::Input(error) => scene_error(py, &error, refused, is_file),
        Error::Io { path, cause } => PyOSError::new_err(format!("{}: {cause}", path.display())),
        Error::Check(what) => PyRuntimeError::new_err(what),
    }
}

fn scene_error(
    py: Python<'_>,
    error: &InputError,
    refused: Option<Ending>,
    is_file: bool,
) -> PyErr {
    let message = error.message();
    let hint = error.said_hint();
    let others = error.others().iter().map(|other| told(other, is_file));
    let text: Vec<_> = std::iter::once(told(error, is_file)).chain(others).collect();
    let raised = SceneError::new_err(text.join("\n"));
    let value = raised.value(py);
    let file = error.place().0.filter(|_| is_file).map(|file| file.display().to_string());
    let line = error.place().1.filter(|_| is_file);
    // Setting an attribute of a new exception cannot fail.
    let _ = value.setattr("message", message);
    let _ = value.setattr("file", file);
    let _ = value.setattr("line", line);
    let _ = value.setattr("key", error.key());
    let _ = value.setattr("hint", hint);
    let _ = value.setattr("refusal", refused.map(Ending::name));
    raised
}

/// The message with its place in a file, and the hint below it.
fn told(error: &InputError, is_file: bool) -> String {
    let place = if is_file { error.to_string() } else { error.message().to_owned() };
    error.said_hint().map_or_else(|| place.clone(), |hint| format!("{place}\nhint: {hint}"))
}
