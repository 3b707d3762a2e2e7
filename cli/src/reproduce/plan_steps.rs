//! The steps that the planned torque makes by itself, beside those of a lock: console table and CSV.

use std::io::{self, Write};

use comfy_table::Table;
use serde::Serialize;
use ulna::ProfileShape;
use ulna_study::experiment::{PlanSteps, PlannedTorques, TorqueStep};

use super::words::significant;
use crate::columns::plain;
use crate::rows::file;

/// What a profile is called in a scenario.
pub(super) fn word(shape: ProfileShape) -> &'static str {
    match shape {
        ProfileShape::Trapezoid => "trapezoid",
        ProfileShape::Quintic => "quintic",
        ProfileShape::SCurve { .. } => "s_curve",
    }
}

/// A row for each profile, and for the scenario's own a row for each joint.
pub(super) fn write(found: &PlanSteps, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "\nsteps of the planned torque, norm over all joints in N m, and its steepest slope in N m/s"
    )?;
    writeln!(out, "{}", profiles(found))?;
    for profile in &found.profiles {
        if let Err(error) = &profile.torques {
            writeln!(out, " {}: {error}", word(profile.shape))?;
        }
    }
    if let Some(own) = found.profiles.first()
        && let Ok(torques) = &own.torques
    {
        writeln!(
            out,
            "\nthe same joint by joint, {}: the largest |step| of the plan, and |step| of each lock",
            word(own.shape)
        )?;
        writeln!(out, "{}", joints(torques))?;
    }
    Ok(())
}

fn profiles(found: &PlanSteps) -> String {
    let mut table = Table::new();
    let executed = || {
        let profiles = found.profiles.iter();
        profiles.filter_map(|profile| Some((profile.shape, profile.torques.as_ref().ok()?)))
    };
    let locks = executed().next().map(|(_, torques)| lock_titles(torques));
    let titles = ["profile", "plan's largest", "at", "steepest", "at"].map(str::to_owned);
    table.set_header(titles.into_iter().chain(locks.unwrap_or_default()));
    for (shape, torques) in executed() {
        let (step, at) = match torques.largest_of_plan() {
            Some(step) if step.norm() > ROUNDING => {
                (significant(step.norm()), format!("{} s", step.time))
            }
            _ => (significant(0.0), String::new()),
        };
        let cells = [
            word(shape).to_owned(),
            step,
            at,
            significant(torques.steepest_norm),
            format!("{:.2} s", torques.steepest_time),
        ];
        let locks = torques.locks.iter().map(|step| significant(step.norm()));
        table.add_row(cells.into_iter().chain(locks));
    }
    plain(table, &[0])
}

/// Below it a step is rounding, N m.
pub(super) const ROUNDING: f64 = 1e-9;

fn lock_titles(torques: &PlannedTorques) -> Vec<String> {
    let locks = torques.locks.iter();
    locks
        .map(|step| format!("lock at {} s", step.time))
        .collect()
}

fn joints(torques: &PlannedTorques) -> String {
    let mut table = Table::new();
    let titles = ["joint", "plan's largest", "at", "steepest"].map(str::to_owned);
    table.set_header(titles.into_iter().chain(lock_titles(torques)));
    for (joint, steepest) in torques.steepest.iter().enumerate() {
        let size = |step: &TorqueStep| step.step[joint].abs();
        let ends = torques.phase_ends.iter();
        let largest = ends.max_by(|a, b| size(a).total_cmp(&size(b)));
        let (step, at) = match largest {
            Some(step) if size(step) > ROUNDING => {
                (significant(size(step)), format!("{} s", step.time))
            }
            _ => (significant(0.0), String::new()),
        };
        let cells = [(joint + 1).to_string(), step, at, significant(*steepest)];
        let locks = torques.locks.iter().map(|step| significant(size(step)));
        table.add_row(cells.into_iter().chain(locks));
    }
    plain(table, &[])
}

/// A step and a joint, after minus before; or, for `steepest_slope`, the largest |dτ/dt| of a joint.
#[derive(Default, Serialize)]
struct Row {
    profile: &'static str,
    /// `phase_end`, `lock` or `steepest_slope`.
    event: &'static str,
    /// Empty for a slope: each joint has its own.
    time: Option<f64>,
    joint: usize,
    torque_step: Option<f64>,
    torque_rate: Option<f64>,
}

pub(super) fn csv(found: &PlanSteps) -> anyhow::Result<String> {
    let mut rows = Vec::new();
    for profile in &found.profiles {
        let Ok(torques) = &profile.torques else {
            continue;
        };
        let row = Row {
            profile: word(profile.shape),
            ..Row::default()
        };
        for (event, steps) in [("phase_end", &torques.phase_ends), ("lock", &torques.locks)] {
            for step in steps {
                rows.extend(step.step.iter().enumerate().map(|(joint, torque)| Row {
                    event,
                    time: Some(step.time),
                    joint: joint + 1,
                    torque_step: Some(*torque),
                    ..row
                }));
            }
        }
        rows.extend(
            torques
                .steepest
                .iter()
                .enumerate()
                .map(|(joint, rate)| Row {
                    event: "steepest_slope",
                    joint: joint + 1,
                    torque_rate: Some(*rate),
                    ..row
                }),
        );
    }
    file(rows)
}
