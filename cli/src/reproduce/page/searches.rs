//! How the searches ended, in sentences: no number stands for more than its search found.

use std::fmt::{self, Write};

use ulna_study::Scenario;
use ulna_study::experiment::{Case, SearchMethod, Study};
use ulna_study::search::SolveStatus;

use super::findings::{notable, times};
use crate::reproduce::words::{short, significant};

/// Searches that did not end as they should: without a result, at the step limit, or with weaker tolerances.
pub(super) fn unfinished(page: &mut String, studies: &[&Study]) -> fmt::Result {
    let at = |wanted: &dyn Fn(&Case) -> Option<String>| -> Vec<String> {
        let cases = studies.iter().flat_map(|study| &study.cases);
        cases.filter_map(wanted).collect()
    };
    let place = |case: &Case| format!("`{}` at {} s", case.method.name(), case.failure_time);
    let status = |case: &Case| case.search.as_ref().ok().map(|search| search.status);
    let stopped = at(&|case| {
        let search = case.search.as_ref().ok()?;
        (search.status == SolveStatus::StepLimit)
            .then(|| format!("{} after {} steps", place(case), search.iterations))
    });
    if !stopped.is_empty() {
        writeln!(
            page,
            "**A search stopped at its step limit:** {}. Its coefficients are where it stood, and no optimum of the grid; \
             a larger `step` of [search] gets further.\n",
            stopped.join("; ")
        )?;
    }
    let none = at(&|case| {
        let error = case.search.as_ref().err()?;
        Some(format!("{} ({error})", place(case)))
    });
    if !none.is_empty() {
        writeln!(
            page,
            "**No compensation was found** for {}. Their rows show the motion without one, cut to the rated torques.\n",
            none.join("; ")
        )?;
    }
    let almost = at(&|case| (status(case) == Some(SolveStatus::AlmostSolved)).then(|| place(case)));
    if !almost.is_empty() {
        writeln!(
            page,
            "The solver met weaker tolerances only for {}: `search.csv` has the gaps.\n",
            almost.join("; ")
        )?;
    }
    Ok(())
}

/// Where the grid is too coarse.
pub(super) fn in_steps(page: &mut String, scenario: &Scenario, studies: &[&Study]) -> fmt::Result {
    let mut coarse = Vec::new();
    for study in studies {
        let (steps, exact) = (
            study.case(SearchMethod::StepwisePerJoint),
            study.case(SearchMethod::PerJoint),
        );
        // A search that stopped early says nothing about its grid.
        let status = steps.search.as_ref().map(|search| search.status);
        if status != Ok(SolveStatus::GridOptimum) || exact.search.is_err() {
            continue;
        }
        for joint in notable(steps) {
            let before = steps.impact_before[joint];
            let (left, possible) = (
                steps.impact_after[joint] / before,
                exact.impact_after[joint] / before,
            );
            if left > 0.05 && possible < 0.05 {
                coarse.push(format!(
                    "joint {} at {} s ({:.0} % left; k_d = {})",
                    joint + 1,
                    study.failure_time,
                    100.0 * left,
                    short(exact.coefficients[joint])
                ));
            }
        }
    }
    if coarse.is_empty() {
        return Ok(());
    }
    let milliseconds = |method: SearchMethod| {
        let searches = studies.iter().map(|study| &study.case(method).search);
        significant(1e3 * searches.flatten().map(|search| search.seconds).sum::<f64>())
    };
    writeln!(
        page,
        "**The search in steps.** A grid of step {} leaves up to half a step of k_d. That is more than 5 % of the impact where the exact \
         coefficient is only a few steps long: {}. The exact search has no such limit. For locks at {} s together it took {} ms, the search in steps {} ms.\n",
        short(scenario.search().step()),
        coarse.join("; "),
        times(studies),
        milliseconds(SearchMethod::PerJoint),
        milliseconds(SearchMethod::StepwisePerJoint),
    )
}
