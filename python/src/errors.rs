//! Errors and warnings as Python knows them, in the words of the program `ulna`.

use std::ffi::CString;

use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use ulna_table::diagnostics::{Diagnostic, Diagnostics, Severity};

create_exception!(
    ulna,
    Error,
    PyValueError,
    "What is wrong with a text that was given to ulna.\n\n\
     Its text is that of the program `ulna`: every error at once, each with its file, line, what is wrong and what to write instead.\n\
     `findings` has them one by one."
);
create_exception!(
    ulna,
    TableError,
    Error,
    "An arm's table is refused: every error in it, each with its place and the remedy."
);
create_exception!(
    ulna,
    DescriptionError,
    Error,
    "A robot description (URDF) is refused, or no arm can be made of it: every error, each with its place and the remedy."
);
create_exception!(
    ulna,
    ScenarioError,
    Error,
    "A scenario is refused: every error in it and in the table that it names, each with its place and the remedy."
);
create_exception!(
    ulna,
    ExperimentError,
    PyValueError,
    "An experiment cannot be made: the motion cannot be executed, nothing keeps the limits, or a number makes no experiment."
);
create_exception!(
    ulna,
    CampaignError,
    PyRuntimeError,
    "Files of a campaign cannot be made, gone on with or put together; the text says what to do about it.\n\n\
     They are those of another campaign, have been changed, are being made by somebody else, or cannot be read or written."
);
create_exception!(
    ulna,
    TableWarning,
    PyUserWarning,
    "Something in a table or a description is legal and rarely meant; the text says how the table switches it off."
);

/// One thing that was found in a text.
#[pyclass(frozen, get_all, module = "ulna")]
pub(crate) struct Finding {
    /// "error" or "warning".
    severity: &'static str,
    /// What is wrong, in a sentence.
    message: String,
    /// A few words for the marked place.
    label: String,
    /// What to write instead, or None.
    help: Option<String>,
    /// The lint that a warning is of, by the name that switches it off, or None.
    lint: Option<&'static str>,
    /// Line, from 1, or None if it is about the file as a whole.
    line: Option<usize>,
    /// Column in characters, from 1, or None.
    column: Option<usize>,
}

#[pymethods]
impl Finding {
    fn __repr__(&self) -> String {
        let Self {
            severity, message, ..
        } = self;
        match self.line {
            Some(line) => format!("<{severity} in line {line}: {message}>"),
            None => format!("<{severity}: {message}>"),
        }
    }
}

impl From<&Diagnostic> for Finding {
    fn from(found: &Diagnostic) -> Self {
        Self {
            severity: match found.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            message: found.message.clone(),
            label: found.label.clone(),
            help: found.help.clone(),
            lint: found.lint,
            line: found.position.map(|position| position.line),
            column: found.position.map(|position| position.column),
        }
    }
}

/// The exception `E` with everything found.
pub(crate) fn refused<E: pyo3::PyTypeInfo>(py: Python<'_>, texts: &[Diagnostics]) -> PyErr {
    let text: Vec<String> = texts.iter().map(ToString::to_string).collect();
    let error = PyErr::from_type(py.get_type::<E>(), text.join("\n\n"));
    let findings = texts.iter().flat_map(Diagnostics::list).map(Finding::from);
    let findings: Vec<Finding> = findings.collect();
    match error.value(py).setattr("findings", findings) {
        Ok(()) => error,
        Err(other) => other,
    }
}

/// How many frames above the native call the user's line is: the package's own function is one.
const USER: i32 = 2;

/// A warning, at the line that called the package.
///
/// # Errors
/// The warning itself, where the user has made errors of them.
pub(crate) fn warn(py: Python<'_>, text: &str) -> PyResult<()> {
    // What comes from a text has none, but for a hostile name of a file.
    let text = CString::new(text.replace('\0', "\u{fffd}")).unwrap_or_default();
    PyErr::warn(py, py.get_type::<TableWarning>().as_any(), &text, USER)
}

/// A warning of what was found, if anything was.
///
/// # Errors
/// As [`warn`].
pub(crate) fn warn_of(py: Python<'_>, found: &Diagnostics) -> PyResult<()> {
    if found.is_empty() {
        return Ok(());
    }
    warn(py, &found.to_string())
}
