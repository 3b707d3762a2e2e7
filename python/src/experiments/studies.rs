//! What studies, simulated locks and assessments found, as dictionaries.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use ulna_study::assess::{
    AssessedCase, Assessment, FeltLaw, GroundTruth, LawAssessment, Statistics,
};
use ulna_study::experiment::{Case, SimulatedLock, SimulatedRun, Study};

use super::entries::Entries;
use super::words;

pub(super) fn study<'py>(py: Python<'py>, study: &Study) -> PyResult<Bound<'py, PyDict>> {
    let cases = PyDict::new(py);
    for found in &study.cases {
        cases.set_item(found.method.name(), case(py, found)?)?;
    }
    let points = study.tradeoff.as_ref().map_or(&[][..], |it| &it.frontier);
    let column = |number: fn(&(f64, f64)) -> f64| points.iter().map(number).collect::<Vec<f64>>();
    let frontier = Entries::new(py)
        .list("force_error", &column(|point| point.0))?
        .list("impact", &column(|point| point.1))?;
    let entries = Entries::new(py)
        .with("section", &study.section)?
        .with("failure_time", study.failure_time)?
        .with("cases", cases)?
        .with("frontier", frontier.done())?;
    Ok(entries.done())
}

fn case<'py>(py: Python<'py>, case: &Case) -> PyResult<Bound<'py, PyDict>> {
    let (before, after) = case.healthy_impact();
    let series = &case.rollout.series;
    let over_time = Entries::new(py)
        .list("time", &series.time)?
        .rows("planned", series.planned.iter())?
        .rows("torque", series.torque.iter())?
        .rows("force", series.force.iter())?
        .rows("force_error", series.force_error.iter())?;
    let infeasible = case.search.as_ref().err().map(ToString::to_string);
    let entries = Entries::new(py)
        .with("failed_joints", &case.failed_joints)?
        .list("impact_before", &case.impact_before)?
        .list("impact_after", &case.impact_after)?
        .list("suppression_percent", &case.suppression_percent())?
        .with("healthy_impact_before", before)?
        .with("healthy_impact_after", after)?
        .list("coefficients", &case.coefficients)?
        .with("force_error", case.force_error)?
        .list("max_torque", &case.rollout.max_torque)?
        .with("max_force_error", case.rollout.max_force_error)?
        .with("status", words::status(case.rollout.status))?
        .with("infeasible", infeasible)?
        .with("series", over_time.done())?;
    Ok(entries.done())
}

pub(super) fn simulated_lock<'py>(
    py: Python<'py>,
    lock: &SimulatedLock,
) -> PyResult<Bound<'py, PyDict>> {
    let runs = PyDict::new(py);
    for found in &lock.runs {
        runs.set_item(
            found.method.map_or("none", |method| method.name()),
            run(py, found)?,
        )?;
    }
    let unfinished = PyDict::new(py);
    for (method, ending) in &lock.unfinished {
        unfinished.set_item(method.name(), words::ending(*ending))?;
    }
    let column = |number: fn(&ulna_study::experiment::BrakeImpulse) -> f64| {
        lock.convergence.iter().map(number).collect::<Vec<f64>>()
    };
    let convergence = Entries::new(py)
        .list("brake_time", &column(|it| it.brake_time))?
        .rows("impulse", lock.convergence.iter().map(|it| &it.impulse))?
        .rows("ideal", lock.convergence.iter().map(|it| &it.ideal))?
        .list("relative_difference", &column(|it| it.relative_difference))?
        .list("peak_brake_torque", &column(|it| it.peak_brake_torque))?;
    let entries = Entries::new(py)
        .with("section", &lock.section)?
        .with("failure_time", lock.failure_time)?
        .with("failed_joints", &lock.failed_joints)?
        .with("brake_time", lock.brake_time)?
        .with("detection", lock.detection)?
        .with("gain", lock.gain)?
        .with("lead", lock.lead)?
        .list("reflected_inertia", &lock.reflected_inertia)?
        .list("braking_step", &lock.braking_step)?
        .with("runs", runs)?
        .with("unfinished", unfinished)?
        .with("convergence", convergence.done())?;
    Ok(entries.done())
}

