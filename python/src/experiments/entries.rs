//! [`Entries`]: a dictionary of numbers and arrays.

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A dictionary that is being filled.
pub(super) struct Entries<'py>(Bound<'py, PyDict>);

impl<'py> Entries<'py> {
    pub(super) fn new(py: Python<'py>) -> Self {
        Self(PyDict::new(py))
    }

    /// With a value of any kind.
    pub(super) fn with(self, key: &str, value: impl IntoPyObject<'py>) -> PyResult<Self> {
        self.0.set_item(key, value)?;
        Ok(self)
    }

    /// With an array of one axis.
    pub(super) fn list(self, key: &str, numbers: &[f64]) -> PyResult<Self> {
        let array = PyArray1::from_slice(self.0.py(), numbers);
        self.with(key, array)
    }

    /// With an array of two: a row for each time.
    pub(super) fn rows<R: AsRef<[f64]>>(
        self,
        key: &str,
        rows: impl ExactSizeIterator<Item = R>,
    ) -> PyResult<Self> {
        let array = rows_of(self.0.py(), rows)?;
        self.with(key, array)
    }

    pub(super) fn done(self) -> Bound<'py, PyDict> {
        self.0
    }
}

/// An array of rows, which are equally long; without any it has no columns either.
pub(super) fn rows_of<'py, R: AsRef<[f64]>>(
    py: Python<'py>,
    rows: impl ExactSizeIterator<Item = R>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows: Vec<Vec<f64>> = rows.map(|row| row.as_ref().to_vec()).collect();
    PyArray2::from_vec2(py, &rows).map_err(|error| PyValueError::new_err(error.to_string()))
}
