//! What `ulna assess` prints: a line for each law.

use std::io::{self, Write};

use comfy_table::Table;
use ulna_study::assess::{Law, LawAssessment, Statistics, Tuning};

use super::Findings;
use crate::columns::plain;
use crate::numbers::significant;
use crate::reproduce::words::joints_named;
use crate::setting::besides_servo;

/// What a law is called where people read.
pub(crate) fn title(law: &LawAssessment) -> String {
    name(law.law, law.force_budget)
}

pub(super) fn name(law: Law, force_budget: Option<f64>) -> String {
    let title = law.title();
    match force_budget {
        Some(budget) => format!("{title}, {budget} N"),
        None => title.to_owned(),
    }
}

/// "joint 2 at 10 s".
pub(super) fn failure(tuning: &Tuning) -> String {
    format!("{} at {} s", joints_named(&tuning.joints), tuning.time)
}

/// What stands above the table, a sentence a line.
pub(super) fn heading(findings: &Findings<'_>) -> Vec<String> {
    let (scenario, times) = (findings.scenario, &findings.times);
    let first = times.first().copied().unwrap_or(0.0);
    let last = times.last().copied().unwrap_or(0.0);
    vec![
        format!(
            "{}: arm {}; each of {} joints locks at each of {} times, {} to {} s",
            scenario.name(),
            scenario.arm().name(),
            findings.joints,
            times.len(),
            first,
            last
        ),
        format!(
            "laws with coefficients are tuned for {}; ratios are of the torque step after to before, norms over the healthy joints",
            failure(&findings.tuning)
        ),
    ]
}

/// The columns' heads and what stands in them.
pub(super) fn columns(findings: &Findings<'_>) -> (Vec<&'static str>, Vec<Vec<String>>) {
    let mut head = vec![
        "law",
        "worst ratio",
        "of",
        "worst 5 %",
        "median",
        "made worse",
        "worst, N m",
        "force error, N",
        "at the lock, N",
        "max |dU/dt|, N m/s",
    ];
    if findings.limited {
        head.push("margin, N m");
    }
    if findings.has_pairs() {
        head.extend(["pairs: worst", "median", "made worse"]);
    }
    let rows = findings.assessment.laws.iter().map(|law| {
        let singles = &law.singles;
        let mut row = vec![
            title(law),
            significant(singles.worst_ratio),
            singles.worst.as_ref().map_or_else(String::new, failure),
            significant(singles.cvar),
            significant(singles.median_ratio),
            percent(singles.share_worse),
            significant(singles.worst_after),
            significant(singles.worst_force_error),
            significant(singles.worst_force_error_at_lock),
            significant(singles.fastest_change),
        ];
        if findings.limited {
            row.push(significant(singles.least_margin));
        }
        if findings.has_pairs() {
            row.extend(law.pairs.as_ref().map_or_else(
                || [const { String::new() }; 3],
                |pairs: &Statistics| {
                    [
                        significant(pairs.worst_ratio),
                        significant(pairs.median_ratio),
                        percent(pairs.share_worse),
                    ]
                },
            ));
        }
        row
    });
    (head, rows.collect())
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

pub(super) fn write(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    for sentence in heading(findings) {
        writeln!(out, "{sentence}")?;
    }
    let (head, rows) = columns(findings);
    let mut table = Table::new();
    table.set_header(head);
    for row in rows {
        table.add_row(row);
    }
    writeln!(out, "\n{}", plain(table, &[0, 2]))?;
    if findings.simulated > 0 {
        writeln!(out, "\n{}", simulated(findings))?;
        let (head, rows) = felt_columns(findings);
        let mut table = Table::new();
        table.set_header(head);
        for row in rows {
            table.add_row(row);
        }
        writeln!(out, "{}", plain(table, &[0]))?;
    }
    Ok(())
}

/// What stands above the second table.
pub(super) fn simulated(findings: &Findings<'_>) -> String {
    format!(
        "{} of the failures simulated ({}): the step that the healthy joints really transmit, with the law to without",
        findings.simulated,
        besides_servo(findings.scenario)
    )
}

/// The columns of the simulated failures: median, worst and made worse, gain by gain.
pub(super) fn felt_columns(findings: &Findings<'_>) -> (Vec<String>, Vec<Vec<String>>) {
    let mut head = vec!["law".to_owned()];
    for truth in &findings.felt {
        head.push(format!("gain {} rad/s: median", truth.gain));
        head.extend(["worst", "made worse"].map(str::to_owned));
    }
    let laws = findings.felt.first().map_or(&[][..], |truth| &truth.laws);
    let rows = laws.iter().enumerate().map(|(index, law)| {
        let mut row = vec![name(law.law, law.force_budget)];
        for felt in findings
            .felt
            .iter()
            .filter_map(|truth| truth.laws.get(index))
        {
            let unfinished = match felt.unfinished {
                0 => String::new(),
                count => format!(" ({count} fling the arm off)"),
            };
            row.extend([
                significant(felt.median_ratio),
                significant(felt.worst_ratio),
                percent(felt.share_worse) + &unfinished,
            ]);
        }
        row
    });
    (head, rows.collect())
}
