//! Numbers, joints and findings as text.

use ulna::{Joint, JointKind, Status};
use ulna_study::Scenario;
use ulna_study::experiment::Case;
use ulna_study::search::SolveStatus;

pub(super) use crate::numbers::significant;

/// "joint 2", "joints 1, 2 and 4" or "no joint": `joints` count from 0, names from 1.
pub(crate) fn joints_named(joints: &[usize]) -> String {
    let names: Vec<_> = joints.iter().map(|joint| (joint + 1).to_string()).collect();
    match names.split_last() {
        None => "no joint".to_owned(),
        Some((only, [])) => format!("joint {only}"),
        Some((last, others)) => format!("joints {} and {last}", others.join(", ")),
    }
}

/// "joint 2 locks" or "joints 2 and 4 lock".
pub(super) fn what_locks(scenario: &Scenario) -> String {
    locks(scenario.failed_joints())
}

/// The same of any joints, counted from 0.
pub(super) fn locks(joints: &[usize]) -> String {
    let named = joints_named(joints);
    match joints {
        [_] => format!("{named} locks"),
        _ => format!("{named} lock"),
    }
}

/// The unit of impacts of these joints together.
pub(super) fn impact_unit(joints: &[Joint]) -> &'static str {
    let slides = |joint: &Joint| joint.kind == JointKind::Prismatic;
    if joints.iter().all(slides) {
        "N"
    } else if joints.iter().any(slides) {
        "N m (N at sliding joints)"
    } else {
        "N m"
    }
}

/// How a case went: the worst cycle, or why there was no compensation.
pub(super) fn status(case: &Case) -> String {
    if let Err(error) = &case.search {
        return format!("infeasible: {error}");
    }
    let status = match case.rollout.status {
        Status::Nominal => "nominal",
        Status::Saturated => "saturated",
        Status::NearSingular => "near_singular",
        Status::Overloaded => "overloaded",
        Status::NotFinite => "not_finite",
    };
    status.to_owned()
}

/// How a search ended, in files.
pub(super) fn solve_status(status: SolveStatus) -> &'static str {
    match status {
        SolveStatus::ClosedForm => "closed_form",
        SolveStatus::Solved => "solved",
        SolveStatus::AlmostSolved => "almost_solved",
        SolveStatus::GridOptimum => "grid_optimum",
        SolveStatus::StepLimit => "step_limit",
    }
}

/// A time without superfluous digits, a very short one by its power of ten.
pub(super) fn seconds(time: f64) -> String {
    if time < 1e-3 {
        format!("{time:e}")
    } else {
        time.to_string()
    }
}

/// A coefficient with four digits; very small and very large ones by their own power of ten.
pub(super) fn coefficient(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if (1e-2..1e4).contains(&size) {
        let decimals = (3.0 - size.log10().floor()).clamp(0.0, 5.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.3e}")
    }
}

/// The same without zeros at the end: for numbers that have few digits from the start.
pub(super) fn short(value: f64) -> String {
    let text = coefficient(value);
    let trimmed = |digits: &str| match digits.split_once('.') {
        Some(_) => digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned(),
        None => digits.to_owned(),
    };
    match text.split_once('e') {
        Some((digits, power)) => format!("{}e{power}", trimmed(digits)),
        None => trimmed(&text),
    }
}
