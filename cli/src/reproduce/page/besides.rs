//! What the simulated locks say besides: of the brake's time, and of the tool.

use std::fmt::{self, Write};

use ulna_study::experiment::Truth;

use crate::reproduce::verdict::{METHODS, law};
use crate::reproduce::words::significant;

/// The paragraphs.
pub(super) fn write(page: &mut String, truths: &[Truth]) -> fmt::Result {
    while_braking(page, truths)?;
    moved_tool(page, truths)?;
    unfinished(page, truths)
}

/// What Eq. 1-12 leave out while the brake acts.
fn while_braking(page: &mut String, truths: &[Truth]) -> fmt::Result {
    let locks = truths.iter().filter_map(|truth| {
        let norm = |torque: &[f64]| {
            let joints = torque.iter().enumerate();
            let healthy = joints.filter(|(joint, _)| !truth.failed_joints.contains(joint));
            healthy
                .map(|(_, torque)| torque * torque)
                .sum::<f64>()
                .sqrt()
        };
        let without = truth.runs.iter().find(|run| run.method.is_none())?;
        Some(format!(
            "{} beside {} N·m at {} s",
            significant(norm(&truth.braking_step)),
            significant(norm(&without.predicted_step)),
            truth.failure_time
        ))
    });
    let locks: Vec<_> = locks.collect();
    let Some(truth) = truths.first().filter(|_| !locks.is_empty()) else {
        return Ok(());
    };
    writeln!(
        page,
        "**While the brake acts.** Eq. 1-12 stop the joint's acceleration, -q̈_k, and not its rate. A brake of {} s takes -q̇_k/T besides, on the mean. \
         If the healthy joints kept their rates, that alone would change their torques by (norm, beside the step predicted without compensation): {}.\n",
        truth.brake_time,
        locks.join("; "),
    )
}

/// What a compensation does to the tool.
fn moved_tool(page: &mut String, truths: &[Truth]) -> fmt::Result {
    let rows = METHODS.iter().filter_map(|(method, title)| {
        let accelerations: Vec<_> = truths
            .iter()
            .filter_map(|truth| {
                let run = truth.runs.iter().find(|run| run.method == Some(*method))?;
                Some(format!(
                    "{} at {} s",
                    significant(run.tool_acceleration),
                    truth.failure_time
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
fn unfinished(page: &mut String, truths: &[Truth]) -> fmt::Result {
    for truth in truths {
        for (method, ending) in &truth.unfinished {
            writeln!(
                page,
                "The lock at {} s could not be simulated with {}: {ending}.\n",
                truth.failure_time,
                law(*method)
            )?;
        }
    }
    Ok(())
}
