//! What stands beside Section 5 on the paper-like scenario: the plan's own steps, other profiles, Δt and ΔF_e, and what rated torques cut.

mod lock_step;
mod plan_steps;
mod rated_torques;

use std::path::Path;

use ulna_generated::Ssrms;
use ulna_study::Scenario;
use ulna_study::experiment::ExperimentRunner;
use ulna_study::scenario::KnownArm;

const TIMES: [f64; 3] = [3.0, 10.0, 18.0];

/// The paper-like scenario with `edits`, and first of all with control cycles of 1 s: most of what is compared is at the lock.
fn scenario(edits: &[(&str, &str)]) -> Scenario {
    let known = KnownArm {
        name: "ssrms",
        joints: &Ssrms::CHAIN.joints,
        joint_names: &Ssrms::JOINT_NAMES,
    };
    let text = include_str!("../../../scenarios/paper_like.toml").to_owned();
    let edits = [("cycle = 0.01", "cycle = 1")].iter().chain(edits);
    let text = edits.fold(text, |text, (from, to)| {
        assert!(text.contains(from), "the scenario has no {from:?}");
        text.replacen(from, to, 1)
    });
    Scenario::parse(&text, "test.toml", Path::new("scenarios"), &[known])
        .unwrap_or_else(|errors| panic!("{errors}"))
}

fn runner(scenario: &Scenario) -> ExperimentRunner<'_, 7> {
    ExperimentRunner::new(&Ssrms, scenario).unwrap()
}
