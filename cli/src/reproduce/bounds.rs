//! What cuts each coefficient of Eq. 16 (Eq. 28): console table.

use std::io::{self, Write};

use comfy_table::Table;
use ulna_study::experiment::{SearchMethod, Study};

use super::limited::side;
use crate::columns::plain;

/// A row for each coefficient that a rated torque cuts; nothing if the experiment has none.
pub(super) fn write(studies: &[&Study], out: &mut dyn Write) -> io::Result<()> {
    let cases = || {
        studies
            .iter()
            .map(|study| study.case(SearchMethod::PerJoint))
    };
    if cases().all(|case| case.rated_torque.is_none()) {
        return Ok(());
    }
    let mut table = Table::new();
    table.set_header([
        "at",
        "joint",
        "wanted",
        "allowed",
        "side",
        "bound at",
        "left of it",
    ]);
    let mut free = Vec::new();
    for case in cases().filter(|case| case.search.is_ok()) {
        let bounds = case.bounds.iter().enumerate();
        let cut: Vec<_> = bounds
            .filter_map(|(joint, bound)| Some((joint, bound.as_ref()?)))
            .collect();
        if cut.is_empty() {
            free.push(format!("{} s", case.failure_time));
        }
        for (joint, bound) in cut {
            table.add_row([
                format!("{} s", case.failure_time),
                (joint + 1).to_string(),
                format!("{:.3e}", bound.wanted),
                format!("{:.3e}", bound.limit),
                side(bound.side).to_owned(),
                format!("{:.2} s", bound.time),
                format!("{:.1} %", 100.0 * bound.limit / bound.wanted),
            ]);
        }
    }
    if table.row_count() > 0 {
        writeln!(out, "\ncoefficients of Eq. 16 that rated torques cut")?;
        writeln!(out, "{}", plain(table, &[4]))?;
    }
    if !free.is_empty() {
        writeln!(
            out,
            "\nno coefficient of Eq. 16 is cut with the lock at {}",
            free.join(", ")
        )?;
    }
    Ok(())
}
