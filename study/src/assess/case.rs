//! [`AssessedCase`]: one law, and one failure that it meets.

use ulna::LockedJoints;

use crate::search;

/// What a law makes of one failure. Norms over the joints that do not lock, N·m (N).
#[derive(Clone, Debug, PartialEq)]
pub struct AssessedCase {
    /// The joints that lock, counted from 0.
    pub joints: Vec<usize>,
    /// When, s.
    pub time: f64,
    /// The step of the torque without compensation.
    pub before: f64,
    /// The step with it.
    pub after: f64,
    /// The healthy joint whose own step grows most, counted from 0, and its step after, relative to the norm of all steps before;
    /// `None` if no step grows.
    pub grown: Option<(usize, f64)>,
    /// The norm of h (Eq. 13) at the lock, just before or just after, N (with the moments' N·m, if the task has any).
    pub force_error_at_lock: f64,
    /// The largest over the whole motion.
    pub force_error: f64,
    /// What is left of the rated torques over the whole motion, N·m (N); infinite without limits.
    pub least_margin: f64,
    /// The largest |dU_i/dt| away from the lock, N·m/s (N/s).
    pub fastest_change: f64,
}

/// What is smaller, relative to all of the step, is rounding.
const ROUNDING: f64 = 1e-9;

impl AssessedCase {
    /// After by before; `None` if there is no step to speak of beside `largest`, that of the whole grid, N·m (N).
    pub fn ratio(&self, largest: f64) -> Option<f64> {
        (self.before > ROUNDING * largest).then(|| self.after / self.before)
    }

    pub(super) fn new<const N: usize>(
        operation: &search::Operation<N>,
        assessment: &search::Assessment<N>,
    ) -> Self {
        let failure = operation.failure();
        let step = operation.step();
        let before = failure.joints.without(&step).norm();
        Self {
            joints: failure.joints.iter().collect(),
            time: failure.time,
            before,
            after: assessment.healthy_impact,
            grown: grown(failure.joints, &step, &assessment.impact, before),
            force_error_at_lock: assessment.force_error(),
            force_error: assessment.max_force_error,
            least_margin: assessment.least_margin,
            fastest_change: assessment.fastest_change,
        }
    }
}

fn grown<const N: usize>(
    locked: LockedJoints<N>,
    step: &ulna::nalgebra::SVector<f64, N>,
    impact: &ulna::nalgebra::SVector<f64, N>,
    norm: f64,
) -> Option<(usize, f64)> {
    let growth = |joint: usize| impact[joint].abs() - step[joint].abs();
    let grown = locked
        .healthy()
        .filter(|joint| growth(*joint) > ROUNDING * norm);
    let most = grown.max_by(|a, b| growth(*a).total_cmp(&growth(*b)))?;
    Some((most, impact[most].abs() / norm))
}
