//! Numbers, joints and findings as text.

use ulna::Status;
use ulna_study::Scenario;
use ulna_study::experiment::{Case, SearchMethod};
use ulna_study::search::SolveStatus;

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
    let joints = joints_named(scenario.failed_joints());
    match scenario.failed_joints() {
        [_] => format!("{joints} locks"),
        _ => format!("{joints} lock"),
    }
}

/// What a method is called in files.
pub(super) fn name(method: SearchMethod) -> &'static str {
    match method {
        SearchMethod::StepwisePerJoint => "eq16_steps",
        SearchMethod::PerJoint => "eq16",
        SearchMethod::StepwiseProjected => "eq20_steps",
        SearchMethod::Projected => "eq20",
        SearchMethod::Optimal => "optimal",
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

/// Four digits; what is rounding is 0.
pub(crate) fn significant(value: f64) -> String {
    let size = value.abs();
    if size < 1e-9 {
        "0".to_owned()
    } else if size < 1e-3 {
        format!("{value:.1e}")
    } else if size >= 1e5 {
        format!("{value:.3e}")
    } else {
        let decimals = (3.0 - size.log10().floor()).clamp(0.0, 5.0) as usize;
        format!("{value:.decimals$}")
    }
}
