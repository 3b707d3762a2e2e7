//! What rated torques cost, Table 3 of the paper: console table and CSV.

use std::io::{self, Write};

use comfy_table::Table;
use serde::Serialize;
use ulna_study::experiment::{BoundSide, LimitedJoint, LimitedSuppression};
use ulna_study::scenario::{Experiment, Reference, Scenario};

use super::references::reference_at;
use super::words::{joints_named, significant};
use crate::columns::plain;
use crate::rows::file;

/// A table for each failure time at which the rated torques cut something, or of which a reference has figures.
pub(super) fn write(
    scenario: &Scenario,
    experiment: &Experiment,
    found: &[LimitedSuppression],
    out: &mut dyn Write,
) -> io::Result<()> {
    let section = experiment.section();
    for found in found.iter().filter(|found| found.section == section) {
        let reference = reference_at(scenario, experiment, found.failure_time);
        let reference = reference.filter(|reference| has_figures(reference));
        if reference.is_none() && found.joints.iter().all(|joint| joint.bound.is_none()) {
            continue;
        }
        let beside = reference.map_or_else(String::new, |reference| {
            format!("; below: {}", reference.source())
        });
        writeln!(
            out,
            "\nwhat the rated torques cost at {} s: Eq. 16 without and with them{beside}",
            found.failure_time
        )?;
        writeln!(out, "{}", joints(found, reference))?;
        if let Some(reference) = reference
            && let Some(room) = reference.mean_room()
        {
            let joints = reference.before().iter().zip(&found.joints).enumerate();
            let there = joints.filter_map(|(joint, (before, room))| before.map(|_| (joint, room)));
            let (joints, there): (Vec<_>, Vec<_>) = there.unzip();
            let mean = |of: fn(&LimitedJoint) -> f64| {
                let sum: f64 = there.iter().copied().map(of).sum();
                significant(sum / there.len() as f64)
            };
            writeln!(
                out,
                " mean tau^e of {}: {} N m, of {} N m rated; there {}",
                joints_named(&joints),
                mean(|joint| joint.mean_room),
                mean(|joint| joint.rated_torque),
                significant(room)
            )?;
        }
    }
    Ok(())
}

fn has_figures(reference: &Reference) -> bool {
    let lists = [reference.free_after(), reference.decrease()];
    lists.iter().any(|list| list.iter().any(Option::is_some))
}

fn joints(found: &LimitedSuppression, reference: Option<&Reference>) -> String {
    let mut table = Table::new();
    table.set_header([
        "joint",
        "rated",
        "mean tau^e",
        "before",
        "free",
        "suppressed",
        "limited",
        "suppressed",
        "max |U| less by",
    ]);
    let percent = |value: f64| {
        let text = format!("{value:.2} %");
        if text == "-0.00 %" {
            "0.00 %".to_owned()
        } else {
            text
        }
    };
    for (i, joint) in found.joints.iter().enumerate() {
        table.add_row([
            (i + 1).to_string(),
            significant(joint.rated_torque),
            significant(joint.mean_room),
            significant(joint.impact_before),
            significant(joint.impact_free),
            percent(joint.free_percent()),
            significant(joint.impact_limited),
            percent(joint.limited_percent()),
            percent(joint.compensation_decrease_percent()),
        ]);
        let Some(reference) = reference else {
            continue;
        };
        let figure = |list: &[Option<f64>]| list[i];
        let (before, free, limited) = (
            figure(reference.before()),
            figure(reference.free_after()),
            figure(reference.after()),
        );
        if before.is_none() {
            continue;
        }
        let of = |value: Option<f64>| value.map_or_else(String::new, significant);
        let suppressed = |after: Option<f64>| {
            let pair = before.zip(after);
            pair.map_or_else(String::new, |(before, after)| {
                percent(100.0 * (1.0 - after / before))
            })
        };
        table.add_row([
            "there".to_owned(),
            String::new(),
            String::new(),
            of(before),
            of(free),
            suppressed(free),
            of(limited),
            suppressed(limited),
            figure(reference.decrease()).map_or_else(String::new, percent),
        ]);
    }
    plain(table, &[])
}

/// A failure time and a joint.
#[derive(Default, Serialize)]
struct Row<'s> {
    section: &'s str,
    failure_time: f64,
    joint: usize,
    rated_torque: f64,
    mean_room: f64,
    impact_before: f64,
    impact_free: f64,
    suppression_free_percent: f64,
    impact_limited: f64,
    suppression_limited_percent: f64,
    compensation_free: f64,
    compensation_limited: f64,
    compensation_decrease_percent: f64,
    /// The other columns of a bound are empty where nothing cuts the coefficient.
    bound_side: Option<&'static str>,
    bound_time: Option<f64>,
    coefficient_wanted: Option<f64>,
    coefficient_limit: Option<f64>,
}

pub(super) fn csv(found: &[LimitedSuppression]) -> anyhow::Result<String> {
    file(found.iter().flat_map(|found| {
        let joints = found.joints.iter().enumerate();
        joints.map(|(i, joint)| Row {
            section: &found.section,
            failure_time: found.failure_time,
            joint: i + 1,
            rated_torque: joint.rated_torque,
            mean_room: joint.mean_room,
            impact_before: joint.impact_before,
            impact_free: joint.impact_free,
            suppression_free_percent: joint.free_percent(),
            impact_limited: joint.impact_limited,
            suppression_limited_percent: joint.limited_percent(),
            compensation_free: joint.compensation_free,
            compensation_limited: joint.compensation_limited,
            compensation_decrease_percent: joint.compensation_decrease_percent(),
            bound_side: joint.bound.map(|bound| side(bound.side)),
            bound_time: joint.bound.map(|bound| bound.time),
            coefficient_wanted: joint.bound.map(|bound| bound.wanted),
            coefficient_limit: joint.bound.map(|bound| bound.limit),
        })
    }))
}

/// An end of Eq. 28's interval.
pub(super) fn side(side: BoundSide) -> &'static str {
    match side {
        BoundSide::Lower => "lower",
        BoundSide::Upper => "upper",
    }
}
