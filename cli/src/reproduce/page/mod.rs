//! `README.md`: what was found, in words. Every sentence follows from the numbers of the run.

mod besides;
mod figures;
mod findings;
mod limits;
mod lock;
mod plan;
mod redundancy;
mod references;
mod searches;
mod structure;
mod verdict;
mod worse;

use std::fmt::{self, Write};

use ulna::{Joint, JointKind};
use ulna_study::Scenario;
use ulna_study::experiment::Study;
use ulna_study::scenario::Experiment;

use super::words::{significant, status, what_locks};
use super::{Findings, lock_step};

/// The page.
pub(super) fn write(scenario: &Scenario, findings: &Findings) -> Result<String, fmt::Error> {
    let mut page = String::new();
    let description = match scenario.description() {
        "" => String::new(),
        description => format!(" The scenario says of itself: \"{description}\"."),
    };
    writeln!(
        page,
        "# {}\n\nArm `{}`; {}.{description}\n",
        scenario.name(),
        scenario.arm().name(),
        what_locks(scenario),
    )?;
    redundancy::write(&mut page, scenario, &findings.locks)?;
    writeln!(
        page,
        "Impact torque is the step of a joint's torque at the lock while the healthy joints keep to their plan (Eq. 18). \
         Forces are static: what the torques hold at the tool (Eq. 13). Coefficients are made for the lock that they are judged on. \
         Equation numbers are the paper's: *Suppression Control for Joint Impact Torque caused by Joint-Locked Failure of Space Manipulator under External Force*.\n",
    )?;
    units(&mut page, scenario, findings)?;
    figures::arm(&mut page, scenario, findings)?;
    for experiment in scenario.experiments() {
        section(&mut page, scenario, findings, experiment)?;
    }
    plan::write(&mut page, &findings.plan_steps)?;
    structure::write(&mut page, &findings.locks)?;
    lock::write(&mut page, scenario, findings)?;
    verdict::write(&mut page, scenario, findings)?;
    files(&mut page)?;
    Ok(page)
}

/// Which norms have more than one unit in them.
fn units(page: &mut String, scenario: &Scenario, findings: &Findings) -> fmt::Result {
    let first = findings.locks.first();
    if first.is_some_and(|lock| lock.task.iter().any(|row| *row >= 3)) {
        writeln!(
            page,
            "The task has moments in it: norms of the tool force and of its error, given in N, take N and N·m together.\n"
        )?;
    }
    let joints = scenario.arm().joints();
    let slides = |joint: &Joint| joint.kind == JointKind::Prismatic;
    if joints.iter().any(slides) && !joints.iter().all(slides) {
        writeln!(
            page,
            "Some joints slide: norms over the joints, given in N·m, take N·m and N together.\n"
        )?;
    }
    Ok(())
}

fn section(
    page: &mut String,
    scenario: &Scenario,
    findings: &Findings,
    experiment: &Experiment,
) -> fmt::Result {
    let studies = findings.of_section(experiment);
    let asked: Vec<_> = studies
        .iter()
        .map(|study| findings.asked(experiment, study))
        .collect();
    writeln!(page, "## {} {}\n", experiment.section(), experiment.title())?;
    lock_step::sentence(page, experiment)?;
    searches::unfinished(page, &studies)?;
    let beside = (&findings.locks[..], &asked[..]);
    findings::suppression_against_force(page, scenario, experiment, &studies, beside)?;
    worse::write(page, &studies)?;
    if experiment.section() == scenario.experiments()[0].section() {
        findings::price_of_suppression(page, &studies)?;
        searches::in_steps(page, scenario, &studies)?;
    }
    limits::write(page, scenario, &studies)?;
    references::write(page, scenario, experiment, &studies)?;
    summary(page, findings, experiment, &studies)?;
    figures::of_experiment(page, experiment)
}

fn summary(
    page: &mut String,
    findings: &Findings,
    experiment: &Experiment,
    studies: &[&Study],
) -> fmt::Result {
    writeln!(
        page,
        "| lock, s | law | impact before, norm over the healthy joints, N·m | after | force error at the lock, N | of asked, N | at worst, N | of asked at most, N | controller |\n\
         |---|---|---|---|---|---|---|---|---|"
    )?;
    for study in studies {
        let asked = findings.asked(experiment, study);
        for case in &study.cases {
            let (before, after) = case.healthy_impact();
            writeln!(
                page,
                "| {} | `{}` | {} | {} | {} | {} | {} | {} | {} |",
                study.failure_time,
                case.method.name(),
                significant(before),
                significant(after),
                significant(case.force_error),
                significant(asked.at_lock),
                significant(case.rollout.max_force_error),
                significant(asked.most),
                status(case),
            )?;
        }
    }
    writeln!(page)
}

fn files(page: &mut String) -> fmt::Result {
    writeln!(
        page,
        "## Files\n\n\
         Torques are in N·m (N at sliding joints), forces in N, times in s.\n\n\
         - `results.json`: every case with its exact search. \
         `coefficients` are k_d; the law `optimal` has none, and in their place are those of Eq. 16 that would change each joint's step at the lock alike. \
         `failed_joint` counts from 1, and is a list where several lock together. `rated_torque` is `null` where there is none. \
         `worse_joints` are the healthy ones whose own step grows; `certificate_margin`, in N·m per N, proves that no law which keeps the tool force lowers every joint. `force_error_at_lock` is the larger of just before and just after the lock; `max_force_error` and `max_torque` are over all control cycles; \
         `asked_force_at_lock` and `max_asked_force` are what the tool is to exert.\n\
         - `impact.csv`: a row for each case and joint, the search in steps among them.\n\
         - `search.csv`: the searches side by side: how they ended, gap, iterations, seconds, quality.\n\
         - `frontier.csv`: the points of the frontiers.\n\
         - `ablation.csv`: the laws with other fields in the place of ∇w_D, and the optimum on one side of the lock alone.\n\
         - `limits.csv`: what the rated torques cost, joint by joint, and what cuts which coefficient.\n\
         - `plan_steps.csv`: the torque steps of the plan itself with each profile, and those of the locks.\n\
         - `structure.csv`: what each joint transmits at the lock, along its axis and off it.\n\
         - `simulation.csv`, `convergence.csv`: the simulated locks.\n\
         - `sweep.csv`, `verdict.csv`: the locks simulated with all gains and rotors, and which compensation lowers what is felt of them.\n\
         - `series/`: torques and forces over time.\n\
         - `figures/`: SVG, and PNG of the same."
    )
}
