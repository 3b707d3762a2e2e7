//! The figures of a scenario: those that it asks for, and a frontier for each experiment.

use rayon::prelude::*;
use ulna::JointKind;
use ulna_study::Scenario;
use ulna_study::experiment::{LockMechanics, SimulatedLock, Study};
use ulna_study::scenario::{Experiment, FigureKind};
use ulna_study::search::Stepwise;

use super::Findings;
use super::words::{impact_unit, what_locks};
use crate::figures::{
    self, Arm, Convergence, Figure, Impacts, SearchFlow, SimulatedTorques, Structure, Torques,
    Tradeoffs,
};
use crate::output::Files;

/// A figure's name, its SVG and its PNG.
type Drawing = (String, String, Vec<u8>);

/// All figures, in `figures/`.
pub(super) fn add(
    files: &mut Files,
    scenario: &Scenario,
    findings: &Findings,
) -> anyhow::Result<()> {
    let kinds: Vec<_> = scenario
        .arm()
        .joints()
        .iter()
        .map(|joint| joint.kind)
        .collect();
    let of_experiments = scenario.experiments().par_iter().map(|experiment| {
        let studies = findings.of_section(experiment);
        draw(scenario, experiment, &studies, &kinds)
    });
    let of_simulation =
        rayon::iter::once(&findings.simulations).map(|simulations| match simulations {
            Ok(simulations) => draw_simulation(scenario, simulations, &kinds),
            Err(_) => Ok(Vec::new()),
        });
    let of_arm = rayon::iter::once(()).map(|()| draw_arm(scenario, findings));
    let drawn = of_experiments.chain(of_simulation).chain(of_arm);
    for (name, svg, png) in drawn.collect::<anyhow::Result<Vec<_>>>()?.concat() {
        files.add(format!("figures/{name}.svg"), svg);
        files.add(format!("figures/{name}.png"), png);
    }
    Ok(())
}

/// What a figure is of: the line below it.
pub(super) fn footer(scenario: &Scenario, section: Option<&str>) -> String {
    let experiment = section.map_or_else(String::new, |section| format!(", experiment {section}"));
    format!(
        "arm {}, scenario {}, {}{experiment}",
        scenario.arm().name(),
        scenario.name(),
        what_locks(scenario)
    )
}

fn draw(
    scenario: &Scenario,
    experiment: &Experiment,
    studies: &[&Study],
    kinds: &[JointKind],
) -> anyhow::Result<Vec<Drawing>> {
    let mut drawings = Vec::new();
    let footer = footer(scenario, Some(experiment.section()));
    for figure in experiment.figures() {
        let name = figure.name().to_owned();
        match figure.kind() {
            FigureKind::Torque { joints, time } => {
                let study = studies.iter().find(|study| study.failure_time == *time);
                if let Some(study) = study {
                    let torques = Torques {
                        study,
                        joints,
                        kinds,
                    };
                    drawings.push(both(name, &torques, &footer)?);
                }
            }
            FigureKind::Impact => {
                let with_force = !experiment.force().is_constant();
                let impacts = Impacts {
                    studies,
                    with_force,
                    unit: impact_unit(scenario.arm().joints()),
                };
                drawings.push(both(name, &impacts, &footer)?);
            }
        }
    }
    let tradeoffs = Tradeoffs { studies };
    drawings.push(both(frontier_name(experiment), &tradeoffs, &footer)?);
    Ok(drawings)
}

/// The files of the arm, of the search, and of what the lock loads the structure with.
pub(super) const HEALTHY_ARM: &str = "arm-healthy";
pub(super) const LOCKED_ARM: &str = "arm-locked";
pub(super) const SEARCH: &str = "search-in-steps";
pub(super) const STRUCTURE: &str = "structure";

/// The failure time that is drawn where there is room for one: the middle one of the list.
pub(super) fn drawn_lock(findings: &Findings) -> Option<&LockMechanics> {
    findings.locks.get(findings.locks.len() / 2)
}

/// What depends on the arm and its motion alone.
fn draw_arm(scenario: &Scenario, findings: &Findings) -> anyhow::Result<Vec<Drawing>> {
    let footer = footer(scenario, None);
    let flow = SearchFlow {
        grid: scenario.search(),
        joints: scenario.arm().joints().len(),
        most: Stepwise::<1>::with_step(scenario.search().step()).max_steps,
    };
    let locks = &findings.locks;
    let mut drawings = vec![
        both(SEARCH.to_owned(), &flow, &footer)?,
        both(STRUCTURE.to_owned(), &Structure { locks }, &footer)?,
    ];
    if let Some(lock) = drawn_lock(findings) {
        for (name, locked) in [(HEALTHY_ARM, false), (LOCKED_ARM, true)] {
            drawings.push(both(name.to_owned(), &Arm { lock, locked }, &footer)?);
        }
    }
    Ok(drawings)
}

/// The files of the simulated lock.
pub(super) const SIMULATED: &str = "simulated-lock";
/// The files of its limit.
pub(super) const CONVERGENCE: &str = "ever-shorter-brakes";

/// The lock at the middle one of the failure times, and the limit of ever shorter brakes.
fn draw_simulation(
    scenario: &Scenario,
    simulations: &[SimulatedLock],
    kinds: &[JointKind],
) -> anyhow::Result<Vec<Drawing>> {
    let Some(simulated) = simulations.get(simulations.len() / 2) else {
        return Ok(Vec::new());
    };
    let joints = strongest(simulated);
    let lock = SimulatedTorques {
        simulated,
        joints: &joints,
        kinds,
    };
    let footer = footer(scenario, Some(&simulated.section));
    Ok(vec![
        both(SIMULATED.to_owned(), &lock, &footer)?,
        both(
            CONVERGENCE.to_owned(),
            &Convergence { simulations },
            &footer,
        )?,
    ])
}

/// The joints that lock, and of the others those with the largest predicted steps: four in all, if there are as many.
fn strongest(simulated: &SimulatedLock) -> Vec<usize> {
    let mut joints = simulated.failed_joints.clone();
    if let Some(run) = simulated.runs.first() {
        let step = |joint: &usize| run.predicted_step[*joint].abs();
        let mut others: Vec<_> = (0..run.predicted_step.len()).collect();
        others.retain(|joint| !joints.contains(joint));
        others.sort_by(|a, b| step(b).total_cmp(&step(a)));
        joints.extend(
            others
                .into_iter()
                .take(4_usize.saturating_sub(joints.len())),
        );
    }
    joints.sort_unstable();
    joints
}

/// What the frontier's files are called.
pub(super) fn frontier_name(experiment: &Experiment) -> String {
    format!("frontier-{}", experiment.section())
}

fn both(name: String, figure: &impl Figure, footer: &str) -> anyhow::Result<Drawing> {
    let (svg, png) = (figures::svg(figure, footer)?, figures::png(figure, footer)?);
    Ok((name, svg, png))
}
