//! What the tool is asked to exert, which every force error is to be seen beside.

use ulna_study::experiment::{LockMechanics, Study};
use ulna_study::scenario::Experiment;

/// The norm of the wrench that is asked for in the components of the task, N (with the moments' N m, if the task has any).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Asked {
    /// At the lock.
    pub(super) at_lock: f64,
    /// At most over the motion.
    pub(super) most: f64,
}

impl Asked {
    /// What `experiment` asks for in the motion of `study`.
    pub(super) fn of(experiment: &Experiment, study: &Study, locks: &[LockMechanics]) -> Self {
        // The task is that of the arm, at any time.
        let task = locks.first().map_or(&[][..], |lock| &lock.task);
        let norm = |time: f64| {
            let wrench = experiment.force().at(time);
            let components = task.iter().map(|row| wrench[*row]);
            components.map(|x| x * x).sum::<f64>().sqrt()
        };
        let cases = study.cases.first();
        let times = cases.into_iter().flat_map(|case| &case.rollout.series.time);
        Self {
            at_lock: norm(study.failure_time),
            most: times.map(|time| norm(*time)).fold(0.0, f64::max),
        }
    }
}
