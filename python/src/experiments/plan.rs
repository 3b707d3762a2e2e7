//! [`Plan`]: a motion that an arm can execute.

use std::sync::Arc;

use numpy::PyArray2;
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

/// A motion from rest to rest: of the joints to `goal`, or of the tool by `displacement`.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Asked {
    start: Vec<f64>,
    goal: Option<Vec<f64>>,
    displacement: [f64; 6],
    duration: f64,
    blend: f64,
    profile: String,
    jerk_time: f64,
    max_acceleration: Option<Vec<f64>>,
}

/// The motion for `arm`.
#[pyfunction]
pub(crate) fn plan_motion(py: Python<'_>, arm: &Arm, asked: Asked) -> PyResult<Plan> {
    let path = match asked.goal {
        Some(goal) => MotionPath::Joint(goal),
        None => MotionPath::Tool(Vector6::from(asked.displacement)),
    };
    let shape = words::shape(&asked.profile, asked.jerk_time)?;
    let profile =
        Profile::new(asked.duration, asked.blend, shape).map_err(|error| impossible(&error))?;
    let motion = Motion::new(arm.model().joints(), asked.start, path, profile);
    let motion = motion.within(None, asked.max_acceleration.as_deref(), None);
    let subject = arm.subject(py)?;
    let planned = py.detach(|| subject.plan(&motion));
    Ok(Plan {
        subject,
        plan: planned.map_err(|error| impossible(&error))?.into(),
    })
}

/// A lock in a motion, and what is kept to.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Lock {
    joints: Vec<usize>,
    time: f64,
    force: [Vec<f64>; 6],
    lock_step: [f64; 6],
    rated_torque: Option<Vec<f64>>,
    projector: String,
    sample_period: f64,
    step_time: f64,
    effort: Option<f64>,
}

impl Lock {
    fn locking(self) -> PyResult<Locking> {
        let force = ToolForce {
            coefficients: self.force,
            lock_step: Vector6::from(self.lock_step),
        };
        let usual = Locking::new(&self.joints, self.time, force);
        Ok(Locking {
            rated_torque: self.rated_torque,
            projector: words::projector(&self.projector)?,
            sample_period: self.sample_period,
            step_time: self.step_time,
            effort: self.effort.unwrap_or(usual.effort),
            ..usual
        })
    }
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
        let states = times.into_iter().map(|time| state_at(&*self.plan, time));
        let states: Vec<_> = states.collect();
        Ok([
            rows_of(py, states.iter().map(|state| &state.q))?,
            rows_of(py, states.iter().map(|state| &state.qd))?,
            rows_of(py, states.iter().map(|state| &state.qdd))?,
        ])
    }

    /// The motion with a lock in it.
    fn lock(&self, py: Python<'_>, lock: Lock) -> PyResult<Operation> {
        Operation::new(py, &self.subject, &self.plan, lock.locking()?)
    }
}
