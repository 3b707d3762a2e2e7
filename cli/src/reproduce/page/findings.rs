//! What the laws do in an experiment, in sentences.

use std::fmt::{self, Write};

use ulna::Status;
use ulna_study::Scenario;
use ulna_study::experiment::{Case, LockMechanics, SearchMethod, Study};
use ulna_study::scenario::Experiment;

use super::redundancy::Room;
use crate::reproduce::force::Asked;
use crate::reproduce::references::is_beside_paper;
use crate::reproduce::words::significant;

/// An impact below this share of the largest joint's is left out of sentences about every joint.
const NEGLIGIBLE: f64 = 1e-4;

/// Values at the failure times, one after the other.
fn at_each(studies: &[&Study], value: impl Fn(&Study) -> String) -> String {
    let values: Vec<_> = studies.iter().map(|study| value(study)).collect();
    values.join(", ")
}

pub(super) fn times(studies: &[&Study]) -> String {
    at_each(studies, |study| study.failure_time.to_string())
}

/// Whether no healthy joint has an impact, but rounding.
fn is_without_impact(studies: &[&Study]) -> bool {
    let mut before = studies
        .iter()
        .map(|study| study.case(SearchMethod::PerJoint).healthy_impact().0);
    before.all(|before| before < 1e-9)
}

/// The joints of which a sentence about every joint speaks.
pub(super) fn notable(case: &Case) -> impl Iterator<Item = usize> + '_ {
    let largest = case.impact_before.iter().copied().fold(0.0, f64::max);
    let joints = case.impact_before.iter().enumerate();
    joints
        .filter(move |(_, before)| **before > NEGLIGIBLE * largest)
        .map(|(joint, _)| joint)
}

/// A number of a method at each failure time, or that there is none.
fn of(studies: &[&Study], method: SearchMethod, value: fn(&Case) -> f64) -> String {
    at_each(studies, |study| {
        let case = study.case(method);
        match case.search {
            Ok(_) => significant(value(case)),
            Err(_) => "(none found)".to_owned(),
        }
    })
}

/// Whether a method has a compensation at some failure time.
fn is_found(studies: &[&Study], method: SearchMethod) -> bool {
    let mut cases = studies.iter().map(|study| study.case(method));
    cases.any(|case| case.search.is_ok())
}

/// The norm over the healthy joints without compensation.
fn before(studies: &[&Study]) -> String {
    at_each(studies, |study| {
        significant(study.case(SearchMethod::PerJoint).healthy_impact().0)
    })
}

/// The share of the impact that a method leaves over the healthy joints; 1 where there is none to take away.
fn share_left(study: &Study, method: SearchMethod) -> f64 {
    let (before, after) = study.case(method).healthy_impact();
    if before < 1e-9 { 1.0 } else { after / before }
}

/// What the laws leave, and what it costs.
pub(super) fn suppression_against_force(
    page: &mut String,
    scenario: &Scenario,
    experiment: &Experiment,
    studies: &[&Study],
    (locks, asked): (&[LockMechanics], &[Asked]),
) -> fmt::Result {
    if is_without_impact(studies) {
        return writeln!(
            page,
            "**The lock changes no healthy joint's torque:** there is nothing to suppress.\n"
        );
    }
    let after: fn(&Case) -> f64 = |case| case.healthy_impact().1;
    if locks.iter().all(|lock| Room::of(lock) == Room::None) {
        return writeln!(
            page,
            "For locks at {} s the healthy joints bear steps of {} N·m (norm), and with every law of {} N·m: there is no joint to spare.\n",
            times(studies),
            before(studies),
            of(studies, SearchMethod::Optimal, after),
        );
    }
    writeln!(
        page,
        "{} For locks at {} s, in this order:\n",
        headline(scenario, experiment, studies),
        times(studies)
    )?;
    writeln!(
        page,
        "- Without compensation the healthy joints bear steps of {} N·m (norm). The tool is to exert {} N at the lock, at most {} N in the motion.",
        before(studies),
        join(asked, |asked| asked.at_lock),
        join(asked, |asked| asked.most),
    )?;
    per_joint(page, studies, after)?;
    if is_found(studies, SearchMethod::Projected) {
        writeln!(
            page,
            "- Eq. 20 leaves {} N·m, and {}.",
            of(studies, SearchMethod::Projected, after),
            force_error(studies, SearchMethod::Projected)
        )?;
    }
    if is_found(studies, SearchMethod::Optimal) {
        writeln!(
            page,
            "- The least that any compensation can leave that keeps the tool force before and after the lock is {} N·m (the law `optimal`); it {}.",
            of(studies, SearchMethod::Optimal, after),
            force_error(studies, SearchMethod::Optimal)
        )?;
    }
    writeln!(page)?;
    if is_beside_paper(scenario, experiment, studies) {
        writeln!(
            page,
            "The paper argues with Eq. 20, whose force is exact, and reports the suppression of Eq. 16.\n"
        )?;
    }
    Ok(())
}

