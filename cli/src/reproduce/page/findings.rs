//! What an experiment says, in sentences.

use std::fmt::{self, Write};

use ulna_study::Scenario;
use ulna_study::experiment::{Case, SearchMethod, Study};
use ulna_study::scenario::Experiment;

use crate::reproduce::table::reference_at;
use crate::reproduce::words::{joints_named, name, significant};

/// An impact below this share of the largest joint's is left out of sentences about every joint.
const NEGLIGIBLE: f64 = 1e-4;
/// By so much, relative, a torque may exceed a rated one before it counts: the numbers are rounded.
const ROUNDING: f64 = 1e-12;

/// Values at the failure times, one after the other.
fn at_each(studies: &[&Study], value: impl Fn(&Study) -> f64) -> String {
    let values: Vec<_> = studies
        .iter()
        .map(|study| significant(value(study)))
        .collect();
    values.join(", ")
}

fn times(studies: &[&Study]) -> String {
    let times: Vec<_> = studies
        .iter()
        .map(|study| study.failure_time.to_string())
        .collect();
    times.join(", ")
}

/// Whether no healthy joint has an impact, but rounding.
fn is_without_impact(studies: &[&Study]) -> bool {
    let mut before = studies
        .iter()
        .map(|study| study.case(SearchMethod::PerJoint).healthy_impact().0);
    before.all(|before| before < 1e-9)
}

/// The joints of which a sentence about every joint speaks.
fn notable(case: &Case) -> impl Iterator<Item = usize> + '_ {
    let largest = case.impact_before.iter().copied().fold(0.0, f64::max);
    let joints = case.impact_before.iter().enumerate();
    joints
        .filter(move |(_, before)| **before > NEGLIGIBLE * largest)
        .map(|(joint, _)| joint)
}

pub(super) fn suppression_against_force(
    page: &mut String,
    experiment: &Experiment,
    studies: &[&Study],
) -> fmt::Result {
    if is_without_impact(studies) {
        return writeln!(
            page,
            "**The lock changes no healthy joint's torque:** there is nothing to suppress.\n"
        );
    }
    let least = |study: &Study| {
        let case = study.case(SearchMethod::PerJoint);
        let percent = case.suppression_percent();
        notable(case)
            .map(|joint| percent[joint])
            .fold(100.0, f64::min)
    };
    let least: Vec<_> = studies
        .iter()
        .map(|study| format!("{:.1}", least(study)))
        .collect();
    // Measured, not presumed: another arm may have the room that this one lacks.
    let apart = studies.iter().any(|study| {
        let (before, left) = study.case(SearchMethod::Optimal).healthy_impact();
        left > 0.05 * before
    });
    let headline = if apart {
        "**Suppression by 95 % and an untouched tool force do not hold together.**"
    } else {
        "**Here the impact can be suppressed by 95 % with the tool force untouched.**"
    };
    // Only where figures of the paper stand beside ours.
    let paper = if experiment.references().is_empty() {
        ""
    } else {
        "\nThe paper argues with Eq. 20, whose force is exact, and reports the suppression of Eq. 16.\n"
    };
    let kept = studies
        .iter()
        .map(|study| study.case(SearchMethod::Projected).rollout.max_force_error);
    let of = |method: SearchMethod, value: fn(&Case) -> f64| {
        at_each(studies, |study| value(study.case(method)))
    };
    let before: fn(&Case) -> f64 = |case| case.healthy_impact().0;
    let after: fn(&Case) -> f64 = |case| case.healthy_impact().1;
    let error: fn(&Case) -> f64 = |case| case.force_error;
    let worst: fn(&Case) -> f64 = |case| case.rollout.max_force_error;
    writeln!(
        page,
        "{} For locks at {} s, in this order:\n\n\
         - Eq. 16 takes at least {} % off the impact of every joint that has one to speak of, and bends the tool force \
         by {} N at the lock, and by up to {} N elsewhere in the motion: its coefficients are made for one pose and act in all.\n\
         - Eq. 20 keeps the tool force (to within {} N over the whole motion) and leaves {} of {} N·m over the healthy joints.\n\
         - No compensation that keeps the force before and after the lock can leave less than {} N·m (the law `optimal`).\n{}",
        headline,
        times(studies),
        least.join(", "),
        of(SearchMethod::PerJoint, error),
        of(SearchMethod::PerJoint, worst),
        match kept.fold(0.0, f64::max) {
            0.0 => "0".to_owned(),
            rounding => format!("{rounding:.0e}"),
        },
        of(SearchMethod::Projected, after),
        of(SearchMethod::Projected, before),
        of(SearchMethod::Optimal, after),
        paper
    )
}

