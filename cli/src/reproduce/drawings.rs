//! The figures of a scenario: those that it asks for, and a frontier for each experiment.

use rayon::prelude::*;
use ulna::JointKind;
use ulna_study::Scenario;
use ulna_study::experiment::{Study, Truth};
use ulna_study::scenario::{Experiment, FigureKind};

use super::Findings;
use crate::figures::{self, Convergence, Figure, Impacts, SimulatedTorques, Torques, Tradeoffs};
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
        draw(experiment, &studies, &kinds)
    });
    let of_truth = rayon::iter::once(&findings.truths).map(|truths| match truths {
        Ok(truths) => draw_truth(truths, &kinds),
        Err(_) => Ok(Vec::new()),
    });
    let drawn = of_experiments.chain(of_truth);
    for (name, svg, png) in drawn.collect::<anyhow::Result<Vec<_>>>()?.concat() {
        files.add(format!("figures/{name}.svg"), svg);
        files.add(format!("figures/{name}.png"), png);
    }
    Ok(())
}

fn draw(
    experiment: &Experiment,
    studies: &[&Study],
    kinds: &[JointKind],
) -> anyhow::Result<Vec<Drawing>> {
    let mut drawings = Vec::new();
    for figure in experiment.figures() {
        let name = figure.name().to_owned();
        match figure.kind() {
            FigureKind::Torque { joints, time } => {
                let study = studies.iter().find(|study| study.failure_time == *time);
                if let Some(study) = study {
                    drawings.push(both(
                        name,
                        &Torques {
                            study,
                            joints,
                            kinds,
                        },
                    )?);
                }
            }
            FigureKind::Impact => {
                let with_force = !experiment.force().is_constant();
                drawings.push(both(
                    name,
                    &Impacts {
                        studies,
                        with_force,
                    },
                )?);
            }
        }
    }
    drawings.push(both(frontier_name(experiment), &Tradeoffs { studies })?);
    Ok(drawings)
}

/// The files of the simulated lock.
pub(super) const SIMULATED: &str = "simulated-lock";
/// The files of its limit.
pub(super) const CONVERGENCE: &str = "ever-shorter-brakes";

/// The lock at the middle one of the failure times, and the limit of ever shorter brakes.
fn draw_truth(truths: &[Truth], kinds: &[JointKind]) -> anyhow::Result<Vec<Drawing>> {
    let Some(truth) = truths.get(truths.len() / 2) else {
        return Ok(Vec::new());
    };
    let joints = strongest(truth);
    let lock = SimulatedTorques {
        truth,
        joints: &joints,
        kinds,
    };
    Ok(vec![
        both(SIMULATED.to_owned(), &lock)?,
        both(CONVERGENCE.to_owned(), &Convergence { truths })?,
    ])
}

/// The joints that lock, and of the others those with the largest predicted steps: four in all, if there are as many.
fn strongest(truth: &Truth) -> Vec<usize> {
    let mut joints = truth.failed_joints.clone();
    if let Some(run) = truth.runs.first() {
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

fn both(name: String, figure: &impl Figure) -> anyhow::Result<Drawing> {
    Ok((name, figures::svg(figure)?, figures::png(figure)?))
}
