//! Which of a scenario's references stand beside which results, and what is to be said of the others.

use ulna_study::Scenario;
use ulna_study::experiment::Study;
use ulna_study::scenario::{Experiment, Reference};

use super::words::{joints_named, locks};

/// The reference for a failure time: the first that is for it, and for no other lock.
pub(super) fn reference_at<'s>(
    scenario: &Scenario,
    experiment: &'s Experiment,
    time: f64,
) -> Option<&'s Reference> {
    let mut references = experiment.references().iter();
    references.find(|reference| reference.time() == time && is_for_lock(scenario, reference))
}

/// Whether a reference's joints are those that lock, as far as it says.
fn is_for_lock(scenario: &Scenario, reference: &Reference) -> bool {
    let there = reference.failed_joints();
    there.is_none_or(|there| there == scenario.failed_joints())
}

/// Whether figures of the paper itself stand beside these results.
pub(super) fn is_beside_paper(
    scenario: &Scenario,
    experiment: &Experiment,
    studies: &[&Study],
) -> bool {
    studies.iter().any(|study| {
        let reference = reference_at(scenario, experiment, study.failure_time);
        reference.is_some_and(|reference| reference.source().to_lowercase().contains("paper"))
    })
}

/// A sentence for each reference that is left out, and for each that does not say which joint locks there.
pub(super) fn notes(scenario: &Scenario, experiment: &Experiment) -> Vec<String> {
    let note = |reference: &Reference| {
        let (source, time) = (reference.source(), reference.time());
        let here = locks(scenario.failed_joints());
        if !scenario.failure_times().contains(&time) {
            return Some(format!(
                "The reference \"{source}\" for {time} s is left out: that is no failure time of this scenario."
            ));
        }
        if let Some(there) = reference.failed_joints()
            && !is_for_lock(scenario, reference)
        {
            return Some(format!(
                "The reference \"{source}\" for {time} s is left out: there {}, here {here}.",
                locks(there)
            ));
        }
        let first = reference_at(scenario, experiment, time);
        if first.is_some_and(|first| !std::ptr::eq(first, reference)) {
            return Some(format!(
                "The reference \"{source}\" for {time} s is left out: another for that time comes first."
            ));
        }
        reference.failed_joints().is_none().then(|| {
            format!(
                "The reference \"{source}\" for {time} s does not say which joint locks there; it stands beside the lock of {}.",
                joints_named(scenario.failed_joints())
            )
        })
    };
    experiment.references().iter().filter_map(note).collect()
}
