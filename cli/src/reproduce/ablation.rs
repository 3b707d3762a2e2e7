//! What a suppression is due to: other vector fields in the place of ∇w_D, and the optimum on one side of the lock alone.

use std::io::{self, Write};

use comfy_table::Table;
use serde::Serialize;
use ulna_study::experiment::{Ablation, AblationRow, Variant};
use ulna_study::search::{Acts, Field};

use super::words::significant;
use crate::columns::plain;
use crate::output::Files;
use crate::rows::file;

/// The table of all failure times, if there are any.
pub(super) fn write(ablations: &[Ablation], out: &mut dyn Write) -> io::Result<()> {
    let Some(first) = ablations.first() else {
        return Ok(());
    };
    writeln!(
        out,
        "\nwhat it is due to, {}: other fields than the gradient of w_D, and one side of the lock alone",
        first.section
    )?;
    let mut table = Table::new();
    table.set_header([
        "at",
        "law",
        "field or side",
        "norm left, N m",
        "worst ratio",
        "force error, N: at the lock",
        "at worst",
        "largest |U|, N m",
    ]);
    for (ablation, row) in rows(ablations) {
        let (law, what) = names(row.variant);
        let figures = match &row.outcome {
            Ok(found) => [
                significant(found.healthy_after),
                found
                    .worst_joint
                    .map_or_else(String::new, |(joint, ratio)| {
                        format!("{} (joint {})", significant(ratio), joint + 1)
                    }),
                significant(found.force_error),
                significant(found.max_force_error),
                significant(found.max_compensation),
            ],
            Err(error) => std::array::from_fn(|column| match column {
                0 => error.to_string(),
                _ => String::new(),
            }),
        };
        let time = format!("{} s", ablation.failure_time);
        table.add_row(
            [time, law.to_owned(), what.to_owned()]
                .into_iter()
                .chain(figures),
        );
    }
    writeln!(out, "{}", plain(table, &[1, 2]))
}

/// A failure time and a variant.
#[derive(Default, Serialize)]
struct Row<'s> {
    section: &'s str,
    failure_time: f64,
    law: &'static str,
    variant: &'static str,
    healthy_before: f64,
    healthy_after: Option<f64>,
    worst_joint: Option<usize>,
    worst_ratio: Option<f64>,
    force_error_at_lock: Option<f64>,
    max_force_error: Option<f64>,
    max_compensation: Option<f64>,
}

/// `ablation.csv`.
pub(super) fn add(files: &mut Files, ablations: &[Ablation]) -> anyhow::Result<()> {
    let rows = rows(ablations).map(|(ablation, row)| {
        let (law, variant) = names(row.variant);
        let found = row.outcome.as_ref().ok();
        let worst = found.and_then(|found| found.worst_joint);
        Row {
            section: &ablation.section,
            failure_time: ablation.failure_time,
            law,
            variant,
            healthy_before: ablation.healthy_before,
            healthy_after: found.map(|found| found.healthy_after),
            worst_joint: worst.map(|(joint, _)| joint + 1),
            worst_ratio: worst.map(|(_, ratio)| ratio),
            force_error_at_lock: found.map(|found| found.force_error),
            max_force_error: found.map(|found| found.max_force_error),
            max_compensation: found.map(|found| found.max_compensation),
        }
    });
    files.add("ablation.csv", file(rows)?);
    Ok(())
}

fn rows(ablations: &[Ablation]) -> impl Iterator<Item = (&Ablation, &AblationRow)> {
    ablations
        .iter()
        .flat_map(|ablation| ablation.rows.iter().map(move |row| (ablation, row)))
}

/// Law, and field or side of the lock.
fn names(variant: Variant) -> (&'static str, &'static str) {
    let field = |field| match field {
        Field::DynamicManipulability => "grad w_D",
        Field::KinematicManipulability => "grad w, kinematic",
        Field::Ones => "ones",
        Field::Random(_) => "random",
    };
    match variant {
        Variant::PerJoint(of) => ("Eq.16", field(of)),
        Variant::Projected(of) => ("Eq.20", field(of)),
        Variant::Optimal(acts) => (
            "optimal",
            match acts {
                Acts::Both => "before and after",
                Acts::Before => "before only",
                Acts::After => "after only",
            },
        ),
    }
}
