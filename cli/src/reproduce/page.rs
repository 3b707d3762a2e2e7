//! `README.md`: what was found, in words, with the numbers of this run in them.

use std::fmt::{self, Write};

use ulna::Scenario;
use ulna::experiment::{Case, Method, Study, Truth, TruthRun};
use ulna::scenario::{Experiment, FigureKind};

use super::Findings;
use super::drawings::{CONVERGENCE, SIMULATED, frontier_name};
use super::results::{name, status};
use super::table::{failed_joints, reference_at, significant};

/// An impact below this share of the largest joint's is left out of sentences about every joint.
const NEGLIGIBLE: f64 = 1e-4;

/// The page.
pub(super) fn write(scenario: &Scenario, findings: &Findings) -> Result<String, fmt::Error> {
    let mut page = String::new();
    let description = match scenario.description.as_str() {
        "" => String::new(),
        description => format!(" Its motion is {description}."),
    };
    writeln!(
        page,
        "# {}\n\nArm `{}`, joint {} locks.{description}\n\n\
         Impact torque is the step of a joint's torque at the lock while the healthy joints keep to their plan (Eq. 18). \
         Forces are static: what the torques hold at the tool (Eq. 13).\n",
        scenario.name,
        scenario.arm.name(),
        failed_joints(scenario),
    )?;
    for experiment in &scenario.experiments {
        let studies = findings.of_section(experiment);
        writeln!(page, "## {} {}\n", experiment.section, experiment.title)?;
        if experiment.section == scenario.experiments[0].section {
            suppression_against_force(&mut page, &studies)?;
            price_of_suppression(&mut page, &studies)?;
            search_in_steps(&mut page, scenario, &studies)?;
        }
        limits(&mut page, &studies)?;
        beside_references(&mut page, experiment, &studies)?;
        summary(&mut page, &studies)?;
        figures(&mut page, experiment)?;
    }
    truth(&mut page, scenario, findings)?;
    files(&mut page)?;
    Ok(page)
}

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
                significant(case.flight.max_force_error),
                status(case),
            )?;
        }
    }
    writeln!(page)
}

/// The joints of which a sentence about every joint speaks.
fn notable(case: &Case) -> impl Iterator<Item = usize> + '_ {
    let largest = case.impact_before.iter().copied().fold(0.0, f64::max);
    let joints = case.impact_before.iter().enumerate();
    joints
        .filter(move |(_, before)| **before > NEGLIGIBLE * largest)
        .map(|(joint, _)| joint)
}

fn suppression_against_force(page: &mut String, studies: &[&Study]) -> fmt::Result {
    let least = |study: &Study| {
        let case = study.case(Method::PerJoint);
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
        let (before, left) = study.case(Method::Optimal).healthy_impact();
        left > 0.05 * before
    });
    let headline = if apart {
        "**Suppression by 95 % and an untouched tool force do not hold together.**"
    } else {
        "**Here the impact can be suppressed by 95 % with the tool force untouched.**"
    };
    let kept = studies
        .iter()
        .map(|study| study.case(Method::Projected).flight.max_force_error);
    let of = |method: Method, value: fn(&Case) -> f64| {
        at_each(studies, |study| value(study.case(method)))
    };
    let before: fn(&Case) -> f64 = |case| case.healthy_impact().0;
    let after: fn(&Case) -> f64 = |case| case.healthy_impact().1;
    let error: fn(&Case) -> f64 = |case| case.force_error;
    let worst: fn(&Case) -> f64 = |case| case.flight.max_force_error;
    writeln!(
        page,
        "{} For locks at {} s, in this order:\n\n\
         - Eq. 16 takes at least {} % off the impact of every joint that has one to speak of, and bends the tool force \
         by {} N at the lock, and by up to {} N elsewhere in the motion: its coefficients are made for one pose and act in all.\n\
         - Eq. 20 keeps the tool force (to within {:.0e} N over the whole motion) and leaves {} of {} N·m over the healthy joints.\n\
         - No compensation that keeps the force before and after the lock can leave less than {} N·m (the law `optimal`).\n\n\
         The paper argues with Eq. 20, whose force is exact, and reports the suppression of Eq. 16.\n",
        headline,
        times(studies),
        least.join(", "),
        of(Method::PerJoint, error),
        of(Method::PerJoint, worst),
        kept.fold(0.0, f64::max),
        of(Method::Projected, after),
        of(Method::Projected, before),
        of(Method::Optimal, after),
    )
}