fn run<'py>(py: Python<'py>, run: &SimulatedRun) -> PyResult<Bound<'py, PyDict>> {
    let entries = Entries::new(py)
        .list("predicted_step", &run.predicted_step)?
        .list("torque_step", &run.torque_step)?
        .list("peak_torque", &run.peak_torque)?
        .with("tool_acceleration", run.tool_acceleration)?
        .with("energy_error", run.energy_error)?
        .list("time", &run.time)?
        .rows("torque", run.torque.iter())?
        .rows("predicted_torque", run.predicted_torque.iter())?;
    Ok(entries.done())
}

/// As `assess.json` has it, but that joints count from 0 and that the cases of a law are a table of columns.
pub(super) fn assessment<'py>(
    py: Python<'py>,
    scenario: &ulna_study::Scenario,
    times: &[f64],
    assessment: &Assessment,
    truths: &[GroundTruth],
) -> PyResult<Bound<'py, PyDict>> {
    let laws = PyList::empty(py);
    for found in &assessment.laws {
        laws.append(law(py, found)?)?;
    }
    let ground_truth = PyList::empty(py);
    for truth in truths {
        let laws = PyList::empty(py);
        for found in &truth.laws {
            laws.append(felt(py, found)?)?;
        }
        let entries = Entries::new(py)
            .with("gain", truth.gain)?
            .with("laws", laws)?;
        ground_truth.append(entries.done())?;
    }
    let entries = Entries::new(py)
        .with("arm", scenario.arm().name())?
        .with("scenario", scenario.name())?
        .list("failure_times", times)?
        .with("laws", laws)?
        .with("ground_truth", ground_truth)?;
    Ok(entries.done())
}

fn law<'py>(py: Python<'py>, law: &LawAssessment) -> PyResult<Bound<'py, PyDict>> {
    let tuned = law.tuned.as_ref().map(|tuned| {
        let entries = Entries::new(py).with("joints", &tuned.joints)?;
        PyResult::Ok(entries.with("time", tuned.time)?.done())
    });
    let entries = Entries::new(py)
        .with("law", law.law.name())?
        .with("tuned", tuned.transpose()?)?
        .with("force_budget", law.force_budget)?
        .with("note", &law.note)?
        .with("cases", cases(py, &law.cases)?)?;
    let entries = statistics(entries, &law.singles)?;
    let pairs = law
        .pairs
        .as_ref()
        .map(|pairs| PyResult::Ok(statistics(Entries::new(py), pairs)?.done()));
    Ok(entries.with("pairs", pairs.transpose()?)?.done())
}

/// A column for each quantity.
fn cases<'py>(py: Python<'py>, cases: &[AssessedCase]) -> PyResult<Bound<'py, PyDict>> {
    let column = |number: fn(&AssessedCase) -> f64| cases.iter().map(number).collect::<Vec<f64>>();
    let joints: Vec<_> = cases.iter().map(|case| case.joints.clone()).collect();
    let entries = Entries::new(py)
        .with("joints", joints)?
        .list("time", &column(|case| case.time))?
        .list("before", &column(|case| case.before))?
        .list("after", &column(|case| case.after))?
        .list("force_error", &column(|case| case.force_error))?
        .list(
            "force_error_at_lock",
            &column(|case| case.force_error_at_lock),
        )?
        .list("least_margin", &column(|case| case.least_margin))?
        .list("fastest_change", &column(|case| case.fastest_change))?;
    Ok(entries.done())
}

fn statistics<'py>(entries: Entries<'py>, found: &Statistics) -> PyResult<Entries<'py>> {
    entries
        .with("count", found.count)?
        .with("worst_ratio", found.worst_ratio)?
        .with("median_ratio", found.median_ratio)?
        .with("cvar", found.cvar)?
        .with("share_worse", found.share_worse)?
        .with("worst_before", found.worst_before)?
        .with("worst_after", found.worst_after)?
        .with("worst_force_error", found.worst_force_error)?
        .with("worst_force_error_at_lock", found.worst_force_error_at_lock)?
        .with("least_margin", found.least_margin)?
        .with("fastest_change", found.fastest_change)
}

fn felt<'py>(py: Python<'py>, law: &FeltLaw) -> PyResult<Bound<'py, PyDict>> {
    let entries = Entries::new(py)
        .with("law", law.law.name())?
        .with("force_budget", law.force_budget)?
        .with("count", law.count)?
        .with("unfinished", law.unfinished)?
        .with("median_ratio", law.median_ratio)?
        .with("worst_ratio", law.worst_ratio)?
        .with("share_worse", law.share_worse)?;
    Ok(entries.done())
}
