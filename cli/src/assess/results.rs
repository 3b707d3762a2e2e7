//! `assess.json`: every law with every failure.

use serde::Serialize;
use ulna_study::assess::{AssessedCase, FeltLaw, GroundTruth, LawAssessment, Statistics, Tuning};

use super::Findings;

#[derive(Serialize)]
struct Results<'f> {
    arm: &'f str,
    scenario: &'f str,
    failure_times: &'f [f64],
    laws: Vec<LawEntry<'f>>,
    /// Some of the failures simulated, gain by gain.
    ground_truth: Vec<GroundTruthEntry>,
}

#[derive(Serialize)]
struct GroundTruthEntry {
    /// rad/s
    gain: f64,
    laws: Vec<FeltEntry>,
}

/// Ratios of the step that is transmitted with the law to that without.
#[derive(Serialize)]
struct FeltEntry {
    law: &'static str,
    force_budget: Option<f64>,
    count: usize,
    unfinished: usize,
    median_ratio: f64,
    worst_ratio: f64,
    share_worse: f64,
}

#[derive(Serialize)]
struct LawEntry<'f> {
    law: &'static str,
    tuned: Option<TuningEntry>,
    force_budget: Option<f64>,
    note: &'f str,
    /// Single joints.
    cases: Vec<CaseEntry>,
    worst_ratio: f64,
    median_ratio: f64,
    share_worse: f64,
    worst_force_error: f64,
    cvar: f64,
    worst_before: f64,
    worst_after: f64,
    worst_force_error_at_lock: f64,
    /// `None` without limits.
    least_margin: Option<f64>,
    fastest_change: f64,
    pairs: Option<PairsEntry>,
}

#[derive(Serialize)]
struct TuningEntry {
    /// The first of them, counted from 1.
    joint: usize,
    joints: Vec<usize>,
    time: f64,
}

#[derive(Serialize)]
struct CaseEntry {
    joint: usize,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    joints: Vec<usize>,
    time: f64,
    before: f64,
    after: f64,
    /// Over the whole motion.
    force_error: f64,
    force_error_at_lock: f64,
    /// The healthy joint whose own step grows most.
    grown_joint: Option<usize>,
}

#[derive(Serialize)]
struct PairsEntry {
    worst_ratio: f64,
    median_ratio: f64,
    cvar: f64,
    share_worse: f64,
    worst_force_error: f64,
    cases: Vec<CaseEntry>,
}

/// The file. Joints count from 1; norms over the healthy joints, N m (N); forces in N.
pub(super) fn json(findings: &Findings<'_>) -> anyhow::Result<Vec<u8>> {
    let laws = findings.assessment.laws.iter().map(law);
    let results = Results {
        arm: findings.scenario.arm().name(),
        scenario: findings.scenario.name(),
        failure_times: &findings.times,
        laws: laws.collect(),
        ground_truth: findings.felt.iter().map(ground_truth).collect(),
    };
    let mut json = serde_json::to_vec(&results)?;
    json.push(b'\n');
    Ok(json)
}

fn ground_truth(truth: &GroundTruth) -> GroundTruthEntry {
    let law = |felt: &FeltLaw| FeltEntry {
        law: felt.law.name(),
        force_budget: felt.force_budget,
        count: felt.count,
        unfinished: felt.unfinished,
        median_ratio: felt.median_ratio,
        worst_ratio: felt.worst_ratio,
        share_worse: felt.share_worse,
    };
    GroundTruthEntry {
        gain: truth.gain,
        laws: truth.laws.iter().map(law).collect(),
    }
}

fn law(law: &LawAssessment) -> LawEntry<'_> {
    let cases = |joints: usize| {
        let cases = law.cases.iter();
        let of = cases.filter(move |case| case.joints.len() == joints);
        of.map(case).collect::<Vec<_>>()
    };
    let singles = &law.singles;
    LawEntry {
        law: law.law.name(),
        tuned: law.tuned.as_ref().map(tuning),
        force_budget: law.force_budget,
        note: &law.note,
        cases: cases(1),
        worst_ratio: singles.worst_ratio,
        median_ratio: singles.median_ratio,
        share_worse: singles.share_worse,
        worst_force_error: singles.worst_force_error,
        cvar: singles.cvar,
        worst_before: singles.worst_before,
        worst_after: singles.worst_after,
        worst_force_error_at_lock: singles.worst_force_error_at_lock,
        least_margin: Some(singles.least_margin).filter(|margin| margin.is_finite()),
        fastest_change: singles.fastest_change,
        pairs: law.pairs.as_ref().map(|pairs| of_pairs(pairs, cases(2))),
    }
}

fn of_pairs(pairs: &Statistics, cases: Vec<CaseEntry>) -> PairsEntry {
    PairsEntry {
        worst_ratio: pairs.worst_ratio,
        median_ratio: pairs.median_ratio,
        cvar: pairs.cvar,
        share_worse: pairs.share_worse,
        worst_force_error: pairs.worst_force_error,
        cases,
    }
}

fn tuning(tuning: &Tuning) -> TuningEntry {
    let joints: Vec<usize> = tuning.joints.iter().map(|joint| joint + 1).collect();
    TuningEntry {
        joint: joints.first().copied().unwrap_or(0),
        joints,
        time: tuning.time,
    }
}

fn case(case: &AssessedCase) -> CaseEntry {
    let joints: Vec<usize> = case.joints.iter().map(|joint| joint + 1).collect();
    CaseEntry {
        joint: joints.first().copied().unwrap_or(0),
        joints: if joints.len() > 1 { joints } else { Vec::new() },
        time: case.time,
        before: case.before,
        after: case.after,
        force_error: case.force_error,
        force_error_at_lock: case.force_error_at_lock,
        grown_joint: case.grown.map(|(joint, _)| joint + 1),
    }
}
