//! [`Law`]: a compensation; and what is asked of one state after the other: the impact of a lock, a cycle of the controller.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use ulna::Method;
use ulna_experiments::{FreeTorqueList, Settings, StateList};

use super::entries::Entries;
use super::{impossible, words};
use crate::arguments::Arguments;
use crate::arm::Arm;
use crate::run::Numbers;

/// A law of compensation with its parameters.
#[pyclass(frozen, module = "ulna")]
pub(crate) struct Law(pub(super) ulna_experiments::Law);

/// z, N m, and f, N and N m.
type Free = (Vec<f64>, [f64; 6]);

#[pymethods]
impl Law {
    /// No compensation.
    #[staticmethod]
    fn none() -> Self {
        Self(ulna_experiments::Law::None)
    }

    /// Eq. 16 with the diagonal of k_d, one number for each joint.
    #[staticmethod]
    fn eq16(coefficients: Vec<f64>) -> Self {
        Self(ulna_experiments::Law::PerJoint(coefficients))
    }

    /// Eq. 20 with the diagonal of k_d, one number for each joint.
    #[staticmethod]
    fn eq20(coefficients: Vec<f64>) -> Self {
        Self(ulna_experiments::Law::Projected(coefficients))
    }

    /// U = P z + J' f: a pair (z, f) as long as no joint is locked, N m (n,) and N, N m (6,), and another one from then on.
    #[staticmethod]
    fn optimal(before: Free, after: Free) -> Self {
        let [before, after] =
            [before, after].map(|(torque, wrench)| FreeTorqueList { torque, wrench });
        Self(ulna_experiments::Law::Optimal { before, after })
    }

    /// "none", "eq16", "eq20" or "optimal".
    #[getter]
    fn kind(&self) -> &'static str {
        match &self.0 {
            ulna_experiments::Law::None => "none",
            ulna_experiments::Law::PerJoint(_) => "eq16",
            ulna_experiments::Law::Projected(_) => "eq20",
            ulna_experiments::Law::Optimal { .. } => "optimal",
        }
    }

    /// The diagonal of k_d, (n,); None for laws that have none.
    #[getter]
    fn coefficients<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        match &self.0 {
            ulna_experiments::Law::PerJoint(k) | ulna_experiments::Law::Projected(k) => {
                Some(PyArray1::from_slice(py, k))
            }
            _ => None,
        }
    }

    /// z and f before the lock, and after it; None for laws that have none.
    #[getter]
    fn free_torques(&self) -> Option<[Free; 2]> {
        match &self.0 {
            ulna_experiments::Law::Optimal { before, after } => {
                Some([before, after].map(|free| (free.torque.clone(), free.wrench)))
            }
            _ => None,
        }
    }

    fn __repr__(&self) -> String {
        match &self.0 {
            ulna_experiments::Law::PerJoint(k) | ulna_experiments::Law::Projected(k) => {
                format!("<ulna.Law {}: {k:?}>", self.kind())
            }
            _ => format!("<ulna.Law {}>", self.kind()),
        }
    }
}

/// The states that arguments are, one after the other.
fn states(arguments: &Arguments<'_>, joints: usize) -> PyResult<Vec<StateList>> {
    let numbers = arguments.numbers()?;
    let state = |at: usize| {
        let of = |argument: usize| match numbers[argument] {
            Numbers::OfEach(all) => all[at * joints..(at + 1) * joints].to_vec(),
            Numbers::OfAll(one) => one.to_vec(),
        };
        StateList {
            q: of(0),
            qd: of(1),
            qdd: of(2),
        }
    };
    Ok((0..arguments.states()).map(state).collect())
}

/// An array of the batch's shape and then `shape`.
fn shaped<'py>(
    py: Python<'py>,
    arguments: &Arguments<'_>,
    shape: &[usize],
    numbers: Vec<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let shape = PyTuple::new(py, [&arguments.batch, shape].concat())?;
    PyArray1::from_vec(py, numbers).call_method1("reshape", (shape,))
}