/// What the frontier says: how little force the impact costs.
fn price_of_suppression(page: &mut String, studies: &[&Study]) -> fmt::Result {
    let ends: Vec<_> = studies
        .iter()
        .filter_map(|study| {
            let (force, impact) = study.tradeoff.as_ref()?.frontier.last()?;
            let spent = study.case(Method::PerJoint).force_error;
            Some(format!(
                "{} N leave {} N·m at {} s (Eq. 16 spends {} N)",
                significant(*force),
                significant(*impact),
                study.failure_time,
                significant(spent)
            ))
        })
        .collect();
    if ends.is_empty() {
        return Ok(());
    }
    writeln!(
        page,
        "**How the two trade off.** With free null-space torques in place of k_d ∇w_D a little force error at the lock buys the whole suppression: {}. \
         The frontier between is drawn below.\n",
        ends.join("; ")
    )
}

/// Where the grid is too coarse.
fn search_in_steps(page: &mut String, scenario: &Scenario, studies: &[&Study]) -> fmt::Result {
    let mut coarse = Vec::new();
    for study in studies {
        let (steps, exact) = (
            study.case(Method::StepwisePerJoint),
            study.case(Method::PerJoint),
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
    writeln!(
        page,
        "**The search in steps.** A grid of step {:.0e} leaves up to half a step of k_d. That is more than 5 % of the impact where the exact \
         coefficient is only a few steps long: {}. The exact search has no such limit and takes no longer (`search.csv`).\n",
        scenario.search.step,
        coarse.join("; ")
    )
}

/// What is left of the impact, here and in the references.
fn beside_references(
    page: &mut String,
    experiment: &Experiment,
    studies: &[&Study],
) -> fmt::Result {
    for study in studies {
        let Some(reference) = reference_at(experiment, study.failure_time) else {
            continue;
        };
        let case = study.case(Method::StepwisePerJoint);
        let pairs = reference.before.iter().zip(&reference.after);
        let left: Vec<_> = pairs
            .enumerate()
            .filter_map(|(joint, pair)| match pair {
                (Some(before), Some(after)) if *before > 0.0 => Some(format!(
                    "joint {}: {:.1} % there, {:.1} % here",
                    joint + 1,
                    100.0 * after / before,
                    100.0 - case.suppression_percent()[joint]
                )),
                _ => None,
            })
            .collect();
        if !left.is_empty() {
            writeln!(
                page,
                "Left of the impact after the search in steps at {} s, beside {}: {}.\n",
                study.failure_time,
                reference.source,
                left.join("; ")
            )?;
        }
    }
    Ok(())
}

/// Which rated torques bind.
fn limits(page: &mut String, studies: &[&Study]) -> fmt::Result {
    for study in studies {
        let case = study.case(Method::PerJoint);
        let Some(rated) = &case.rated_torque else {
            continue;
        };
        let bound = |torque: &[f64]| {
            let joints = torque.iter().zip(rated).enumerate();
            let at_limit = joints.filter(|(_, (torque, rated))| **torque >= **rated * (1.0 - 1e-6));
            let names: Vec<_> = at_limit.map(|(joint, _)| (joint + 1).to_string()).collect();
            if names.is_empty() {
                "no joint".to_owned()
            } else if names.len() == 1 {
                format!("joint {}", names[0])
            } else {
                format!("joints {}", names.join(", "))
            }
        };
        let rows = &case.flight.series.planned;
        let plan = (0..rated.len())
            .map(|joint| rows.iter().map(|row| row[joint].abs()).fold(0.0, f64::max));
        let plan: Vec<_> = plan.map(significant).collect();
        writeln!(
            page,
            "Rated torques at {} s: under Eq. 16 they bind at {}, and none is exceeded. \
             The plan alone needs {} N·m of joints 1 to {}.\n",
            study.failure_time,
            bound(&case.flight.max_torque),
            plan.join(", "),
            rated.len()
        )?;
    }
    Ok(())
}

fn figures(page: &mut String, experiment: &Experiment) -> fmt::Result {
    for figure in &experiment.figures {
        let caption = match &figure.kind {
            FigureKind::Torque { time, .. } => {
                format!(
                    "Torques with the lock at {time} s, without and with suppression; on the right the half second before and after it"
                )
            }
            FigureKind::Impact => "Impact torque joint by joint; bars end at 0.001 N·m".to_owned(),
        };
        writeln!(
            page,
            "![{caption}](figures/{}.svg)\n\n*{caption}.*\n",
            figure.name
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

/// The norms of a run's step over the healthy joints, one for each failure time.
fn steps(truths: &[Truth], method: Option<Method>, step: fn(&TruthRun) -> &Vec<f64>) -> String {
    let norms = truths.iter().filter_map(|truth| {
        let run = truth.runs.iter().find(|run| run.method == method)?;
        let joints = step(run).iter().enumerate();
        let healthy = joints.filter(|(joint, _)| !truth.failed_joints.contains(joint));
        Some(significant(healthy.map(|(_, x)| x * x).sum::<f64>().sqrt()))
    });
    norms.collect::<Vec<_>>().join(", ")
}

/// The simulated locks.
fn truth(page: &mut String, scenario: &Scenario, findings: &Findings) -> fmt::Result {
    writeln!(page, "## The lock as it is\n")?;
    let truths = match &findings.truths {
        Ok(truths) => truths,
        Err(error) => return writeln!(page, "It could not be simulated: {error}.\n"),
    };
    let energy = truths
        .iter()
        .flat_map(|truth| &truth.runs)
        .map(|run| run.energy_error);
    writeln!(
        page,
        "Eq. 1-12 and 18 have the healthy joints keep their plan through the lock. No real brake and no motor brings that about: \
         what stops joint {} takes impulses from all joints. Here the arm is simulated, with a brake that takes {} s, computed torque, feedback and the \
         compensation of each law, under the force of the first experiment; energy is balanced to {:.0e} of its size. \
         The step of the healthy joints' torques (norm) that is predicted without compensation is {} N·m at {} s; what they bear after the brake is a step of {} N·m without \
         compensation and of {} N·m under Eq. 16. A compensation that bends the tool force also moves an arm whose tool nothing holds, and the feedback works against it.\n",
        failed_joints(scenario),
        scenario.brake.duration,
        energy.fold(0.0, f64::max),
        steps(truths, None, |run| &run.predicted_step),
        truths
            .iter()
            .map(|truth| truth.failure_time.to_string())
            .collect::<Vec<_>>()
            .join(", "),
        steps(truths, None, |run| &run.torque_step),
        steps(truths, Some(Method::PerJoint), |run| &run.torque_step),
    )?;
    writeln!(
        page,
        "| lock, s | law | healthy joints: predicted step (norm), N·m | step after the brake (norm), N·m | largest torque of a healthy joint, N·m | of a locked one, N·m |\n\
         |---|---|---|---|---|---|"
    )?;
    for truth in truths {
        for run in &truth.runs {
            let of = |torque: &[f64], locked: bool| {
                let joints = torque.iter().copied().enumerate();
                let chosen =
                    joints.filter(|(joint, _)| truth.failed_joints.contains(joint) == locked);
                chosen.map(|(_, torque)| torque).collect::<Vec<_>>()
            };
            let norm = |torque: &[f64]| of(torque, false).iter().map(|x| x * x).sum::<f64>().sqrt();
            let largest = |locked| of(&run.peak_torque, locked).into_iter().fold(0.0, f64::max);
            writeln!(
                page,
                "| {} | `{}` | {} | {} | {} | {} |",
                truth.failure_time,
                run.method.map_or("none", name),
                significant(norm(&run.predicted_step)),
                significant(norm(&run.torque_step)),
                significant(largest(false)),
                significant(largest(true)),
            )?;
        }
    }
    if let Some(truth) = truths.get(truths.len() / 2) {
        writeln!(
            page,
            "\nWith ever shorter brakes their impulse tends to that of the ideal lock, -q̇_k/(M⁻¹)_kk for a single joint k; at {} s:\n\n\
             | brake time, s | impulse, N·m·s | ideal lock | relative difference | peak torque of the brake, N·m |\n|---|---|---|---|---|",
            truth.failure_time
        )?;
        for point in &truth.convergence {
            let listed = |impulses: &[f64]| {
                let texts: Vec<_> = impulses
                    .iter()
                    .map(|impulse| format!("{impulse:.6}"))
                    .collect();
                texts.join(", ")
            };
            writeln!(
                page,
                "| {:e} | {} | {} | {:.1e} | {} |",
                point.brake_time,
                listed(&point.impulse),
                listed(&point.ideal),
                point.relative_difference,
                significant(point.peak_brake_torque),
            )?;
        }
    }
    let captions = [
        (
            SIMULATED,
            "Torques around the lock: what the paper predicts, and what a simulated arm bears",
        ),
        (CONVERGENCE, "The impulse of ever shorter brakes"),
    ];
    writeln!(page)?;
    for (file, caption) in captions {
        writeln!(page, "![{caption}](figures/{file}.svg)\n\n*{caption}.*\n")?;
    }
    Ok(())
}

fn files(page: &mut String) -> fmt::Result {
    writeln!(
        page,
        "## Files\n\n\
         - `results.json`: every case with its exact search. The law `optimal` has no coefficients; zeros stand for them. \
         `max_force_error` and `max_torque` are over all control cycles.\n\
         - `impact.csv`: a row for each case and joint, the search in steps among them.\n\
         - `search.csv`: the searches side by side: how they ended, gap, iterations, seconds, quality.\n\
         - `frontier.csv`: the points of the frontiers.\n\
         - `truth.csv`, `convergence.csv`: the simulated locks.\n\
         - `series/`: torques and forces over time.\n\
         - `figures/`: SVG, and PNG of the same."
    )
}
