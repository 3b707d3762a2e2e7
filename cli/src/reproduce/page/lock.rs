//! What the simulated locks say, in sentences.

use std::fmt::{self, Write};

use ulna_study::Scenario;
use ulna_study::experiment::{SearchMethod, SimulatedLock, SimulatedRun};

use crate::reproduce::Findings;
use crate::reproduce::drawings::{CONVERGENCE, SIMULATED};
use crate::reproduce::words::{joints_named, seconds, significant};
use crate::setting::Setting;

/// The norms of a run's step over the healthy joints, one for each failure time.
fn steps(
    simulations: &[SimulatedLock],
    method: Option<SearchMethod>,
    step: fn(&SimulatedRun) -> &Vec<f64>,
) -> String {
    let norms = simulations.iter().filter_map(|simulated| {
        let run = simulated.runs.iter().find(|run| run.method == method)?;
        let joints = step(run).iter().enumerate();
        let healthy = joints.filter(|(joint, _)| !simulated.failed_joints.contains(joint));
        Some(significant(healthy.map(|(_, x)| x * x).sum::<f64>().sqrt()))
    });
    norms.collect::<Vec<_>>().join(", ")
}

/// The simulated locks.
pub(super) fn write(page: &mut String, scenario: &Scenario, findings: &Findings) -> fmt::Result {
    writeln!(page, "## The lock as it is\n")?;
    let simulations = match &findings.simulations {
        Ok(simulations) => simulations,
        Err(error) => return writeln!(page, "It could not be simulated: {error}.\n"),
    };
    let eq_16 = Some(SearchMethod::PerJoint);
    let has_run = |simulated: &SimulatedLock| simulated.runs.iter().any(|run| run.method == eq_16);
    let under_eq_16 = if simulations.iter().all(has_run) {
        let steps = steps(simulations, eq_16, |run| &run.torque_step);
        format!(" and of {steps} N·m under Eq. 16")
    } else {
        String::new()
    };
    let energy = simulations
        .iter()
        .flat_map(|simulated| &simulated.runs)
        .map(|run| run.energy_error);
    writeln!(
        page,
        "Eq. 1-12 and 18 have the healthy joints keep their plan through the lock. No brake brings that about: \
         what stops {} takes impulses from all joints. Here the arm is simulated under computed torque and the \
         compensation of each law, with {}, under the force of the first experiment; energy is balanced to {:.0e} of its size. \
         The step of the healthy joints' torques (norm) that is predicted without compensation is {} N·m at {} s; what they bear after the brake is a step of {} N·m without \
         compensation{}. A compensation also moves an arm whose tool nothing holds, and feedback, where there is some, works against it.\n",
        joints_named(scenario.failed_joints()),
        simulations
            .first()
            .map_or_else(String::new, |simulated| Setting::of(simulated).in_words()),
        energy.fold(0.0, f64::max),
        steps(simulations, None, |run| &run.predicted_step),
        simulations
            .iter()
            .map(|simulated| simulated.failure_time.to_string())
            .collect::<Vec<_>>()
            .join(", "),
        steps(simulations, None, |run| &run.torque_step),
        under_eq_16,
    )?;
    writeln!(
        page,
        "| lock, s | law | healthy joints: predicted step (norm), N·m | step after the brake (norm), N·m | largest torque of a healthy joint, N·m | of a locked one, N·m |\n\
         |---|---|---|---|---|---|"
    )?;
    for simulated in simulations {
        for run in &simulated.runs {
            let of = |torque: &[f64], locked: bool| {
                let joints = torque.iter().copied().enumerate();
                let chosen =
                    joints.filter(|(joint, _)| simulated.failed_joints.contains(joint) == locked);
                chosen.map(|(_, torque)| torque).collect::<Vec<_>>()
            };
            let norm = |torque: &[f64]| of(torque, false).iter().map(|x| x * x).sum::<f64>().sqrt();
            let largest = |locked| of(&run.peak_torque, locked).into_iter().fold(0.0, f64::max);
            writeln!(
                page,
                "| {} | `{}` | {} | {} | {} | {} |",
                simulated.failure_time,
                run.method.map_or("none", SearchMethod::name),
                significant(norm(&run.predicted_step)),
                significant(norm(&run.torque_step)),
                significant(largest(false)),
                significant(largest(true)),
            )?;
        }
    }
    if let Some(simulated) = simulations.get(simulations.len() / 2) {
        writeln!(
            page,
            "\nWith ever shorter brakes their impulse tends to that of the ideal lock, -q̇_k/((M + R)⁻¹)_kk for a single joint k, \
             and the difference shrinks at least in proportion to the brake's time. \
             A brake longer than the control cycle ({} s) also meets the feedback and what the plan asks for meanwhile. Lock at {} s:\n\n\
             | brake time, s | impulse, N·m·s | ideal lock | relative difference | peak torque of the brake, N·m |\n|---|---|---|---|---|",
            scenario.cycle(),
            simulated.failure_time
        )?;
        for point in &simulated.convergence {
            let listed = |impulses: &[f64]| {
                let texts: Vec<_> = impulses
                    .iter()
                    .map(|impulse| format!("{impulse:.6}"))
                    .collect();
                texts.join(", ")
            };
            writeln!(
                page,
                "| {} | {} | {} | {:.1e} | {} |",
                seconds(point.brake_time),
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
            "Torques around the lock: what the paper predicts, and what a simulated arm bears; dotted, when the brake falls and when it has done its work",
        ),
        (CONVERGENCE, "The impulse of ever shorter brakes"),
    ];
    writeln!(page)?;
    for (file, caption) in captions {
        writeln!(page, "![{caption}](figures/{file}.svg)\n\n*{caption}.*\n")?;
    }
    Ok(())
}