/// What Eq. 16 does.
fn per_joint(page: &mut String, studies: &[&Study], after: fn(&Case) -> f64) -> fmt::Result {
    if !is_found(studies, SearchMethod::PerJoint) {
        return Ok(());
    }
    let mut kept = Vec::new();
    for study in studies {
        let case = study.case(SearchMethod::PerJoint);
        let percent = case.suppression_percent();
        let joints = notable(case).filter(|joint| case.search.is_ok() && percent[*joint] < 95.0);
        kept.extend(joints.map(|joint| {
            format!(
                "joint {} at {} s ({:.0} %)",
                joint + 1,
                study.failure_time,
                100.0 - percent[joint]
            )
        }));
    }
    let kept = if kept.is_empty() {
        "no joint keeps more than 5 % of its impact, the locked one included (those with less than 1e-4 of the largest impact aside)".to_owned()
    } else {
        format!("more than 5 % of the impact is kept by {}", kept.join(", "))
    };
    writeln!(
        page,
        "- Eq. 16 leaves {} N·m: {kept}. It {}.",
        of(studies, SearchMethod::PerJoint, after),
        force_error(studies, SearchMethod::PerJoint),
    )
}

/// What a method does to the tool force.
fn force_error(studies: &[&Study], method: SearchMethod) -> String {
    let cases = studies.iter().map(|study| study.case(method));
    let cases = || cases.clone().filter(|case| case.search.is_ok());
    let most = cases().map(|case| case.rollout.max_force_error);
    let most = most.fold(0.0, f64::max);
    let overloaded = cases().any(|case| case.rollout.status == Status::Overloaded);
    let text = if most < 1e-6 {
        "keeps the tool force over the whole motion (force error below 1e-6 N)".to_owned()
    } else {
        format!(
            "bends the tool force by {} N at the lock, and by up to {} N in the motion",
            of(studies, method, |case| case.force_error),
            of(studies, method, |case| case.rollout.max_force_error),
        )
    };
    if overloaded {
        format!(
            "{text}; at times motion and tool force alone exceed a rated torque, and the cut bends the force (status `overloaded`)"
        )
    } else {
        text
    }
}

fn join(asked: &[Asked], value: fn(&Asked) -> f64) -> String {
    let values: Vec<_> = asked
        .iter()
        .map(|asked| significant(value(asked)))
        .collect();
    values.join(", ")
}

/// The main finding, of this run's numbers.
fn headline(scenario: &Scenario, experiment: &Experiment, studies: &[&Study]) -> String {
    let found = |method: SearchMethod| {
        let studies = studies
            .iter()
            .filter(|study| study.case(method).search.is_ok());
        studies
            .map(|study| share_left(study, method))
            .collect::<Vec<_>>()
    };
    let kept = found(SearchMethod::Optimal);
    let (Some(least), Some(most)) = (
        kept.iter().copied().reduce(f64::min),
        kept.iter().copied().reduce(f64::max),
    ) else {
        return "**No compensation keeps the tool force and the rated torques.**".to_owned();
    };
    let claimed = is_beside_paper(scenario, experiment, studies);
    if most <= 0.05 {
        return "**Here 95 % of the impact can be taken away with the tool force untouched.**"
            .to_owned();
    }
    let range = if (most - least) < 0.01 {
        format!("{:.0} %", 100.0 * most)
    } else {
        format!("{:.0} to {:.0} %", 100.0 * least, 100.0 * most)
    };
    if claimed {
        format!(
            "**Suppression by 95 % and an untouched tool force do not hold together:** with the force kept, at least {range} of the impact stays."
        )
    } else {
        format!("**With the tool force kept, at least {range} of the impact stays.**")
    }
}

/// What the frontier says: how little force the impact costs.
pub(super) fn price_of_suppression(page: &mut String, studies: &[&Study]) -> fmt::Result {
    if is_without_impact(studies) {
        return Ok(());
    }
    let ends: Vec<_> = studies
        .iter()
        .filter_map(|study| {
            let (force, impact) = study.tradeoff.as_ref()?.frontier.last()?;
            let eq16 = study.case(SearchMethod::PerJoint);
            let spent = if eq16.search.is_ok() && *force > 0.0 {
                format!(
                    " (Eq. 16 spends {} N and leaves {} N·m)",
                    significant(eq16.force_error),
                    significant(eq16.healthy_impact().1)
                )
            } else {
                String::new()
            };
            Some((
                *force,
                format!(
                    "{} N leave {} N·m at {} s{spent}",
                    significant(*force),
                    significant(*impact),
                    study.failure_time
                ),
            ))
        })
        .collect();
    // Without a law that spends force, the frontier is a point.
    if ends.iter().all(|(force, _)| *force <= 0.0) {
        return Ok(());
    }
    let ends: Vec<_> = ends.into_iter().map(|(_, text)| text).collect();
    writeln!(
        page,
        "**How the two trade off.** With free torques in place of k_d ∇w_D, force error at the lock buys suppression: {}. \
         The frontier between is drawn below; the force error elsewhere in the motion is not in it.\n",
        ends.join("; ")
    )
}
