//! [`Plan`]: a motion that an arm can execute.

use std::sync::Arc;

use numpy::PyArray2;
use numpy::prelude::*;
use pyo3::prelude::*;
use ulna::Profile;
use ulna::nalgebra::Vector6;
use ulna_experiments::{Locking, Subject, state_at};
use ulna_study::scenario::{Motion, MotionPath, ToolForce};

use super::entries::rows_of;
use super::{Operation, impossible, words};
use crate::arm::Arm;

/// The native half of `ulna.Plan`.
#[pyclass(frozen, module = "ulna._ulna")]
pub(crate) struct Plan {
    pub(super) subject: Arc<dyn Subject>,
    pub(super) plan: Arc<dyn ulna_experiments::Plan>,
}

/// A motion of `arm` from rest to rest.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python's own keywords")]
pub(crate) fn plan(
    py: Python<'_>,
    arm: &Arm,
    start: Vec<f64>,
    goal: Option<Vec<f64>>,
    displacement: Option<[f64; 6]>,
    duration: f64,
    blend: f64,
    profile: &str,
    max_acceleration: Option<Vec<f64>>,
) -> PyResult<Plan> {
    let path = match (goal, displacement) {
        (Some(goal), _) => MotionPath::Joint(goal),
        (None, displacement) => MotionPath::Tool(Vector6::from(displacement.unwrap_or_default())),
    };
    let shape = words::shape(profile)?;
    let profile = Profile::new(duration, blend, shape).map_err(impossible)?;
    let motion = Motion::new(arm.model().joints(), start, path, profile);
    let motion = motion.within(None, max_acceleration.as_deref(), None);
    let subject = arm.subject(py)?;
    let planned = py.detach(|| subject.plan(&motion)).map_err(impossible)?;
    Ok(Plan {
        subject,
        plan: planned.into(),
    })
}

#[pymethods]
impl Plan {
    #[getter]
    fn duration(&self) -> f64 {
        self.plan.duration()
    }

    #[getter]
    fn n(&self) -> usize {
        self.plan.joints()
    }

    /// q, qd and qdd, a row for each time.
    fn states<'py>(
        &self,
        py: Python<'py>,
        times: Vec<f64>,
    ) -> PyResult<[Bound<'py, PyArray2<f64>>; 3]> {
        let states: Vec<_> = times.iter().map(|time| state_at(&*self.plan, *time)).collect();
        let empty = || Ok(PyArray2::zeros(py, [0, self.plan.joints()], false));
        if states.is_empty() {
            return Ok([empty()?, empty()?, empty()?]);
        }
        Ok([
            rows_of(py, states.iter().map(|state| &state.q))?,
            rows_of(py, states.iter().map(|state| &state.qd))?,
            rows_of(py, states.iter().map(|state| &state.qdd))?,
        ])
    }

    /// The motion with a lock in it.
    #[expect(clippy::too_many_arguments, reason = "Python's own keywords")]
    fn lock(
        &self,
        py: Python<'_>,
        joints: Vec<usize>,
        time: f64,
        force: [Vec<f64>; 6],
        lock_step: [f64; 6],
        rated_torque: Option<Vec<f64>>,
        projector: &str,
        sample_period: f64,
        step_time: f64,
        effort: Option<f64>,
    ) -> PyResult<Operation> {
        let force = ToolForce {
            coefficients: force,
            lock_step: Vector6::from(lock_step),
        };
        let usual = Locking::new(&joints, time, force);
        let locking = Locking {
            rated_torque,
            projector: words::projector(projector)?,
            sample_period,
            step_time,
            effort: effort.unwrap_or(usual.effort),
            ..usual
        };
        Operation::new(py, &self.subject, &self.plan, locking)
    }
}
