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
    pub(crate) after_only: Option<f64>,
    pub(crate) asked_force: Option<f64>,
    pub(crate) eq16_force_error: Option<f64>,
    pub(crate) eq16_max_force_error: Option<f64>,
    pub(crate) eq20_force_error: Option<f64>,
    pub(crate) eq20_max_force_error: Option<f64>,
    pub(crate) optimal_force_error: Option<f64>,
    pub(crate) optimal_max_force_error: Option<f64>,
    pub(crate) after_only_force_error: Option<f64>,
    pub(crate) after_only_max_force_error: Option<f64>,
    /// How many healthy joints bear more than without compensation, law by law.
    pub(crate) eq16_worse_joints: Option<usize>,
    pub(crate) eq20_worse_joints: Option<usize>,
    pub(crate) optimal_worse_joints: Option<usize>,
    pub(crate) after_only_worse_joints: Option<usize>,
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
            eq16: outcome.map(|outcome| outcome.per_joint.impact),
            eq20: outcome.map(|outcome| outcome.projected.impact),
            optimal: outcome.map(|outcome| outcome.optimal.impact),
            after_only: outcome.map(|outcome| outcome.after_only.impact),
            asked_force: outcome.map(|outcome| outcome.asked_force),
            eq16_force_error: outcome.map(|outcome| outcome.per_joint.force_error),
            eq16_max_force_error: outcome.map(|outcome| outcome.per_joint.max_force_error),
            eq20_force_error: outcome.map(|outcome| outcome.projected.force_error),
            eq20_max_force_error: outcome.map(|outcome| outcome.projected.max_force_error),
            optimal_force_error: outcome.map(|outcome| outcome.optimal.force_error),
            optimal_max_force_error: outcome.map(|outcome| outcome.optimal.max_force_error),
            after_only_force_error: outcome.map(|outcome| outcome.after_only.force_error),
            after_only_max_force_error: outcome.map(|outcome| outcome.after_only.max_force_error),
            eq16_worse_joints: outcome.map(|outcome| outcome.per_joint.worse_joints),
            eq20_worse_joints: outcome.map(|outcome| outcome.projected.worse_joints),
            optimal_worse_joints: outcome.map(|outcome| outcome.optimal.worse_joints),
            after_only_worse_joints: outcome.map(|outcome| outcome.after_only.worse_joints),
            locked_before: outcome.map(|outcome| outcome.locked_before),
            status: match &case.outcome {
                Ok(_) => "ok".to_owned(),
                Err(error) => error.to_string(),
            },
        }
    }
}

/// A quantity of a case.
pub(crate) type Quantity = fn(&Row) -> Option<f64>;

/// A law of a campaign: a row here is a column of every table and a panel of the figure.
pub(crate) struct CampaignLaw {
    /// In files.
    pub(crate) key: &'static str,
    pub(crate) title: &'static str,
    /// What it leaves over the healthy joints, N m (N).
    pub(crate) impact: Quantity,
    /// How many healthy joints it makes worse.
    pub(crate) worse: fn(&Row) -> Option<usize>,
    /// Its force errors at the lock and at worst over the motion, N.
    pub(crate) force: (Quantity, Quantity),
}

/// In the order of tables and panels.
pub(crate) const LAWS: [CampaignLaw; 4] = [
    CampaignLaw {
        key: "eq16",
        title: "Eq. 16",
        impact: |row| row.eq16,
        worse: |row| row.eq16_worse_joints,
        force: (|row| row.eq16_force_error, |row| row.eq16_max_force_error),
    },
    CampaignLaw {
        key: "eq20",
        title: "Eq. 20",
        impact: |row| row.eq20,
        worse: |row| row.eq20_worse_joints,
        force: (|row| row.eq20_force_error, |row| row.eq20_max_force_error),
    },
    CampaignLaw {
        key: "optimal",
        title: "optimal",
        impact: |row| row.optimal,
        worse: |row| row.optimal_worse_joints,
        force: (
            |row| row.optimal_force_error,
            |row| row.optimal_max_force_error,
        ),
    },
    CampaignLaw {
        key: "after_only",
        title: "after only",
        impact: |row| row.after_only,
        worse: |row| row.after_only_worse_joints,
        force: (
            |row| row.after_only_force_error,
            |row| row.after_only_max_force_error,
        ),
    },
];

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
