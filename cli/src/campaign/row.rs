//! [`Row`]: a case as a line of `campaign.csv`.

use serde::{Deserialize, Serialize};
use ulna_study::experiment::CampaignCase;

/// One case. Norms over the healthy joints, N m (N); forces in N; `None` where there is no outcome.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(crate) struct Row {
    pub(crate) case: u64,
    /// Counted from 1.
    pub(crate) failed_joint: usize,
    pub(crate) failure_time: f64,
    pub(crate) before: Option<f64>,
    pub(crate) eq16: Option<f64>,
    pub(crate) eq20: Option<f64>,
    pub(crate) optimal: Option<f64>,
    pub(crate) eq16_force_error: Option<f64>,
    pub(crate) locked_before: Option<f64>,
    pub(crate) status: String,
}

impl Row {
    /// A case as a row.
    pub(super) fn of(case: &CampaignCase) -> Self {
        let outcome = case.outcome.as_ref().ok();
        Self {
            case: case.index,
            failed_joint: case.failed_joint + 1,
            failure_time: case.failure_time,
            before: outcome.map(|outcome| outcome.before),
            eq16: outcome.map(|outcome| outcome.per_joint),
            eq20: outcome.map(|outcome| outcome.projected),
            optimal: outcome.map(|outcome| outcome.optimal),
            eq16_force_error: outcome.map(|outcome| outcome.per_joint_force_error),
            locked_before: outcome.map(|outcome| outcome.locked_before),
            status: match &case.outcome {
                Ok(_) => "ok".to_owned(),
                Err(error) => error.to_string(),
            },
        }
    }
}

/// The rows of a file with its header, if they are whole and numbered without a gap.
pub(super) fn read(text: &[u8]) -> Option<Vec<Row>> {
    let mut rows = Vec::new();
    for row in csv::Reader::from_reader(text).into_deserialize() {
        let row: Row = row.ok()?;
        if row.case != rows.len() as u64 {
            return None;
        }
        rows.push(row);
    }
    Some(rows)
}
