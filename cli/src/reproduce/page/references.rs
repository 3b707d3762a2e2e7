//! What is left of the impact, here and in the references.

use std::fmt::{self, Write};

use ulna_study::Scenario;
use ulna_study::experiment::{SearchMethod, Study};
use ulna_study::scenario::Experiment;

use crate::reproduce::references::{notes, reference_at};

/// A table for each failure time that has a reference, and what is to be said of the other references.
pub(super) fn write(
    page: &mut String,
    scenario: &Scenario,
    experiment: &Experiment,
    studies: &[&Study],
) -> fmt::Result {
    for study in studies {
        let Some(reference) = reference_at(scenario, experiment, study.failure_time) else {
            continue;
        };
        let case = study.case(SearchMethod::StepwisePerJoint);
        // Without a compensation nothing here compares with one.
        if case.search.is_err() {
            continue;
        }
        let pairs = reference.before().iter().zip(reference.after());
        let rows: Vec<_> = pairs
            .enumerate()
            .filter_map(|(joint, pair)| match pair {
                (Some(before), Some(after)) if *before > 0.0 => Some(format!(
                    "| {} | {:.1} | {:.1} |",
                    joint + 1,
                    100.0 * after / before,
                    100.0 - case.suppression_percent()[joint]
                )),
                _ => None,
            })
            .collect();
        if !rows.is_empty() {
            writeln!(
                page,
                "Left of the impact after the search in steps (Eq. 16), lock at {} s:\n\n\
                 | joint | {}, % | here, % |\n|---|---|---|\n{}\n",
                study.failure_time,
                reference.source(),
                rows.join("\n")
            )?;
        }
    }
    for note in notes(scenario, experiment) {
        writeln!(page, "{note}\n")?;
    }
    Ok(())
}
