//! Locks, plans, searches, simulations and scenarios: `ulna-experiments` for Python. Joints count from 0 here, as in Python.

mod entries;
mod known;
mod law;
mod operation;
mod plan;
mod scenario;
mod studies;
mod words;

pub(crate) use known::{tables, tables_text};
pub(crate) use law::{Law, control_cycle, lock_impact};
pub(crate) use operation::Operation;
pub(crate) use plan::{Plan, plan_motion};
pub(crate) use scenario::{Scenario, read_scenario, restore_scenario};

use pyo3::PyErr;

use crate::errors::ExperimentError;

/// The exception for whatever keeps an experiment from being made.
fn impossible(error: &impl ToString) -> PyErr {
    ExperimentError::new_err(error.to_string())
}
