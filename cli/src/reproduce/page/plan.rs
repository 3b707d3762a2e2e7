//! What the plan's own steps say, in sentences.

use std::fmt::{self, Write};

use ulna::ProfileShape;
use ulna_study::experiment::{PlanSteps, PlannedTorques, TorqueStep};

use crate::reproduce::plan_steps::{ROUNDING, word};
use crate::reproduce::words::significant;

/// The steps that the plan makes without any lock, beside the locks'.
pub(super) fn write(page: &mut String, found: &PlanSteps) -> fmt::Result {
    writeln!(page, "## The plan's own steps\n")?;
    let Some((own, torques)) = found.profiles.first().and_then(|own| {
        let torques = own.torques.as_ref().ok()?;
        Some((word(own.shape), torques))
    }) else {
        return Ok(());
    };
    match (torques.largest_of_plan(), torques.largest_of_locks()) {
        (Some(plan), Some(lock)) if plan.norm() > ROUNDING => writeln!(
            page,
            "A lock is not the only thing that makes a torque step. Where the acceleration of the planned motion jumps, the torques of healthy joints \
             step too: with the profile `{own}` by up to {} N·m (norm over all joints, at {} s), {} the largest step of a lock, {} N·m at {} s.\n",
            significant(plan.norm()),
            plan.time,
            times_as_much(plan.norm(), lock.norm()),
            significant(lock.norm()),
            lock.time,
        )?,
        (_, Some(lock)) => writeln!(
            page,
            "With the profile `{own}` the planned torques are continuous: only the lock makes a step, of up to {} N·m (norm over all joints, at {} s).\n",
            significant(lock.norm()),
            lock.time,
        )?,
        _ => {}
    }
    writeln!(
        page,
        "The same motion in the same time with other profiles (norms over all joints; `plan_steps.csv` has each joint):\n\n\
         | profile | largest step of the plan, N·m | steepest slope between its phases, N·m/s | steps of the locks, N·m |\n|---|---|---|---|"
    )?;
    for profile in &found.profiles {
        match &profile.torques {
            Ok(torques) => row(page, word(profile.shape), torques)?,
            Err(error) => writeln!(page, "| `{}` | {error} | | |", word(profile.shape))?,
        }
    }
    writeln!(page)?;
    let others = found.profiles.iter().skip(1);
    let smooth: Vec<_> = others
        .filter_map(|profile| {
            let torques = profile.torques.as_ref().ok()?;
            let step = torques.largest_of_plan().map_or(0.0, TorqueStep::norm);
            (step <= ROUNDING).then_some((profile.shape, torques))
        })
        .collect();
    let slope = torques.steepest_norm;
    let own_step = torques.largest_of_plan().map_or(0.0, TorqueStep::norm);
    if own_step > ROUNDING && !smooth.is_empty() {
        let named: Vec<_> = smooth
            .iter()
            .map(|(shape, torques)| {
                format!(
                    "`{}` {} N·m/s instead of {}",
                    word(*shape),
                    significant(torques.steepest_norm),
                    significant(slope)
                )
            })
            .collect();
        writeln!(
            page,
            "A profile whose acceleration is continuous takes the plan's steps away, for steeper slopes within the blends: {}. \
             The locks' steps stay, since the failed joints have rates and accelerations to lose with any profile: {}.\n",
            named.join(", "),
            locks_beside(torques, &smooth),
        )?;
    }
    Ok(())
}

/// For each failure time the step with the scenario's own profile, and with the others.
fn locks_beside(own: &PlannedTorques, others: &[(ProfileShape, &PlannedTorques)]) -> String {
    let locks = own.locks.iter().enumerate().map(|(i, lock)| {
        let others = others.iter().map(|(shape, torques)| {
            let step = significant(torques.locks[i].norm());
            format!("{step} with `{}`", word(*shape))
        });
        let others: Vec<_> = others.collect();
        let step = significant(lock.norm());
        format!(
            "at {} s {step} N·m becomes {}",
            lock.time,
            others.join(" and ")
        )
    });
    locks.collect::<Vec<_>>().join("; ")
}

fn row(page: &mut String, name: &str, torques: &PlannedTorques) -> fmt::Result {
    let step = match torques.largest_of_plan() {
        Some(step) if step.norm() > ROUNDING => {
            format!("{} at {} s", significant(step.norm()), step.time)
        }
        _ => "none".to_owned(),
    };
    let locks: Vec<_> = torques
        .locks
        .iter()
        .map(|step| format!("{} at {} s", significant(step.norm()), step.time))
        .collect();
    writeln!(
        page,
        "| `{name}` | {step} | {} at {:.2} s | {} |",
        significant(torques.steepest_norm),
        torques.steepest_time,
        locks.join(", "),
    )
}

/// "5.2 times" or, below 1, "0.40 times".
fn times_as_much(plan: f64, lock: f64) -> String {
    if lock > ROUNDING {
        format!("{:.1} times", plan / lock)
    } else {
        "beyond".to_owned()
    }
}