/// What the frontier says: how little force the impact costs.
pub(super) fn price_of_suppression(page: &mut String, studies: &[&Study]) -> fmt::Result {
    let ends: Vec<_> = studies
        .iter()
        .filter_map(|study| {
            let (force, impact) = study.tradeoff.as_ref()?.frontier.last()?;
            let spent = study.case(SearchMethod::PerJoint).force_error;
            Some(format!(
                "{} N leave {} N·m at {} s (Eq. 16 spends {} N)",
                significant(*force),
                significant(*impact),
                study.failure_time,
                significant(spent)
            ))
        })
        .collect();
    if ends.is_empty() || is_without_impact(studies) {
        return Ok(());
    }
    writeln!(
        page,
        "**How the two trade off.** With free null-space torques in place of k_d ∇w_D, force error at the lock buys suppression: {}. \
         The frontier between is drawn below.\n",
        ends.join("; ")
    )
}

/// Where the grid is too coarse.
pub(super) fn search_in_steps(
    page: &mut String,
    scenario: &Scenario,
    studies: &[&Study],
) -> fmt::Result {
    let mut coarse = Vec::new();
    for study in studies {
        let (steps, exact) = (
            study.case(SearchMethod::StepwisePerJoint),
            study.case(SearchMethod::PerJoint),
        );
        for joint in notable(steps) {
            let before = steps.impact_before[joint];
            let (left, possible) = (
                steps.impact_after[joint] / before,
                exact.impact_after[joint] / before,
            );
            if left > 0.05 && possible < 0.05 {
                coarse.push(format!(
                    "joint {} at {} s ({:.0} % left; k_d = {:.2e})",
                    joint + 1,
                    study.failure_time,
                    100.0 * left,
                    exact.coefficients[joint]
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
        "**The search in steps.** A grid of step {:.0e} leaves up to half a step of k_d. That is more than 5 % of the impact where the exact \
         coefficient is only a few steps long: {}. The exact search has no such limit; it took {} ms where the search in steps took {} ms (`search.csv`).\n",
        scenario.search().step(),
        coarse.join("; "),
        milliseconds(SearchMethod::PerJoint),
        milliseconds(SearchMethod::StepwisePerJoint),
    )
}

/// What is left of the impact, here and in the references.
pub(super) fn beside_references(
    page: &mut String,
    experiment: &Experiment,
    studies: &[&Study],
) -> fmt::Result {
    for study in studies {
        let Some(reference) = reference_at(experiment, study.failure_time) else {
            continue;
        };
        let case = study.case(SearchMethod::StepwisePerJoint);
        let pairs = reference.before().iter().zip(reference.after());
        let rows: Vec<_> = pairs
            .enumerate()
            .filter_map(|(joint, pair)| match pair {
                (Some(before), Some(after)) if *before > 0.0 => Some(format!(
                    "| {} | {:.1} | {:.1} |",
                    joint + 1,
                    100.0 * after / before,
                    100.0 - case.suppression_percent()[joint]
                )),
                _ => None,
            })
            .collect();
        if !rows.is_empty() {
            writeln!(
                page,
                "Left of the impact after the search in steps, lock at {} s:\n\n\
                 | joint | {}, % | here, % |\n|---|---|---|\n{}\n",
                study.failure_time,
                reference.source(),
                rows.join("\n")
            )?;
        }
    }
    Ok(())
}

/// Which rated torques bind.
pub(super) fn limits(page: &mut String, studies: &[&Study]) -> fmt::Result {
    for study in studies {
        let case = study.case(SearchMethod::PerJoint);
        let Some(rated) = &case.rated_torque else {
            continue;
        };
        let beyond = |case: &Case, share: f64| -> Vec<usize> {
            let joints = case.rollout.max_torque.iter().zip(rated).enumerate();
            let beyond = joints.filter(|(_, (torque, rated))| **torque > **rated * share);
            beyond.map(|(joint, _)| joint).collect()
        };
        let exceeded: Vec<_> = study
            .cases
            .iter()
            .filter(|case| !beyond(case, 1.0 + ROUNDING).is_empty())
            .map(|case| name(case.method))
            .collect();
        let exceeded = if exceeded.is_empty() {
            "no law exceeds one".to_owned()
        } else {
            format!("exceeded by {}", exceeded.join(", "))
        };
        let rows = &case.rollout.series.planned;
        let plan = (0..rated.len())
            .map(|joint| rows.iter().map(|row| row[joint].abs()).fold(0.0, f64::max));
        let plan: Vec<_> = plan.map(significant).collect();
        writeln!(
            page,
            "Rated torques, lock at {} s: under Eq. 16 they bind at {}; {exceeded}. \
             The plan alone needs {} N·m of joints 1 to {}.\n",
            study.failure_time,
            joints_named(&beyond(case, 1.0 - 1e-6)),
            plan.join(", "),
            rated.len()
        )?;
    }
    Ok(())
}
