//! The table of coefficients k_d, found and from elsewhere.

use comfy_table::Table;
use ulna_study::Scenario;
use ulna_study::experiment::{SearchMethod, Study};
use ulna_study::scenario::Experiment;

use super::references::reference_at;
use super::words::{coefficient, short};
use crate::columns::plain;

/// A row for each failure time and source, a column for each joint.
pub(super) fn coefficients(
    scenario: &Scenario,
    experiment: &Experiment,
    studies: &[&Study],
) -> String {
    let mut table = Table::new();
    let joints = scenario.arm().joints().len();
    let titles = (1..=joints).map(|joint| format!("k_d{joint}"));
    let titles = ["at".to_owned(), "found".to_owned()]
        .into_iter()
        .chain(titles);
    table.set_header(titles);
    for study in studies {
        let mut row = |found: &str, cells: Vec<String>| {
            let heads = [format!("{} s", study.failure_time), found.to_owned()];
            table.add_row(heads.into_iter().chain(cells));
        };
        // A grid's values and printed ones have no more digits than they show.
        for (method, found, text) in [
            (
                SearchMethod::StepwisePerJoint,
                "in steps",
                short as fn(f64) -> String,
            ),
            (SearchMethod::PerJoint, "exactly", coefficient),
        ] {
            let case = study.case(method);
            if case.search.is_ok() {
                row(found, case.coefficients.iter().map(|k| text(*k)).collect());
            } else {
                row(found, vec!["none".to_owned(); joints]);
            }
        }
        if let Some(reference) = reference_at(scenario, experiment, study.failure_time)
            && reference.coefficients().iter().any(Option::is_some)
        {
            let values = reference.coefficients().iter();
            let cells = values.map(|value| value.map_or_else(String::new, short));
            row(reference.source(), cells.collect());
        }
    }
    plain(table, &[1])
}
