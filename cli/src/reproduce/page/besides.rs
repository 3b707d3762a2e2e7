//! What the simulated locks say besides: of the brake's time, and of the tool.

use std::fmt::{self, Write};

use ulna_study::experiment::SimulatedLock;

use crate::reproduce::verdict::{METHODS, law};
use crate::reproduce::words::significant;

/// The paragraphs.
pub(super) fn write(page: &mut String, simulations: &[SimulatedLock]) -> fmt::Result {
    while_braking(page, simulations)?;
    moved_tool(page, simulations)?;
    unfinished(page, simulations)
}

/// What Eq. 1-12 leave out while the brake acts.
fn while_braking(page: &mut String, simulations: &[SimulatedLock]) -> fmt::Result {
    let locks = simulations.iter().filter_map(|simulated| {
        let norm = |torque: &[f64]| {
            let joints = torque.iter().enumerate();
            let healthy = joints.filter(|(joint, _)| !simulated.failed_joints.contains(joint));
            healthy
                .map(|(_, torque)| torque * torque)
                .sum::<f64>()
                .sqrt()
        };
        let without = simulated.runs.iter().find(|run| run.method.is_none())?;
        Some(format!(
            "{} beside {} N·m at {} s",
            significant(norm(&simulated.braking_step)),
            significant(norm(&without.predicted_step)),
            simulated.failure_time
        ))
    });
    let locks: Vec<_> = locks.collect();
    let Some(simulated) = simulations.first().filter(|_| !locks.is_empty()) else {
        return Ok(());
    };
    writeln!(
        page,
        "**While the brake acts.** Eq. 1-12 stop the joint's acceleration, -q̈_k, and not its rate. A brake of {} s takes -q̇_k/T besides, on the mean. \
         If the healthy joints kept their rates, that alone would change their torques by (norm, beside the step predicted without compensation): {}.\n",
        simulated.brake_time,
        locks.join("; "),
    )
}

/// What a compensation does to the tool.
fn moved_tool(page: &mut String, simulations: &[SimulatedLock]) -> fmt::Result {
    let rows = METHODS.iter().filter_map(|(method, title)| {
        let accelerations: Vec<_> = simulations
            .iter()
            .filter_map(|simulated| {
                let run = simulated
                    .runs
                    .iter()
                    .find(|run| run.method == Some(*method))?;
                Some(format!(
                    "{} at {} s",
                    significant(run.tool_acceleration),
                    simulated.failure_time
                ))
            })
            .collect();
        (!accelerations.is_empty()).then(|| format!("{title}: {}", accelerations.join(", ")))
    });
    let rows: Vec<_> = rows.collect();
    if rows.is_empty() {
        return Ok(());
    }
    writeln!(
        page,
        "**The tool.** Eq. 13 is about an arm at rest. What the compensations that were found add to the acceleration of a tool that nothing holds, \
         |J (M + R)⁻¹ U| just before or just after the lock, the larger (m/s², with the rad/s² of rotations that are of the task): {}.\n",
        rows.join("; ")
    )
}

/// The simulations that did not come to their end.
fn unfinished(page: &mut String, simulations: &[SimulatedLock]) -> fmt::Result {
    for simulated in simulations {
        for (method, ending) in &simulated.unfinished {
            writeln!(
                page,
                "The lock at {} s could not be simulated with {}: {ending}.\n",
                simulated.failure_time,
                law(*method)
            )?;
        }
    }
    Ok(())
}
