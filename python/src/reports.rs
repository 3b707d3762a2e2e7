//! What `ulna cost` and `ulna verify` say, as dictionaries.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use ulna_codegen::{Compiled, Counts, Generator};
use ulna_table::Model;

/// As `ulna cost --json`: `{"arm", "quantities": {method: {operation: count, "sin_cos", "total"}}}`, the total without sines.
pub(crate) fn cost<'py>(
    py: Python<'py>,
    model: &Model,
    compiled: &Compiled,
) -> PyResult<Bound<'py, PyDict>> {
    let quantities = PyDict::new(py);
    for found in &compiled.methods {
        let counts = Counts::of(&found.program);
        let entries = PyDict::new(py);
        for (operation, count) in &counts.operations {
            entries.set_item(operation, count)?;
        }
        entries.set_item("sin_cos", counts.sin_cos)?;
        entries.set_item("total", counts.total)?;
        quantities.set_item(found.method.name(), entries)?;
    }
    let cost = PyDict::new(py);
    cost.set_item("arm", model.name())?;
    cost.set_item("quantities", quantities)?;
    Ok(cost)
}

/// A comparison: its text, whether it passes, at how many states, and of each method the error, what is allowed, and whether that passes.
pub(crate) type Report = (String, bool, usize, Vec<(&'static str, f64, f64, bool)>);

/// What `ulna verify` compares: the emitted programs with 106 bits, the textbook with them, and derivatives with differences.
pub(crate) fn verify(model: &Model, generator: Generator, samples: usize) -> PyResult<Vec<Report>> {
    let compiled = generator.compile(model);
    let found = ulna_verify::verify(model, compiled, samples, &|| ())
        .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let report = |report: ulna::proof::Report| {
        let lines = report.deviations().iter();
        let lines = lines.map(|it| (it.method, it.error, it.tolerance, it.passes()));
        (
            report.to_string(),
            report.passes(),
            report.states(),
            lines.collect(),
        )
    };
    Ok([found.emitted, found.textbook, found.differences]
        .map(report)
        .into())
}
