//! A series of arms through every check; all that fails is told at once, each kind with its smallest table.

use std::collections::BTreeMap;
use std::env;
use std::fmt::Write as _;

use proptest::strategy::ValueTree;

use super::arms::{Arm, arm, tree};
use super::examination::{Failure, Outcome, examine};
use super::minimal::{Minimal, minimal};
use super::record::{Record, SAMPLES};
use super::summary::Summary;

/// How many arms are enough for every day.
const ARMS: u64 = 30;

/// By kind of failure: the number of joints and the number of each arm that has it.
type Failing = BTreeMap<String, Vec<(usize, u64)>>;

/// What the environment asks for.
pub(crate) struct Settings {
    arms: u64,
    seed: u64,
    summary: bool,
    record: Option<String>,
}

impl Settings {
    pub(crate) fn from_environment() -> Self {
        let number = |name: &str| {
            let text = env::var(name).ok()?;
            let number = text.parse();
            Some(number.unwrap_or_else(|error| panic!("{name}={text}: {error}")))
        };
        let arms = number("ULNA_RANDOM_ARMS");
        Self {
            summary: arms.is_some(),
            arms: arms.unwrap_or(ARMS),
            seed: number("ULNA_RANDOM_ARMS_SEED").unwrap_or(0),
            record: env::var("ULNA_RANDOM_ARMS_RECORD").ok(),
        }
    }
}

/// Examines the arms.
///
/// # Panics
/// If one of them fails.
pub(crate) fn run(settings: &Settings) {
    let strategy = arm();
    let mut record = settings.record.as_deref().map(Record::create);
    let samples = record.as_ref().map_or(0, |_| SAMPLES);
    let mut summary = Summary::default();
    let mut failing = Failing::new();
    for index in 0..settings.arms {
        let arm = tree(&strategy, settings.seed, index).current();
        let Outcome::Examined(examination) = examine(&arm, samples) else {
            summary.refused += 1;
            continue;
        };
        for Failure { kind, .. } in &examination.failures {
            let arms = failing.entry(kind.clone()).or_default();
            arms.push((arm.table.joints.len(), index));
        }
        if let Some(record) = &mut record {
            record.add(index, &arm.table.to_string(), &examination.samples);
        }
        summary.add(index, &arm, &examination);
    }
    let (examined, refused, failed) = (summary.examined(), summary.refused, summary.failed);
    if settings.summary {
        println!("{summary}");
    }
    assert!(examined > refused, "{refused} tables are refused");
    assert!(
        failing.is_empty(),
        "{failed} of {examined} arms fail\n{}",
        report(failing, |index| tree(&strategy, settings.seed, index))
    );
}

/// Each kind of failure with a table that has it. `arm` gives an arm by its number, to be shrunk.
fn report(failing: Failing, arm: impl Fn(u64) -> Box<dyn ValueTree<Value = Arm>>) -> String {
    let mut text = String::new();
    let mut tables: Vec<Minimal> = Vec::new();
    for (kind, arms) in failing {
        // Some failures come together, and then one table is enough.
        let known = |tables: &[Minimal]| tables.iter().position(|t| t.failure(&kind).is_some());
        let shown = known(&tables);
        // The arm of fewest joints is all but small enough already.
        if let (None, Some((_, least))) = (shown, arms.iter().min()) {
            tables.extend(minimal(arm(*least), &kind));
        }
        let detail = tables.iter().find_map(|table| table.failure(&kind));
        let detail = detail.map_or("", |failure| &failure.detail);
        let table = match (shown, tables.last()) {
            (Some(index), _) => format!("table {} above", index + 1),
            (None, Some(last)) => format!("table {}:\n\n{}", tables.len(), last.arm.table),
            (None, None) => String::new(),
        };
        // Writing to a String does not fail.
        let _ = write!(
            text,
            "\n==== {kind}\n\n{}\n{detail}\n{table}\n",
            listed(&arms)
        );
    }
    text
}

fn listed(arms: &[(usize, u64)]) -> String {
    const SHOWN: usize = 8;
    let first: Vec<_> = arms
        .iter()
        .take(SHOWN)
        .map(|(_, arm)| arm.to_string())
        .collect();
    let more = if arms.len() > SHOWN { ", ..." } else { "" };
    format!("{} arms: {}{more}", arms.len(), first.join(", "))
}
