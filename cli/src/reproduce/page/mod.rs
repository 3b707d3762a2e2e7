//! `README.md`: what was found, in words, with the numbers of this run in them.

mod besides;
mod findings;
mod lock;
mod verdict;

use std::fmt::{self, Write};

use ulna_study::Scenario;
use ulna_study::experiment::Study;
use ulna_study::scenario::{Experiment, FigureKind};

use super::Findings;
use super::drawings::frontier_name;
use super::words::{joints_named, name, significant, status, what_locks};
use findings::{
    beside_references, limits, price_of_suppression, search_in_steps, suppression_against_force,
};

/// The page.
pub(super) fn write(scenario: &Scenario, findings: &Findings) -> Result<String, fmt::Error> {
    let mut page = String::new();
    let description = match scenario.description() {
        "" => String::new(),
        description => format!(" Its motion is {description}."),
    };
    writeln!(
        page,
        "# {}\n\nArm `{}`; {}.{description}\n\n\
         Impact torque is the step of a joint's torque at the lock while the healthy joints keep to their plan (Eq. 18). \
         Forces are static: what the torques hold at the tool (Eq. 13).\n",
        scenario.name(),
        scenario.arm().name(),
        what_locks(scenario),
    )?;
    for experiment in scenario.experiments() {
        let studies = findings.of_section(experiment);
        writeln!(page, "## {} {}\n", experiment.section(), experiment.title())?;
        if experiment.section() == scenario.experiments()[0].section() {
            suppression_against_force(&mut page, experiment, &studies)?;
            price_of_suppression(&mut page, &studies)?;
            search_in_steps(&mut page, scenario, &studies)?;
        }
        limits(&mut page, &studies)?;
        beside_references(&mut page, experiment, &studies)?;
        summary(&mut page, &studies)?;
        figures(&mut page, experiment)?;
    }
    lock::write(&mut page, scenario, findings)?;
    verdict::write(&mut page, scenario, findings)?;
    files(&mut page)?;
    Ok(page)
}

fn summary(page: &mut String, studies: &[&Study]) -> fmt::Result {
    writeln!(
        page,
        "| lock, s | law | impact before, norm over the healthy joints, N·m | after | force error at the lock, N | at worst, N | controller |\n\
         |---|---|---|---|---|---|---|"
    )?;
    for study in studies {
        for case in &study.cases {
            let (before, after) = case.healthy_impact();
            writeln!(
                page,
                "| {} | `{}` | {} | {} | {} | {} | {} |",
                study.failure_time,
                name(case.method),
                significant(before),
                significant(after),
                significant(case.force_error),
                significant(case.rollout.max_force_error),
                status(case),
            )?;
        }
    }
    writeln!(page)
}

fn figures(page: &mut String, experiment: &Experiment) -> fmt::Result {
    for figure in experiment.figures() {
        let caption = match figure.kind() {
            FigureKind::Torque { joints, time } => {
                format!(
                    "Torques of {} with the lock at {time} s, without and with suppression; on the right the half second before and after it",
                    joints_named(joints)
                )
            }
            FigureKind::Impact => "Impact torque joint by joint; bars end at 0.001 N·m".to_owned(),
        };
        writeln!(
            page,
            "![{caption}](figures/{}.svg)\n\n*{caption}.*\n",
            figure.name()
        )?;
    }
    let caption =
        "What force error buys: the least impact that any compensation leaves, and the three laws";
    writeln!(
        page,
        "![{caption}](figures/{}.svg)\n\n*{caption}.*\n",
        frontier_name(experiment)
    )
}

fn files(page: &mut String) -> fmt::Result {
    writeln!(
        page,
        "## Files\n\n\
         Torques are in N·m (N at sliding joints), forces in N, times in s.\n\n\
         - `results.json`: every case with its exact search. \
         `coefficients` are k_d; the law `optimal` has none, and in their place are those of Eq. 16 that would change each joint's step at the lock alike. \
         `failed_joint` counts from 1, and is a list where several lock together. `rated_torque` is `null` where there is none. \
         `max_force_error` and `max_torque` are over all control cycles.\n\
         - `impact.csv`: a row for each case and joint, the search in steps among them.\n\
         - `search.csv`: the searches side by side: how they ended, gap, iterations, seconds, quality.\n\
         - `frontier.csv`: the points of the frontiers.\n\
         - `truth.csv`, `convergence.csv`: the simulated locks.\n\
         - `sweep.csv`, `verdict.csv`: the locks simulated with all gains and rotors, and which compensation lowers what is felt of them.\n\
         - `series/`: torques and forces over time.\n\
         - `figures/`: SVG, and PNG of the same."
    )
}
