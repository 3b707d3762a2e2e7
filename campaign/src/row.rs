//! [`Row`]: a case as a line of `campaign.csv`.

use std::io::Read;

use anyhow::Context;
use serde::{Deserialize, Serialize};
use ulna_files::rows;
use ulna_study::experiment::{CampaignCase, CampaignOutcome};
use ulna_study::{LawName, LawSet};

/// One case. Its columns are those of [`CaseCells`], then those of [`LawCells`] for each of the campaign's laws.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Row {
    /// What is so whatever law meets it.
    pub case: CaseCells,
    /// In the order of the campaign's laws. Laws that were not chosen have no columns.
    pub laws: Vec<LawCells>,
}

/// What is so whatever law meets the case. Norms over the healthy joints, N m (N); forces in N; `None` where there is no outcome.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct CaseCells {
    /// Its number, from 0.
    pub case: u64,
    /// Counted from 1.
    pub failed_joint: usize,
    /// When it locks, s.
    pub failure_time: f64,
    /// The impact without compensation.
    pub before: Option<f64>,
    /// The locked joint's own step without compensation.
    pub locked_before: Option<f64>,
    /// The norm of the tool force that is asked for.
    pub asked_force: Option<f64>,
    /// "ok", or what went wrong: with the case, or with the laws that have no outcome.
    pub status: String,
}

/// What a law does in a case. In the file the first has the law's name, the others begin with it.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct LawCells {
    /// What it leaves over the healthy joints, N m (N).
    pub impact: Option<f64>,
    /// At the lock, N.
    pub force_error: Option<f64>,
    /// At worst over the motion, N.
    pub max_force_error: Option<f64>,
    /// How many healthy joints bear more than without compensation.
    pub worse_joints: Option<usize>,
}

impl LawCells {
    fn of(outcome: &CampaignOutcome) -> Self {
        Self {
            impact: Some(outcome.impact),
            force_error: Some(outcome.force_error),
            max_force_error: Some(outcome.max_force_error),
            worse_joints: Some(outcome.worse_joints),
        }
    }
}

impl Row {
    /// A case of a campaign of `laws` as a row.
    pub(crate) fn of(case: &CampaignCase, laws: LawSet) -> Self {
        let result = case.outcome.as_ref();
        let found = result.ok();
        let cells = |law: LawName| {
            let outcome = found.and_then(|result| result.law(law));
            outcome.and_then(|outcome| outcome.as_ref().ok())
        };
        let cells = laws.iter().map(|law| cells(law).map(LawCells::of));
        Self {
            case: CaseCells {
                case: case.index,
                failed_joint: case.failed_joint + 1,
                failure_time: case.failure_time,
                before: found.map(|result| result.before),
                locked_before: found.map(|result| result.locked_before),
                asked_force: found.map(|result| result.asked_force),
                status: status(case),
            },
            laws: cells.map(Option::unwrap_or_default).collect(),
        }
    }
}

/// In a word, or in as many as are needed.
fn status(case: &CampaignCase) -> String {
    let result = match &case.outcome {
        Ok(result) => result,
        Err(error) => return error.to_string(),
    };
    let failed = result.laws.iter().filter_map(|(law, outcome)| {
        let error = outcome.as_ref().err()?;
        Some(format!("{law}: {error}"))
    });
    let failed: Vec<_> = failed.collect();
    if failed.is_empty() {
        "ok".to_owned()
    } else {
        failed.join("; ")
    }
}

/// The columns' names of a campaign of `laws`.
pub(crate) fn header(laws: LawSet) -> anyhow::Result<String> {
    let case = rows::header::<CaseCells>()?;
    let cells = rows::header::<LawCells>()?;
    let cells: Vec<_> = cells.trim_end().split(',').collect();
    let of_laws = laws.iter().flat_map(|law| {
        let names = cells.iter().enumerate().map(move |(i, cell)| match i {
            0 => law.name().to_owned(),
            _ => format!("{law}_{cell}"),
        });
        names.collect::<Vec<_>>()
    });
    let names = std::iter::once(case.trim_end().to_owned()).chain(of_laws);
    Ok(names.collect::<Vec<_>>().join(",") + "\n")
}

/// The rows that `lines` has, those behind a file's header, as they come: numbered without a gap from `first`.
pub(crate) fn read(lines: impl Read, first: u64) -> impl Iterator<Item = anyhow::Result<Row>> {
    let reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(lines);
    // By the order of the columns: a law's names are no fields.
    reader
        .into_deserialize()
        .zip(first..)
        .map(|(row, number): (Result<Row, _>, _)| {
            let row = row?;
            (row.case.case == number)
                .then_some(row)
                .context("the cases are not numbered in a row")
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        let laws = LawSet::of(&[LawName::OnLine, LawName::PerJoint]);
        let row = |case: u64, before: Option<f64>, status: &str| Row {
            case: CaseCells {
                case,
                failed_joint: 3,
                failure_time: 0.5,
                before,
                locked_before: before,
                asked_force: Some(1.0 / 3.0),
                status: status.to_owned(),
            },
            laws: vec![
                LawCells::default(),
                LawCells {
                    impact: Some(0.1),
                    force_error: Some(1e-300),
                    max_force_error: None,
                    worse_joints: Some(4),
                },
            ],
        };
        let rows = vec![row(0, Some(0.25), "ok"), row(1, None, "no, \"not\" so")];
        let text = header(laws).unwrap() + &rows::lines(&rows).unwrap();
        let names = "case,failed_joint,failure_time,before,locked_before,asked_force,status,\
                     eq16,eq16_force_error,eq16_max_force_error,eq16_worse_joints,\
                     on_line,on_line_force_error,on_line_max_force_error,on_line_worse_joints\n";
        assert!(text.starts_with(names), "{text}");
        let (_, lines) = text.split_once('\n').unwrap();
        let all = |lines: &str, first| {
            let rows: anyhow::Result<Vec<_>> = read(lines.as_bytes(), first).collect();
            rows.ok()
        };
        assert_eq!(all(lines, 0).unwrap(), rows);
        // A gap, another beginning, and a line that is cut off.
        let (_, last) = lines.split_once('\n').unwrap();
        assert!(all(last, 0).is_none() && all(lines, 1).is_none());
        assert_eq!(all(last, 1).unwrap(), rows[1..]);
        assert!(all(&lines[..lines.len() - 30], 0).is_none());
    }
}