/// Joints that lock, and what that takes from the tool's wrench.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Lock {
    joints: Vec<usize>,
    wrench_step: [f64; 6],
}

/// The impact torque of a lock, the forces and the moments of the structure.
#[pyfunction]
pub(crate) fn lock_impact<'py>(
    py: Python<'py>,
    arm: &Arm,
    given: &Bound<'py, PyTuple>,
    options: Lock,
) -> PyResult<[Bound<'py, PyAny>; 3]> {
    let Lock {
        joints,
        wrench_step,
    } = options;
    let n = arm.model().joints().len();
    let arguments = Arguments::read(Method::LockImpacts, n, given)?;
    let states = states(&arguments, n)?;
    let subject = arm.subject(py)?;
    let impacts = py.detach(|| {
        let impact = |state| subject.lock_impact(state, &joints, &wrench_step);
        states.iter().map(impact).collect::<Result<Vec<_>, _>>()
    });
    let impacts = impacts.map_err(|error| impossible(&error))?;
    let of = |numbers: fn(&ulna_experiments::LockImpact) -> Vec<f64>| {
        impacts.iter().flat_map(numbers).collect()
    };
    let torque = of(|impact| impact.torque.clone());
    let force = of(|impact| impact.loads.iter().flat_map(|load| load.force).collect());
    let moment = of(|impact| impact.loads.iter().flat_map(|load| load.moment).collect());
    Ok([
        shaped(py, &arguments, &[n], torque)?,
        shaped(py, &arguments, &[n, 3], force)?,
        shaped(py, &arguments, &[n, 3], moment)?,
    ])
}

/// What a cycle of the controller keeps to.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Cycle {
    wrench: [f64; 6],
    locked: Vec<usize>,
    rated_torque: Option<Vec<f64>>,
    projector: String,
}

/// A cycle of the controller for each state.
#[pyfunction]
pub(crate) fn control_cycle<'py>(
    py: Python<'py>,
    arm: &Arm,
    given: &Bound<'py, PyTuple>,
    law: &Law,
    options: Cycle,
) -> PyResult<Bound<'py, PyDict>> {
    let n = arm.model().joints().len();
    let arguments = Arguments::read(Method::LockImpacts, n, given)?;
    let states = states(&arguments, n)?;
    let subject = arm.subject(py)?;
    let Cycle {
        wrench,
        locked,
        rated_torque,
        projector,
    } = options;
    let settings = Settings {
        rated_torque,
        projector: words::projector(&projector)?,
    };
    let cycles = py.detach(|| {
        let cycle = |state| subject.cycle(&law.0, &settings, state, &wrench, &locked);
        states.iter().map(cycle).collect::<Result<Vec<_>, _>>()
    });
    let cycles = cycles.map_err(|error| impossible(&error))?;
    let of = |numbers: fn(&ulna_experiments::ControlCycle) -> &[f64]| {
        cycles.iter().flat_map(numbers).copied().collect()
    };
    let array = |shape: &[usize], numbers| shaped(py, &arguments, shape, numbers);
    let statuses: Vec<&str> = cycles
        .iter()
        .map(|cycle| words::status(cycle.status))
        .collect();
    let conditioning = cycles.iter().map(|cycle| cycle.conditioning).collect();
    let entries = Entries::new(py)
        .with("torque", array(&[n], of(|cycle| &cycle.torque))?)?
        .with("planned", array(&[n], of(|cycle| &cycle.planned))?)?
        .with(
            "compensation",
            array(&[n], of(|cycle| &cycle.compensation))?,
        )?
        .with("force_error", array(&[6], of(|cycle| &cycle.force_error))?)?
        .with("margins", array(&[n], of(|cycle| &cycle.margins))?)?
        .with("conditioning", array(&[], conditioning)?)?;
    let entries = match (&*arguments.batch, &*statuses) {
        ([], [status]) => entries.with("status", *status)?,
        _ => entries.with("status", statuses)?,
    };
    Ok(entries.done())
}
