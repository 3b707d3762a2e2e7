//! [`Operation`]: a plan with a lock in it: searches, and what the arm really does.

use std::sync::Arc;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use ulna_experiments::{Assessed, Found, Locking, Search, Servo, Simulated, Span, Subject};
use ulna_study::search::{CoefficientLaw, ForcePriority, Objective, Optimum};
use ulna_study::simulation::Resolution;

use super::entries::Entries;
use super::words::Way;
use super::{Law, impossible, words};

/// The native half of `ulna.Operation`.
#[pyclass(frozen, module = "ulna._ulna")]
pub(crate) struct Operation {
    subject: Arc<dyn Subject>,
    plan: Arc<dyn ulna_experiments::Plan>,
    locking: Locking,
    operation: Box<dyn ulna_experiments::Operation>,
}

impl Operation {
    pub(super) fn new(
        py: Python<'_>,
        subject: &Arc<dyn Subject>,
        plan: &Arc<dyn ulna_experiments::Plan>,
        locking: Locking,
    ) -> PyResult<Self> {
        let operation = py
            .detach(|| subject.operation(&**plan, &locking))
            .map_err(|error| impossible(&error))?;
        Ok(Self {
            subject: Arc::clone(subject),
            plan: Arc::clone(plan),
            locking,
            operation,
        })
    }
}

#[pymethods]
impl Operation {
    #[getter]
    fn step<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.operation.step())
    }

    #[getter]
    fn joints(&self) -> Vec<usize> {
        self.locking.joints.clone()
    }

    #[getter]
    fn time(&self) -> f64 {
        self.locking.time
    }

    /// Searches for a compensation.
    fn search<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        min_max: bool,
        force_error: f64,
        step: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let stepwise = |law| Search::Stepwise {
            law,
            start: 0.0,
            step,
            refinements: 0,
        };
        let search = match words::way(method)? {
            Way::PerJoint => Search::PerJoint,
            Way::Projected if min_max => Search::Projected(Objective::MinMax),
            Way::Projected => Search::Projected(Objective::LeastSquares),
            Way::Optimal if force_error == 0.0 => Search::Optimal(Optimum::default()),
            Way::Optimal => Search::Optimal(Optimum {
                priority: ForcePriority::AtMost(force_error),
                ..Optimum::default()
            }),
            Way::StepwisePerJoint => stepwise(CoefficientLaw::PerJoint),
            Way::StepwiseProjected => stepwise(CoefficientLaw::Projected),
        };
        let Found {
            law,
            assessed,
            status,
            gap,
            iterations,
            seconds,
        } = py
            .detach(|| self.operation.search(&search))
            .map_err(|error| impossible(&error))?;
        let entries = Entries::new(py).with("law", Py::new(py, Law(law))?)?;
        let entries = in_entries(entries, &assessed)?
            .with("status", words::solved(status))?
            .with("gap", gap)?
            .with("iterations", iterations)?
            .with("seconds", seconds)?;
        Ok(entries.done())
    }

    /// What a law does.
    fn assess<'py>(&self, py: Python<'py>, law: &Law) -> PyResult<Bound<'py, PyDict>> {
        let assessed = py
            .detach(|| self.operation.assess(&law.0))
            .map_err(|error| impossible(&error))?;
        Ok(in_entries(Entries::new(py), &assessed)?.done())
    }

    /// What the arm really does.
    fn simulate<'py>(&self, py: Python<'py>, law: &Law, run: Run) -> PyResult<Bound<'py, PyDict>> {
        let (servo, span) = run.servo_and_span()?;
        let simulated = py.detach(|| {
            self.subject
                .simulate(&*self.plan, &self.locking, &law.0, &servo, &span)
        });
        outcome(py, &simulated.map_err(|error| impossible(&error))?)
    }
}

/// How a lock is simulated.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Run {
    start: f64,
    end: f64,
    gain: f64,
    cycle: Option<f64>,
    brake_time: f64,
    brake_profile: String,
    detection: f64,
    reflected_inertia: Option<Vec<f64>>,
    tolerance: f64,
    sample_period: f64,
}

impl Run {
    fn servo_and_span(self) -> PyResult<(Servo, Span)> {
        let servo = Servo {
            gain: self.gain,
            cycle: self.cycle,
            brake_time: self.brake_time,
            brake_profile: words::brake(&self.brake_profile)?,
            detection: self.detection,
            reflected_inertia: self.reflected_inertia,
        };
        let span = Span {
            start: self.start,
            end: self.end,
            resolution: Resolution {
                tolerance: self.tolerance,
                sample_period: self.sample_period,
                ..Resolution::default()
            },
        };
        Ok((servo, span))
    }
}

fn in_entries<'py>(entries: Entries<'py>, assessed: &Assessed) -> PyResult<Entries<'py>> {
    entries
        .list("impact", &assessed.impact)?
        .with("healthy_impact", assessed.healthy_impact)?
        .list("force_error_before", &assessed.force_error_before)?
        .list("force_error_after", &assessed.force_error_after)?
        .with("max_force_error", assessed.max_force_error)?
        .list("peak_torque", &assessed.peak_torque)?
        .list("peak_compensation", &assessed.peak_compensation)?
        .with("least_margin", assessed.least_margin)
}

fn outcome<'py>(py: Python<'py>, simulated: &Simulated) -> PyResult<Bound<'py, PyDict>> {
    let samples = simulated.samples.iter();
    let time: Vec<f64> = samples.clone().map(|sample| sample.time).collect();
    let impact = simulated.impact.as_ref().map(|impact| {
        let entries = Entries::new(py)
            .list("brake_impulse", &impact.brake_impulse)?
            .list("ideal_brake_impulse", &impact.ideal_brake_impulse)?
            .list("torque_step", &impact.torque_step)?
            .list("predicted_step", &impact.predicted_step)?
            .list("peak_torque", &impact.peak_torque)?;
        PyResult::Ok(entries.done())
    });
    let entries = Entries::new(py)
        .list("time", &time)?
        .rows("q", samples.clone().map(|sample| &sample.state.q))?
        .rows("qd", samples.clone().map(|sample| &sample.state.qd))?
        .rows("qdd", samples.clone().map(|sample| &sample.state.qdd))?
        .rows("planned_q", samples.clone().map(|sample| &sample.planned.q))?
        .rows(
            "planned_qd",
            samples.clone().map(|sample| &sample.planned.qd),
        )?
        .rows("motor", samples.clone().map(|sample| &sample.motor))?
        .rows("brake", samples.clone().map(|sample| &sample.brake))?
        .rows("joint_torque", samples.map(|sample| &sample.joint_torque))?
        .with("ending", words::ending(simulated.ending))?
        .with("impact", impact.transpose()?)?
        .with("energy_error", simulated.energy_error)?
        .with("momentum_error", simulated.momentum_error)?
        .with("status", words::status(simulated.status))?
        .with("steps", simulated.steps)?;
    Ok(entries.done())
}
