//! [`Scenario`]: a file's scenario with its arm, and its experiments.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use ulna_experiments::{Locking, Subject};
use ulna_study::assess::GroundTruth;
use ulna_study::experiment::ExperimentError as Impossible;
use ulna_study::scenario::{Experiment, ScenarioArm, ScenarioErrors};
use ulna_table::Model;

use super::{Operation, Plan, impossible, known, studies};
use crate::arm::Arm;
use crate::errors::{ExperimentError, ScenarioError, TableError, refused};
use crate::threads::{pool, resolved};

/// The native half of `ulna.Scenario`.
#[pyclass(frozen, module = "ulna._ulna")]
pub(crate) struct Scenario {
    pub(crate) scenario: Arc<ulna_study::Scenario>,
    text: String,
    source: PathBuf,
    arm: Py<Arm>,
}

/// The scenario at `path`, or of the text, which messages call `path` and whose tables are looked for beside it.
#[pyfunction]
pub(crate) fn read_scenario(
    py: Python<'_>,
    path: PathBuf,
    text: Option<String>,
) -> PyResult<Scenario> {
    let known = known::known();
    let read = || {
        let text = match text {
            None => ulna_study::Scenario::read(&path)?,
            Some(text) => text,
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        let called = path.display().to_string();
        let scenario = ulna_study::Scenario::parse(&text, &called, folder, known)?;
        Ok::<_, ScenarioErrors>((scenario, text))
    };
    let (scenario, text) = py
        .detach(read)
        .map_err(|errors| refused::<ScenarioError>(py, errors.texts()))?;
    let arm = arm(scenario.arm())?;
    Ok(Scenario {
        scenario: Arc::new(scenario),
        text,
        source: path,
        arm: Py::new(py, arm)?,
    })
}

/// A scenario that has been read before, in another process perhaps, on another machine, with the text of the `table` that it names.
#[pyfunction]
pub(crate) fn restore_scenario(
    py: Python<'_>,
    text: String,
    source: PathBuf,
    table: String,
) -> PyResult<Scenario> {
    let called = source.display().to_string();
    let model =
        Model::parse(&table, &called).map_err(|errors| refused::<TableError>(py, &[errors]))?;
    let folder = source.parent().unwrap_or(Path::new(""));
    let known = known::known();
    let scenario = ulna_study::Scenario::parse_with_table(&text, &called, folder, known, &model)
        .map_err(|errors| refused::<ScenarioError>(py, errors.texts()))?;
    let path = match scenario.arm() {
        ScenarioArm::Known(arm) => format!("{}.toml", arm.name),
        ScenarioArm::Table { path, .. } => path.display().to_string(),
    };
    let arm = Arm::new(model, table, path, Vec::new());
    Ok(Scenario {
        scenario: Arc::new(scenario),
        text,
        source,
        arm: Py::new(py, arm)?,
    })
}

/// The arm that a scenario has found.
fn arm(found: &ScenarioArm) -> PyResult<Arm> {
    let gone = |error: ulna_table::TableErrors| ExperimentError::new_err(error.to_string());
    let (text, path) = match found {
        ScenarioArm::Known(arm) => {
            let text = known::text(arm.name).unwrap_or_default();
            (text.to_owned(), format!("{}.toml", arm.name))
        }
        ScenarioArm::Table { path, .. } => {
            let text = Model::read_in("", path).map_err(gone)?;
            (text, path.display().to_string())
        }
    };
    let model = Model::parse(&text, &path).map_err(gone)?;
    Ok(Arm::new(model, text, path, Vec::new()))
}

impl Scenario {
    pub(crate) fn subject(&self, py: Python<'_>) -> PyResult<Arc<dyn Subject>> {
        self.arm.get().subject(py)
    }

    fn experiment(&self, section: &str) -> PyResult<&Experiment> {
        let experiments = self.scenario.experiments();
        let found = experiments.iter().find(|it| it.section() == section);
        found.ok_or_else(|| {
            let sections: Vec<&str> = experiments.iter().map(Experiment::section).collect();
            ExperimentError::new_err(format!(
                "no experiment {section:?} in `{}`; there are {}",
                self.scenario.name(),
                sections.join(", ")
            ))
        })
    }
}

/// Section, title, force with its powers of time, what the lock takes from it, and rated torques.
type Row = (String, String, [Vec<f64>; 6], [f64; 6], Option<Vec<f64>>);

#[pymethods]
impl Scenario {
    #[getter]
    fn name(&self) -> &str {
        self.scenario.name()
    }

    /// What [`restore_scenario`] takes: text, file, and the arm's table.
    #[getter]
    fn state<'a>(&'a self, py: Python<'a>) -> (&'a str, &'a Path, &'a str) {
        (&self.text, &self.source, self.arm.bind(py).get().text())
    }

    #[getter]
    fn description(&self) -> &str {
        self.scenario.description()
    }

    #[getter]
    fn arm(&self, py: Python<'_>) -> Py<Arm> {
        self.arm.clone_ref(py)
    }

    #[getter]
    fn failed_joints(&self) -> Vec<usize> {
        self.scenario.failed_joints().to_vec()
    }

    #[getter]
    fn failure_times(&self) -> Vec<f64> {
        self.scenario.failure_times().to_vec()
    }

    #[getter]
    fn cycle(&self) -> f64 {
        self.scenario.cycle()
    }

    #[getter]
    fn experiments(&self) -> Vec<Row> {
        let row = |it: &Experiment| {
            let force = it.force();
            (
                it.section().to_owned(),
                it.title().to_owned(),
                force.coefficients.clone(),
                force.lock_step.into(),
                it.rated_torque().map(<[f64]>::to_vec),
            )
        };
        self.scenario.experiments().iter().map(row).collect()
    }

    fn plan(&self, py: Python<'_>) -> PyResult<Plan> {
        let subject = self.subject(py)?;
        let plan = py
            .detach(|| subject.plan(self.scenario.motion()))
            .map_err(|error| impossible(&error))?;
        Ok(Plan {
            subject,
            plan: plan.into(),
        })
    }

    /// The motion with the lock of an experiment in it.
    fn operation(&self, py: Python<'_>, section: &str, time: f64) -> PyResult<Operation> {
        let experiment = self.experiment(section)?;
        let Plan { subject, plan } = self.plan(py)?;
        let usual = Locking::new(
            self.scenario.failed_joints(),
            time,
            experiment.force().clone(),
        );
        let locking = Locking {
            rated_torque: experiment.rated_torque().map(<[f64]>::to_vec),
            projector: self.scenario.servo().projector(),
            sample_period: self.scenario.cycle(),
            step_time: experiment.step_time(),
            ..usual
        };
        Operation::new(py, &subject, &plan, locking)
    }

    /// Every search for one experiment and one failure time.
    fn study<'py>(
        &self,
        py: Python<'py>,
        section: &str,
        time: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let experiment = self.experiment(section)?;
        let subject = self.subject(py)?;
        let study = py.detach(|| subject.experiments(&self.scenario)?.study(experiment, time));
        studies::study(py, &study.map_err(|error| impossible(&error))?)
    }

    /// What the arm really does in one experiment at one failure time.
    fn simulated_lock<'py>(
        &self,
        py: Python<'py>,
        section: &str,
        time: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let experiment = self.experiment(section)?;
        let subject = self.subject(py)?;
        let lock = py.detach(|| {
            let experiments = subject.experiments(&self.scenario)?;
            experiments.simulated_lock(experiment, time)
        });
        studies::simulated_lock(py, &lock.map_err(|error| impossible(&error))?)
    }

    /// Every law over failures for which it was not tuned.
    fn assess<'py>(&self, py: Python<'py>, threads: Option<usize>) -> PyResult<Bound<'py, PyDict>> {
        let subject = self.subject(py)?;
        let pool = pool(resolved(threads))?;
        let found = py.detach(|| {
            let failures = subject.assess(&self.scenario)?;
            let (times, gains) = (failures.times().to_vec(), failures.gains());
            let cases = pool.install(|| {
                let all = (0..failures.count()).into_par_iter();
                all.map(|failure| failures.cases(failure))
                    .collect::<Result<Vec<_>, _>>()
            })?;
            let truths = gains.into_iter().map(|gain| {
                let felt = pool.install(|| {
                    let some = failures.simulated().into_par_iter();
                    some.map(|failure| failures.felt(failure, gain))
                        .collect::<Result<Vec<_>, _>>()
                })?;
                Ok(failures.ground_truth(gain, &felt))
            });
            let truths = truths.collect::<Result<Vec<GroundTruth>, Impossible>>()?;
            Ok::<_, Impossible>((times, failures.assessment(cases), truths))
        });
        let (times, assessment, truths) = found.map_err(|error| impossible(&error))?;
        studies::assessment(py, &self.scenario, &times, &assessment, &truths)
    }
}
