//! Vectors as numpy arrays, which take their memory over.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A dictionary that is filled.
pub struct Filled<'py>(pub Bound<'py, PyDict>);

impl<'py> Filled<'py> {
    /// Empty.
    pub fn new(py: Python<'py>) -> Self {
        Self(PyDict::new(py))
    }

    /// A column of numbers, without a copy.
    pub fn numbers<T: numpy::Element>(&self, name: &str, values: Vec<T>) -> PyResult<()> {
        self.0.set_item(name, PyArray1::from_vec(self.0.py(), values))
    }

    /// Rows of numbers, without a copy.
    pub fn rows<T: numpy::Element, const N: usize>(
        &self,
        name: &str,
        rows: Vec<[T; N]>,
    ) -> PyResult<()> {
        let count = rows.len();
        let flat = PyArray1::from_vec(self.0.py(), rows.into_flattened());
        let shaped: Bound<'py, PyArray2<T>> = flat.reshape([count, N])?;
        self.0.set_item(name, shaped)
    }

    /// Anything else.
    pub fn set(&self, name: &str, value: impl IntoPyObject<'py>) -> PyResult<()> {
        self.0.set_item(name, value)
    }
}
