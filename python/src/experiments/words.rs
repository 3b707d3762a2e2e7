//! The words that stand for choices, and for how something ended.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use ulna::control::compensation::Projector;
use ulna::{ProfileShape, Status};
use ulna_study::search::SolveStatus;
use ulna_study::simulation::{BrakeProfile, Ending};

/// The choice that `word` stands for.
fn chosen<T: Copy>(argument: &str, word: &str, choices: &[(&str, T)]) -> PyResult<T> {
    let found = choices.iter().find(|(name, _)| *name == word);
    found.map(|(_, choice)| *choice).ok_or_else(|| {
        let names: Vec<String> = choices
            .iter()
            .map(|(name, _)| format!("{name:?}"))
            .collect();
        PyValueError::new_err(format!(
            "{argument}: expected {}, found {word:?}",
            names.join(" or ")
        ))
    })
}

/// `jerk_time` is that of an S-curve, s.
pub(super) fn shape(word: &str, jerk_time: f64) -> PyResult<ProfileShape> {
    let choices = [
        ("trapezoid", ProfileShape::Trapezoid),
        ("quintic", ProfileShape::Quintic),
        ("s_curve", ProfileShape::SCurve { jerk_time }),
    ];
    chosen("profile", word, &choices)
}

pub(super) fn projector(word: &str) -> PyResult<Projector> {
    let choices = [
        ("static", Projector::Static),
        ("dynamically_consistent", Projector::DynamicallyConsistent),
    ];
    chosen("projector", word, &choices)
}

pub(super) fn brake(word: &str) -> PyResult<BrakeProfile> {
    let choices = [
        ("constant", BrakeProfile::Constant),
        ("smooth", BrakeProfile::Smooth),
    ];
    chosen("brake_profile", word, &choices)
}

/// The ways to search.
#[derive(Clone, Copy)]
pub(super) enum Way {
    PerJoint,
    Projected,
    Optimal,
    StepwisePerJoint,
    StepwiseProjected,
}

pub(super) fn way(word: &str) -> PyResult<Way> {
    let choices = [
        ("eq16", Way::PerJoint),
        ("eq20", Way::Projected),
        ("optimal", Way::Optimal),
        ("eq16_steps", Way::StepwisePerJoint),
        ("eq20_steps", Way::StepwiseProjected),
    ];
    chosen("method", word, &choices)
}

/// As files of the program call it.
pub(super) fn status(status: Status) -> &'static str {
    match status {
        Status::Nominal => "nominal",
        Status::Saturated => "saturated",
        Status::NearSingular => "near_singular",
        Status::Overloaded => "overloaded",
        Status::NotFinite => "not_finite",
    }
}

/// As files of the program call it.
pub(super) fn solved(status: SolveStatus) -> &'static str {
    match status {
        SolveStatus::ClosedForm => "closed_form",
        SolveStatus::Solved => "solved",
        SolveStatus::AlmostSolved => "almost_solved",
        SolveStatus::GridOptimum => "grid_optimum",
        SolveStatus::StepLimit => "step_limit",
    }
}

pub(super) fn ending(ending: Ending) -> &'static str {
    match ending {
        Ending::Complete => "complete",
        Ending::NotFinite => "not_finite",
        Ending::StepTooShort => "step_too_short",
    }
}
